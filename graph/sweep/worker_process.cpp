#include "graph/sweep/worker_process.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <fstream>

namespace atrium {
namespace {

constexpr std::size_t most_printed = 1U << 20U;  // bytes of the beginning, and of the end

}  // namespace

std::vector<std::string> WorkerProcess::read() {
  std::string printed;
  process_.read(printed, line_);
  keep(printed);
  std::vector<std::string> lines;
  std::size_t start = 0;
  for (std::size_t end = 0; (end = line_.find('\n', start)) != std::string::npos; start = end + 1)
    lines.push_back(line_.substr(start, end - start));
  line_.erase(0, start);
  return lines;
}

void WorkerProcess::keep(const std::string& printed) {
  const std::size_t first = std::min(printed.size(), most_printed - head_.size());
  head_.append(printed, 0, first);
  tail_.append(printed, first);
  if (tail_.size() > 2 * most_printed) {  // seldom, so that each byte is moved once
    left_out_ += tail_.size() - most_printed;
    tail_.erase(0, tail_.size() - most_printed);
  }
}

std::optional<int> WorkerProcess::ended() {
  if (process_.failure()) return 127 << 8;  // as a shell says that it cannot start a program
  if (process_.status()) process_.end();
  return process_.status();
}

std::uint64_t WorkerProcess::memory() const {
  std::ifstream statm(fmt::format("/proc/{}/statm", process_.id()));
  std::uint64_t size = 0;
  std::uint64_t resident = 0;
  std::uint64_t shared = 0;
  if (!(statm >> size >> resident >> shared) || shared > resident) return 0;
  return (resident - shared) * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

std::string WorkerProcess::printed() const {
  if (tail_.size() <= most_printed && left_out_ == 0) return head_ + tail_;
  const std::size_t kept = std::min(tail_.size(), most_printed);
  return fmt::format("{}\n[{} bytes are left out here]\n{}", head_, left_out_ + tail_.size() - kept,
                     tail_.substr(tail_.size() - kept));
}

std::string how_ended(int status) {
  if (!WIFSIGNALED(status)) return fmt::format("exit code {}", WEXITSTATUS(status));
  const int signal = WTERMSIG(status);
  const char* name = ::sigabbrev_np(signal);
  return fmt::format("signal {} ({}{})", signal, name == nullptr ? "" : "SIG", name == nullptr ? "unknown" : name);
}

}  // namespace atrium
