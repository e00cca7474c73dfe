#include "graph/run/console_progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <system_error>

#include "graph/api/clocks.hpp"
#include "graph/api/text.hpp"

namespace atrium {
namespace {

constexpr std::size_t few_nodes = 200;  // up to here every node that is done gets its line
constexpr double worth_a_line = 1;      // seconds, in larger pipelines
constexpr double first_estimate_share = 0.05, first_estimate_seconds = 2;

std::size_t columns(std::FILE* stream) {
  winsize size{};
  if (::ioctl(::fileno(stream), TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 80;
  return size.ws_col;
}

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);  // NOLINT(concurrency-mt-unsafe)
  return value != nullptr && *value != '\0';
}

}  // namespace

std::string clock_text(double time) {
  const auto whole = static_cast<long>(std::lround(std::max(time, 0.0)));
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

ConsoleOptions console_options(std::FILE* stream, bool quiet) {
  ConsoleOptions options;
  options.stream = stream;
  options.quiet = quiet;
  const char* terminal = std::getenv("TERM");  // NOLINT(concurrency-mt-unsafe)
  const bool capable = terminal != nullptr && std::string_view(terminal) != "dumb" && ::isatty(::fileno(stream)) == 1;
  options.live = capable && !quiet;
  options.colour = capable && !is_set("NO_COLOR");
  return options;
}

ConsoleProgress::ConsoleProgress(ConsoleOptions options) : options_(options), start_(wall_seconds()) {
  if (options_.tick <= 0) options_.tick = options_.live ? 0.1 : 10;
  if (options_.quiet) return;
  try {
    ticker_ = std::thread([this] { tick(); });
  } catch (const std::system_error&) {  // no thread to be had: what is still running is not told
  }
}

ConsoleProgress::~ConsoleProgress() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  end_.notify_all();
  if (ticker_.joinable()) ticker_.join();
  erase();
  for (const auto& [text, times] : warnings_)
    if (times > 1) line(fmt::format("{} given {} times: {}", painted("warning:", "33"), times, text));
}

void ConsoleProgress::tick() {
  std::unique_lock lock(mutex_);
  while (!end_.wait_for(lock, std::chrono::duration<double>(options_.tick), [this] { return ended_; })) {
    if (options_.live)
      draw();
    else if (!running_.empty())
      line(fmt::format("[{}/{}] {} {}", done_, nodes_, running_nodes(), clock_text(wall_seconds() - start_)));
  }
}

void ConsoleProgress::planned(std::size_t nodes) {
  const std::lock_guard lock(mutex_);
  nodes_ = nodes;
}

void ConsoleProgress::started(const std::string& node) {
  const std::lock_guard lock(mutex_);
  running_[node].start = wall_seconds();
}

void ConsoleProgress::progress(const std::string& node, double share) {
  const std::lock_guard lock(mutex_);
  if (const auto found = running_.find(node); found != running_.end() && std::isfinite(share))
    found->second.share = std::clamp(share, 0.0, 1.0);
}

void ConsoleProgress::finished(const NodeRecord& node) {
  const std::lock_guard lock(mutex_);
  running_.erase(node.node);
  ++done_;
  if (node.status == NodeStatus::failed) {
    line(fmt::format("{} {} ({}): {}", painted("error:", "31"), node.node, node.type, node.message));
    if (!node.help.empty()) line("  help: " + node.help);
  } else if (node.status == NodeStatus::ok && !options_.quiet && !options_.live &&
             (nodes_ <= few_nodes || node.wall >= worth_a_line)) {
    line(node.is_hit() ? node.node + ": cached" : fmt::format("{}: {:.2f} s", node.node, node.wall));
  }
}

void ConsoleProgress::reopened(const std::string& /*node*/) {
  const std::lock_guard lock(mutex_);
  if (done_ > 0) --done_;
}

void ConsoleProgress::message(const std::string& node, std::string_view text, bool warning) {
  if (options_.quiet) return;
  const std::lock_guard lock(mutex_);
  const std::string said = node.empty() ? std::string(text) : fmt::format("{}: {}", node, text);
  if (warning) {
    if (++warnings_[std::string(text)] == 1) line(fmt::format("{} {}", painted("warning:", "33"), said));
  } else
    line(said);
}

std::string ConsoleProgress::painted(std::string_view text, std::string_view colour) const {
  return options_.colour ? fmt::format("\x1b[{}m{}\x1b[0m", colour, text) : std::string(text);
}

std::string ConsoleProgress::running_nodes() const {
  std::string text;
  for (const auto& [node, running] : running_) {
    text += text.empty() ? node : ", " + node;
    if (running.share > 0) text += fmt::format(" {:.0f} %", 100 * running.share);
    const double elapsed = wall_seconds() - running.start;
    if (running.share >= first_estimate_share && running.share < 1 && elapsed >= first_estimate_seconds)
      text += fmt::format(" ({} left)", clock_text(elapsed / running.share - elapsed));
  }
  return text;
}

void ConsoleProgress::draw() {
  const double elapsed = wall_seconds() - start_;
  double done = static_cast<double>(done_);
  for (const auto& [node, running] : running_) done += running.share;
  const double share = nodes_ > 0 ? done / static_cast<double>(nodes_) : 0;
  std::string end = "  " + clock_text(elapsed);
  if (share >= first_estimate_share && elapsed >= first_estimate_seconds)
    end += fmt::format(", about {} left", clock_text(elapsed / share - elapsed));
  const std::size_t width = columns(options_.stream) - 1;
  const std::string begin = fmt::format("[{}/{}] {}", done_, nodes_, running_nodes());
  const std::string shown = shortened(begin, width > end.size() ? width - end.size() : 0) + shortened(end, width);
  std::fprintf(options_.stream, "\r%s\x1b[K", shown.c_str());
  std::fflush(options_.stream);
  drawn_ = true;
}

void ConsoleProgress::erase() {
  if (!drawn_) return;
  std::fputs("\r\x1b[K", options_.stream);
  std::fflush(options_.stream);
  drawn_ = false;
}

void ConsoleProgress::line(const std::string& text) {
  erase();
  std::fprintf(options_.stream, "%s\n", text.c_str());
  std::fflush(options_.stream);
}

}  // namespace atrium
