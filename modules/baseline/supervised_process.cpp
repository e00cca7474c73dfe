#include "modules/baseline/supervised_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <system_error>
#include <thread>

#include "graph/api/error.hpp"

namespace atrium::baseline {
namespace {

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

struct Message {
  enum Kind : int { started, failed, ended } kind;
  int value;  // the program's number, errno, or its status
};

/// What stands ready before fork(): after it, only calls that are safe in a signal handler.
struct Prepared {
  std::string program, folder;
  std::vector<char*> arguments;
  int input = -1, log = -1, messages = -1;
  rlim_t address_space = RLIM_INFINITY;
};

void send(int to, Message message) {
  // Less than PIPE_BUF goes whole; who is not listening any more will end this process anyway.
  if (::write(to, &message, sizeof message) < 0) return;
}

[[noreturn]] void become(const Prepared& p) {
  ::setpgid(0, 0);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  ::signal(SIGPIPE, SIG_DFL);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  const rlimit space{p.address_space, p.address_space};
  const bool ready = (p.address_space == RLIM_INFINITY || ::setrlimit(RLIMIT_AS, &space) == 0) &&
                     ::dup2(p.input, STDIN_FILENO) >= 0 && ::dup2(p.log, STDOUT_FILENO) >= 0 &&
                     ::dup2(p.log, STDERR_FILENO) >= 0 && ::chdir(p.folder.c_str()) == 0;
  if (ready) ::execv(p.program.c_str(), p.arguments.data());
  send(p.messages, {Message::failed, errno});
  ::_exit(127);
}

[[noreturn]] void supervise(const Prepared& p) {
  ::setpgid(0, 0);  // signals of the terminal are for the run
  ::signal(SIGPIPE, SIG_IGN);
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);
  const pid_t program = ::fork();
  if (program == 0) become(p);
  // Other ends of other pipes, and those of this one: nobody shall wait for them.
  const long most = std::min(::sysconf(_SC_OPEN_MAX), 65536L);
  for (int i = 0; i < most; ++i)
    if (i != p.messages) ::close(i);
  if (program < 0) {
    send(p.messages, {Message::failed, errno});
    ::_exit(1);
  }
  send(p.messages, {Message::started, program});
  while (true) {
    int status = 0;
    const pid_t ended = ::waitpid(-1, &status, 0);
    if (ended == program) send(p.messages, {Message::ended, status});
    if (ended < 0 && errno != EINTR) ::_exit(0);
  }
}

/// The numbers of all processes and their parents'.
std::multimap<pid_t, pid_t> children_of_all() {
  std::multimap<pid_t, pid_t> children;
  std::error_code failure;
  for (std::filesystem::directory_iterator at("/proc", failure), end; !failure && at != end; at.increment(failure)) {
    const std::string name = at->path().filename().string();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    std::ifstream file(at->path() / "stat");
    std::string line;
    std::getline(file, line);
    const auto bracket = line.rfind(')');  // the name before it may hold anything
    if (bracket == std::string::npos) continue;
    std::istringstream rest(line.substr(bracket + 1));
    std::string state;
    pid_t parent = 0;
    if (rest >> state >> parent) children.emplace(parent, static_cast<pid_t>(std::stol(name)));
  }
  return children;
}

std::vector<pid_t> descendants(pid_t of) {
  const auto children = children_of_all();
  std::vector<pid_t> found{of};
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto [first, last] = children.equal_range(found[i]);
    for (auto child = first; child != last; ++child) found.push_back(child->second);
  }
  found.erase(found.begin());
  return found;
}

// Of the program itself: unlike wait4(2)'s, it leaves out what the process was before it became the program. Until then
// it counts for nothing.
double high_water_mebibytes(pid_t process) {
  std::error_code ignored;
  static const auto own = std::filesystem::read_symlink("/proc/self/exe", ignored);
  if (std::filesystem::read_symlink(fmt::format("/proc/{}/exe", process), ignored) == own) return 0;
  std::ifstream file(fmt::format("/proc/{}/status", process));
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("VmHWM:")) return std::strtod(line.c_str() + 6, nullptr) / 1024;
  return 0;
}

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

}  // namespace

