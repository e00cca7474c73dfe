#include "modules/baseline/child_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <system_error>
#include <thread>

#include "graph/api/error.hpp"

namespace atrium::baseline {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds grace{2};  // between SIGTERM and SIGKILL

std::string reason(int number) { return std::generic_category().message(number); }

bool is_program(const std::filesystem::path& file) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(file, ignored) && ::access(file.c_str(), X_OK) == 0;
}

std::filesystem::path program_file(const std::string& name) {
  if (name.find('/') != std::string::npos) {
    if (is_program(name)) return std::filesystem::absolute(name);
    throw Error(fmt::format("there is no program '{}'", name), "give the path of a file that can be executed");
  }
  const char* list = std::getenv("PATH");
  std::istringstream folders(list != nullptr ? list : "/usr/bin:/bin");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const auto file = std::filesystem::path(folder.empty() ? "." : folder) / name;
    if (!name.empty() && is_program(file)) return std::filesystem::absolute(file);
  }
  throw Error(fmt::format("there is no program '{}'", name), "install it, or give its path; it was looked for in PATH");
}

/// A file descriptor that is closed at last.
struct Descriptor {
  explicit Descriptor(int descriptor) : number(descriptor) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  void close() {
    if (number >= 0) ::close(number);
    number = -1;
  }
  int number;
};

/// What stands ready before fork(): after it, only calls that are safe in a signal handler.
struct Prepared {
  std::string program, folder;
  std::vector<char*> arguments;
  int input = -1, log = -1, failure = -1;
  rlim_t address_space = RLIM_INFINITY;
};

[[noreturn]] void become(const Prepared& p) {
  ::setpgid(0, 0);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  const rlimit space{p.address_space, p.address_space};
  const bool ready = (p.address_space == RLIM_INFINITY || ::setrlimit(RLIMIT_AS, &space) == 0) &&
                     ::dup2(p.input, STDIN_FILENO) >= 0 && ::dup2(p.log, STDOUT_FILENO) >= 0 &&
                     ::dup2(p.log, STDERR_FILENO) >= 0 && ::chdir(p.folder.c_str()) == 0;
  if (ready) ::execv(p.program.c_str(), p.arguments.data());
  const int number = errno;
  const ssize_t written = ::write(p.failure, &number, sizeof number);
  ::_exit(written > 0 ? 127 : 126);
}

/// The group of processes; whatever is left of it is killed when it goes out of sight.
class Group {
 public:
  explicit Group(const ChildProcess& child) {
    Descriptor input(::open("/dev/null", O_RDONLY | O_CLOEXEC));
    Descriptor log(::open(child.log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0644));
    int ends[2] = {-1, -1};
    if (log.number < 0 || ::pipe2(ends, O_CLOEXEC) != 0)
      throw Error(fmt::format("cannot write the log '{}': {}", child.log.string(), reason(errno)));
    Descriptor from(ends[0]), to(ends[1]);
    std::vector<std::string> arguments = child.arguments;
    Prepared p{program_file(arguments.at(0)).string(), child.folder.string(), {}, input.number, log.number, to.number};
    for (auto& a : arguments) p.arguments.push_back(a.data());
    p.arguments.push_back(nullptr);
    if (child.mebibytes > 0) p.address_space = static_cast<rlim_t>(child.mebibytes * 1024 * 1024);
    id_ = ::fork();
    if (id_ < 0) throw Error(fmt::format("cannot start {}: {}", p.program, reason(errno)));
    if (id_ == 0) become(p);
    ::setpgid(id_, id_);  // whoever comes first
    to.close();
    int number = 0;
    if (::read(from.number, &number, sizeof number) > 0) {
      end();
      throw Error(fmt::format("cannot start {}: {}", p.program, reason(number)));
    }
  }
  ~Group() { end(); }
  Group(const Group&) = delete;
  Group& operator=(const Group&) = delete;

  // Whether the first process has ended; it is not waited for, so its number stays taken.
  bool ended() const {
    siginfo_t info{};
    return ::waitid(P_PID, static_cast<id_t>(id_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == id_;
  }
  // Asks the group to end and gives it a while.
  void terminate() const {
    ::kill(-id_, SIGTERM);
    const auto until = Clock::now() + grace;
    while (!ended() && Clock::now() < until) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  // Kills what is left and takes the status of the first process.
  void end() {
    if (id_ <= 0) return;
    ::kill(-id_, SIGKILL);
    while (::wait4(id_, &status_, 0, &usage_) < 0 && errno == EINTR) {
    }
    id_ = -1;
  }
  int status() const { return status_; }
  double peak_mebibytes() const { return static_cast<double>(usage_.ru_maxrss) / 1024; }

 private:
  pid_t id_ = -1;
  int status_ = 0;
  rusage usage_{};
};

// The last lines of a log.
std::string tail(const std::filesystem::path& log) {
  constexpr std::streamoff most = 1000;
  std::ifstream file(log, std::ios::binary | std::ios::ate);
  const std::streamoff size = file.tellg();
  file.seekg(std::max<std::streamoff>(0, size - most));
  std::string text((std::istreambuf_iterator<char>(file)), {});
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) text.pop_back();
  return text.empty() ? "it printed nothing" : "the last that it printed: " + text;
}

}  // namespace

ChildResult run_child(const ChildProcess& child, Context& context) {
  const std::string& name = child.arguments.at(0);
  const auto start = Clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  Group group(child);
  for (auto pause = std::chrono::milliseconds(1); !group.ended();
       pause = std::min(2 * pause, std::chrono::milliseconds(10))) {
    const bool late = child.seconds > 0 && elapsed() > child.seconds;
    if (late || context.cancelled()) group.terminate();
    context.check_cancelled();
    if (late) throw Error(fmt::format("{} was ended at its time limit of {} s", name, child.seconds), tail(child.log));
    std::this_thread::sleep_for(pause);
  }
  ChildResult result;
  result.seconds = elapsed();
  group.end();
  result.mebibytes = group.peak_mebibytes();
  const int status = group.status();
  if (WIFSIGNALED(status))
    throw Error(fmt::format("{} was ended by the signal '{}'", name, ::strsignal(WTERMSIG(status))), tail(child.log));
  if (WEXITSTATUS(status) != 0)
    throw Error(fmt::format("{} ended with exit code {}", name, WEXITSTATUS(status)), tail(child.log));
  return result;
}

}  // namespace atrium::baseline
