#include "graph/api/supervised_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
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
#include <utility>

#include "graph/api/error.hpp"

namespace atrium {
namespace {

std::string reason(int number) { return std::generic_category().message(number); }

bool is_program(const std::filesystem::path& file) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(file, ignored) && ::access(file.c_str(), X_OK) == 0;
}

struct Message {
  enum Kind : int { started, failed, ended } kind;
  int value;  // the program's number, errno, or its status
};

/// What stands ready before fork(): after it, only calls that are safe in a signal handler.
struct Prepared {
  std::string program, folder;
  std::vector<char*> arguments;
  int input = -1, log = -1, messages = -1, events = -1;
  rlim_t address_space = RLIM_INFINITY;
  bool ignores_interrupt = false;  ///< SIGINT, as the parent of this process had it
};

void send(int to, Message message) {
  // Less than PIPE_BUF goes whole; who is not listening any more will end this process anyway.
  if (::write(to, &message, sizeof message) < 0) return;
}

[[noreturn]] void become(const Prepared& p, pid_t supervisor) {
  ::setpgid(0, 0);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  for (const int signal : {SIGPIPE, SIGCHLD, SIGTERM, SIGXFSZ}) ::signal(signal, SIG_DFL);
  if (!p.ignores_interrupt) ::signal(SIGINT, SIG_DFL);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != supervisor) ::_exit(127);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  const rlimit space{p.address_space, p.address_space};
  const bool ready = (p.address_space == RLIM_INFINITY || ::setrlimit(RLIMIT_AS, &space) == 0) &&
                     ::dup2(p.input, STDIN_FILENO) >= 0 && ::dup2(p.log, STDOUT_FILENO) >= 0 &&
                     ::dup2(p.log, STDERR_FILENO) >= 0 &&
                     (p.events < 0 || ::dup2(p.events, SupervisedProcess::events_file) >= 0) &&
                     (p.folder.empty() || ::chdir(p.folder.c_str()) == 0);
  if (ready) ::execv(p.program.c_str(), p.arguments.data());
  send(p.messages, {Message::failed, errno});
  ::_exit(127);
}

[[noreturn]] void supervise(const Prepared& p, pid_t parent) {
  ::setpgid(0, 0);  // signals of the terminal are for the run
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(127);
  ::signal(SIGPIPE, SIG_IGN);
  ::signal(SIGCHLD, SIG_DFL);  // if it is ignored, the end of a child is not told
  ::signal(SIGINT, SIG_IGN);   // what the run's handlers do is not for this process
  ::signal(SIGTERM, SIG_IGN);
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);
  const pid_t self = ::getpid();
  const pid_t program = ::fork();
  if (program == 0) become(p, self);
  const int refusal = errno;
  // Other ends of other pipes, and those of this one: nobody shall wait for them.
  const long most = std::min(::sysconf(_SC_OPEN_MAX), 65536L);
  for (int i = 0; i < most; ++i)
    if (i != p.messages) ::close(i);
  if (program < 0) {
    send(p.messages, {Message::failed, refusal});
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

/// Not one of the numbers that a child's standard streams and events have, which a parent without them would give.
int out_of_the_way(int descriptor) {
  constexpr int first = 10;
  if (descriptor < 0 || descriptor >= first) return descriptor;
  const int moved = ::fcntl(descriptor, F_DUPFD_CLOEXEC, first);
  ::close(descriptor);
  return moved;
}

/// A pipe whose reading end does not wait.
bool make_pipe(int& read, int& write) {
  std::array<int, 2> ends{-1, -1};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return false;
  read = out_of_the_way(ends[0]);
  write = out_of_the_way(ends[1]);
  return read >= 0 && write >= 0 && ::fcntl(read, F_SETFL, O_NONBLOCK) == 0;
}

/// What is there, but not for ever from a program that prints without end. At its end the file is closed.
void append_all(int& file, std::string& text) {
  constexpr int most_at_once = 64;
  std::array<char, 65536> bytes{};
  for (int i = 0; i < most_at_once && file >= 0; ++i) {
    const ssize_t size = ::read(file, bytes.data(), bytes.size());
    if (size < 0 && (errno == EAGAIN || errno == EINTR)) return;
    if (size <= 0) {  // what cannot be read has ended
      ::close(std::exchange(file, -1));
      return;
    }
    text.append(bytes.data(), static_cast<std::size_t>(size));
  }
}

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

}  // namespace