SupervisedProcess::SupervisedProcess(std::vector<std::string> arguments, const std::filesystem::path& folder,
                                     double mebibytes) {
  Prepared p{program_file(arguments.at(0)).string(), folder.string(), {}};
  for (auto& a : arguments) p.arguments.push_back(a.data());
  p.arguments.push_back(nullptr);
  if (mebibytes > 0) p.address_space = static_cast<rlim_t>(mebibytes * 1024 * 1024);
  std::array<int, 2> log{-1, -1}, messages{-1, -1};
  p.input = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  const bool ready = p.input >= 0 && ::pipe2(log.data(), O_CLOEXEC) == 0 && ::pipe2(messages.data(), O_CLOEXEC) == 0;
  log_ = log[0];
  messages_ = messages[0];
  p.log = log[1];
  p.messages = messages[1];
  if (ready) supervisor_ = ::fork();
  if (supervisor_ == 0) supervise(p);
  const int number = errno;
  for (const int descriptor : {p.input, p.log, p.messages})
    if (descriptor >= 0) ::close(descriptor);
  if (supervisor_ < 0) {
    close_all();
    throw Error(fmt::format("cannot start {}: {}", p.program, reason(number)));
  }
  ::fcntl(log_, F_SETFL, O_NONBLOCK);
  ::fcntl(messages_, F_SETFL, O_NONBLOCK);
}

SupervisedProcess::~SupervisedProcess() {
  end();
  close_all();
}

void SupervisedProcess::close_all() {
  for (int* descriptor : {&log_, &messages_}) {
    if (*descriptor >= 0) ::close(*descriptor);
    *descriptor = -1;
  }
}

void SupervisedProcess::wait(int milliseconds, std::string& printed) {
  std::array<pollfd, 2> waited{pollfd{messages_, POLLIN, 0}, pollfd{log_, POLLIN, 0}};
  if (::poll(waited.data(), waited.size(), milliseconds) < 0) return;
  // Nobody else can print any more: do not turn round and round at the closed pipe.
  if ((waited[1].revents & (POLLIN | POLLHUP)) == POLLHUP && !status_) ::poll(waited.data(), 1, milliseconds);
  read_messages();  // before the log: what was printed before the end is there
  constexpr int most_at_once = 64;
  std::array<char, 65536> bytes{};
  for (int i = 0; i < most_at_once; ++i) {
    const ssize_t size = ::read(log_, bytes.data(), bytes.size());
    if (size <= 0) break;
    printed.append(bytes.data(), static_cast<std::size_t>(size));
  }
  look_at_memory();
}

void SupervisedProcess::read_messages() {
  Message message{};
  while (::read(messages_, &message, sizeof message) == sizeof message) {
    if (message.kind == Message::started) program_ = message.value;
    if (message.kind == Message::failed) failure_ = message.value;
    if (message.kind == Message::ended) status_ = message.value;
  }
}

void SupervisedProcess::look_at_memory() {
  if (program_ > 0 && !status_) peak_ = std::max(peak_, high_water_mebibytes(program_));
  constexpr double interval = 0.1;
  if (now() - looked_ < interval) return;
  looked_ = now();
  for (const pid_t process : descendants(supervisor_)) peak_ = std::max(peak_, high_water_mebibytes(process));
}

void SupervisedProcess::terminate() const {
  if (program_ > 0 && !status_) ::kill(-program_, SIGTERM);
}

void SupervisedProcess::end() {
  if (supervisor_ <= 0) return;
  // The supervisor ends when it has no child left; it is not waited for before, so the numbers are still theirs.
  siginfo_t info{};
  for (auto pause = std::chrono::milliseconds(0);; pause = std::chrono::milliseconds(1)) {
    info.si_pid = 0;
    const int waited = ::waitid(P_PID, static_cast<id_t>(supervisor_), &info, WEXITED | WNOHANG | WNOWAIT);
    if (waited != 0 || info.si_pid == supervisor_) break;
    for (const pid_t process : descendants(supervisor_)) ::kill(process, SIGKILL);
    std::this_thread::sleep_for(pause);
  }
  while (::waitpid(supervisor_, nullptr, 0) < 0 && errno == EINTR) {
  }
  supervisor_ = -1;
}

}  // namespace atrium::baseline
