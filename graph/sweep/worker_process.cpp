#include "graph/sweep/worker_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>

#include "graph/api/error.hpp"

namespace atrium {
namespace {

constexpr std::size_t most_printed = 1U << 20U;  // bytes of the beginning, and of the end
constexpr std::size_t most_at_once = 64;         // reads, so that one worker does not take all of the time

struct Pipe {
  int read = -1, write = -1;
};

Pipe make_pipe() {
  std::array<int, 2> ends{-1, -1};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    throw Error("cannot make a pipe: " + std::generic_category().message(errno));
  return {ends[0], ends[1]};
}

/// After fork(): only calls that are safe in a signal handler.
[[noreturn]] void become(char* const* arguments, int events, int output, int input, pid_t parent) {
  ::setpgid(0, 0);  // signals of the terminal are for the parent
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(127);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  ::dup2(input, STDIN_FILENO);
  ::dup2(output, STDOUT_FILENO);
  ::dup2(output, STDERR_FILENO);
  if (events == WorkerProcess::events_file)
    ::fcntl(events, F_SETFD, 0);
  else
    ::dup2(events, WorkerProcess::events_file);
  ::execv(arguments[0], arguments);
  ::_exit(127);
}

/// At the end of the stream the file is closed.
ssize_t read_some(int& file, char* data, std::size_t size) {
  const ssize_t result = file < 0 ? 0 : ::read(file, data, size);
  if (result == 0 && file >= 0) ::close(std::exchange(file, -1));
  return result;
}

}  // namespace

WorkerProcess::WorkerProcess(const std::vector<std::string>& arguments) {
  std::vector<char*> list;
  list.reserve(arguments.size() + 1);
  for (const auto& argument : arguments) list.push_back(const_cast<char*>(argument.c_str()));
  list.push_back(nullptr);
  const Pipe events = make_pipe();
  const Pipe output = make_pipe();
  const int input = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  const pid_t parent = ::getpid();
  process_ = ::fork();
  if (process_ == 0) become(list.data(), events.write, output.write, input, parent);
  const int reason = errno;
  for (const int file : {events.write, output.write, input}) ::close(file);
  events_ = events.read;
  output_ = output.read;
  if (process_ < 0) {
    ::close(events_);
    ::close(output_);
    throw Error("cannot start a process: " + std::generic_category().message(reason));
  }
  ::setpgid(process_, process_);  // as it does itself: whoever is first
  ::fcntl(events_, F_SETFL, O_NONBLOCK);
  ::fcntl(output_, F_SETFL, O_NONBLOCK);
}

WorkerProcess::~WorkerProcess() {
  if (!status_) {
    ::kill(-process_, SIGKILL);
    ::kill(process_, SIGKILL);
    int status = 0;
    while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
  }
  for (const int file : {events_, output_})
    if (file >= 0) ::close(file);
}

std::vector<std::string> WorkerProcess::read() {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < most_at_once && read_output(); ++i) {
  }
  for (std::size_t i = 0; i < most_at_once && read_events(lines); ++i) {
  }
  return lines;
}

bool WorkerProcess::read_events(std::vector<std::string>& lines) {
  std::array<char, 1U << 16U> buffer{};
  const ssize_t size = read_some(events_, buffer.data(), buffer.size());
  if (size <= 0) return false;
  line_.append(buffer.data(), static_cast<std::size_t>(size));
  std::size_t start = 0;
  for (std::size_t end = 0; (end = line_.find('\n', start)) != std::string::npos; start = end + 1)
    lines.push_back(line_.substr(start, end - start));
  line_.erase(0, start);
  return true;
}

bool WorkerProcess::read_output() {
  std::array<char, 1U << 16U> buffer{};
  const ssize_t size = read_some(output_, buffer.data(), buffer.size());
  if (size <= 0) return false;
  const auto bytes = static_cast<std::size_t>(size);
  const std::size_t first = std::min(bytes, most_printed - head_.size());
  head_.append(buffer.data(), first);
  tail_.append(buffer.data() + first, bytes - first);
  if (tail_.size() > 2 * most_printed) {  // seldom, so that each byte is moved once
    left_out_ += tail_.size() - most_printed;
    tail_.erase(0, tail_.size() - most_printed);
  }
  return true;
}

std::optional<int> WorkerProcess::ended() {
  if (status_) return status_;
  siginfo_t info{};
  if (::waitid(P_PID, static_cast<id_t>(process_), &info, WEXITED | WNOHANG | WNOWAIT) != 0 || info.si_pid == 0)
    return std::nullopt;
  ::kill(-process_, SIGKILL);  // what it has left in its group, while nobody else can have its number
  int status = 0;
  if (::waitpid(process_, &status, 0) == process_) status_ = status;
  return status_;
}

void WorkerProcess::send(int signal) const {
  if (!status_) ::kill(-process_, signal);
}

std::uint64_t WorkerProcess::memory() const {
  std::ifstream statm(fmt::format("/proc/{}/statm", process_));
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

void end_orphans(const std::vector<pid_t>& known) {
  std::error_code failure;
  for (std::filesystem::directory_iterator thread("/proc/self/task", failure), end; !failure && thread != end;
       thread.increment(failure)) {
    std::ifstream list(thread->path() / "children");
    for (pid_t child = 0; list >> child;) {
      if (std::find(known.begin(), known.end(), child) != known.end()) continue;
      ::kill(child, SIGKILL);
      ::waitpid(child, nullptr, 0);
    }
  }
}

std::string how_ended(int status) {
  if (!WIFSIGNALED(status)) return fmt::format("exit code {}", WEXITSTATUS(status));
  const int signal = WTERMSIG(status);
  const char* name = ::sigabbrev_np(signal);
  return fmt::format("signal {} ({}{})", signal, name == nullptr ? "" : "SIG", name == nullptr ? "unknown" : name);
}

}  // namespace atrium