std::filesystem::path program_file(const std::string& name) {
  if (name.find('/') != std::string::npos) {
    if (is_program(name)) return std::filesystem::absolute(name);
    throw Error(fmt::format("there is no program '{}'", name), "give the path of a file that can be executed");
  }
  const char* list = std::getenv("PATH");  // NOLINT(concurrency-mt-unsafe)
  std::istringstream folders(list != nullptr ? list : "/usr/bin:/bin");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const auto file = std::filesystem::path(folder.empty() ? "." : folder) / name;
    if (!name.empty() && is_program(file)) return std::filesystem::absolute(file);
  }
  throw Error(fmt::format("there is no program '{}'", name), "install it, or give its path; it was looked for in PATH");
}

int run_program(const std::vector<std::string>& arguments) {
  std::vector<std::string> words = arguments;
  std::vector<char*> list;
  list.reserve(words.size() + 1);
  for (auto& word : words) list.push_back(word.data());
  list.push_back(nullptr);
  const std::string program = program_file(words.at(0)).string();
  pid_t process = -1;
  posix_spawnattr_t attributes;
  sigset_t usual;  // what this program ignores is not for others
  ::sigemptyset(&usual);
  for (const int signal : {SIGPIPE, SIGXFSZ}) ::sigaddset(&usual, signal);
  ::posix_spawnattr_init(&attributes);
  ::posix_spawnattr_setsigdefault(&attributes, &usual);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  const int problem = ::posix_spawn(&process, program.c_str(), nullptr, &attributes, list.data(), environ);
  ::posix_spawnattr_destroy(&attributes);
  if (problem != 0) throw Error(fmt::format("cannot start {}: {}", program, reason(problem)));
  int status = 0;
  while (::waitpid(process, &status, 0) < 0)
    if (errno != EINTR) throw Error(fmt::format("cannot wait for {}: {}", program, reason(errno)));
  return status;
}

SupervisedProcess::SupervisedProcess(const Start& start) {
  std::vector<std::string> arguments = start.arguments;
  Prepared p{program_file(arguments.at(0)).string(), start.folder.string(), {}};
  for (auto& a : arguments) p.arguments.push_back(a.data());
  p.arguments.push_back(nullptr);
  if (start.mebibytes > 0) p.address_space = static_cast<rlim_t>(start.mebibytes * 1024 * 1024);
  p.input = out_of_the_way(::open("/dev/null", O_RDONLY | O_CLOEXEC));
  bool ready = p.input >= 0 && make_pipe(log_, p.log) && make_pipe(messages_, p.messages);
  if (start.tells) ready = ready && make_pipe(events_, p.events);
  struct sigaction interrupt {};
  ::sigaction(SIGINT, nullptr, &interrupt);
  p.ignores_interrupt = interrupt.sa_handler == SIG_IGN;
  const pid_t parent = ::getpid();
  if (ready) supervisor_ = ::fork();
  if (supervisor_ == 0) supervise(p, parent);
  const int number = errno;
  for (const int descriptor : {p.input, p.log, p.messages, p.events})
    if (descriptor >= 0) ::close(descriptor);
  if (supervisor_ < 0) {
    close_all();
    throw Error(fmt::format("cannot start {}: {}", p.program, reason(number)));
  }
}

SupervisedProcess::~SupervisedProcess() {
  end();
  close_all();
}

void SupervisedProcess::close_all() {
  for (int* descriptor : {&log_, &messages_, &events_}) {
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
  append_all(log_, printed);
  look_at_memory();
}

void SupervisedProcess::read(std::string& printed, std::string& events) {
  read_messages();
  append_all(log_, printed);
  append_all(events_, events);
}

void SupervisedProcess::read_messages() {
  if (messages_ < 0) return;
  constexpr auto whole = static_cast<ssize_t>(sizeof(Message));
  Message message{};
  ssize_t size = 0;
  while ((size = ::read(messages_, &message, sizeof message)) == whole) {
    if (message.kind == Message::started) program_ = message.value;
    if (message.kind == Message::failed) failure_ = message.value;
    if (message.kind == Message::ended) status_ = message.value;
  }
  if (size < 0 && (errno == EAGAIN || errno == EINTR)) return;
  ::close(std::exchange(messages_, -1));
  if (!status_ && !failure_) status_ = SIGKILL;  // the supervisor is killed or cannot be heard: its program is too
}

void SupervisedProcess::look_at_memory() {
  if (program_ > 0 && !status_) peak_ = std::max(peak_, high_water_mebibytes(program_));
  constexpr double interval = 0.1;
  if (now() - looked_ < interval) return;
  looked_ = now();
  for (const pid_t process : descendants(supervisor_)) peak_ = std::max(peak_, high_water_mebibytes(process));
}

bool SupervisedProcess::terminate() const { return status_ || (program_ > 0 && ::kill(-program_, SIGTERM) == 0); }

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

}  // namespace atrium
