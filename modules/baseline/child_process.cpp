#include "modules/baseline/child_process.hpp"

#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <system_error>

#include "graph/api/error.hpp"
#include "graph/api/helper_memory.hpp"
#include "graph/api/supervised_process.hpp"

namespace atrium::baseline {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds grace{2};  // between SIGTERM and SIGKILL

void read_on(SupervisedProcess& process, int milliseconds, ChildLog& log) {
  std::string printed;
  process.wait(milliseconds, printed);
  log.add(printed);
}

// Asks the program to end and gives it a while.
void terminate(SupervisedProcess& process, ChildLog& log) {
  process.terminate();
  for (const auto until = Clock::now() + grace; !process.status() && Clock::now() < until;) read_on(process, 5, log);
  process.end();
}

}  // namespace

void ChildLog::add(const std::string& text) {
  const std::size_t first = std::min(text.size(), most - head_.size());
  head_.append(text, 0, first);
  end_.append(text, first);
  if (end_.size() > 2 * most) {  // seldom, so that each byte is moved once
    left_out_ += end_.size() - most;
    end_.erase(0, end_.size() - most);
  }
}

std::string ChildLog::text() const {
  if (left_out_ == 0 && end_.size() <= most) return head_ + end_;
  const std::size_t kept = std::min(end_.size(), most);
  return fmt::format("{}\n[{} bytes are left out here]\n{}", head_, left_out_ + end_.size() - kept,
                     end_.substr(end_.size() - kept));
}

std::string ChildLog::tail() const {
  constexpr std::size_t wanted = 1000;
  std::string text = end_.size() >= wanted ? end_ : head_ + end_;
  text.erase(0, text.size() - std::min(text.size(), wanted));
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) text.pop_back();
  return text.empty() ? "it printed nothing" : "the last that it printed: " + text;
}

ChildResult run_child(const ChildProcess& child, ChildLog& log, Context& context) {
  const std::string& name = child.arguments.at(0);
  const auto start = Clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  SupervisedProcess process({child.arguments, child.folder, child.mebibytes});
  while (!process.status() && !process.failure()) {
    read_on(process, 10, log);
    const bool late = !process.status() && child.seconds > 0 && elapsed() > child.seconds;
    if (late || context.cancelled()) terminate(process, log);
    context.check_cancelled();
    if (late) throw Error(fmt::format("{} was ended at its time limit of {} s", name, child.seconds), log.tail());
  }
  ChildResult result;
  result.seconds = elapsed();
  process.end();
  read_on(process, 0, log);
  if (process.failure())
    throw Error(fmt::format("cannot start {}: {}", name, std::generic_category().message(*process.failure())));
  result.mebibytes = process.peak_mebibytes();
  note_helper_memory(static_cast<std::uint64_t>(result.mebibytes * 1024 * 1024));
  const int status = *process.status();
  if (WIFSIGNALED(status))
    throw Error(fmt::format("{} was ended by the signal '{}'", name, ::strsignal(WTERMSIG(status))), log.tail());
  if (WEXITSTATUS(status) != 0)
    throw Error(fmt::format("{} ended with exit code {}", name, WEXITSTATUS(status)), log.tail());
  return result;
}

}  // namespace atrium::baseline
