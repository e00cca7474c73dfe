#include "graph/api/helper_process.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <optional>
#include <thread>

#include "graph/api/error.hpp"
#include "graph/api/helper_memory.hpp"

namespace atrium {
namespace {

std::string reason() { return std::generic_category().message(errno); }

/// A file without a name, in memory, that a process reads or writes as its standard stream.
class MemoryFile {
 public:
  explicit MemoryFile(const char* name) : file_(::memfd_create(name, MFD_CLOEXEC)) {
    if (file_ < 0) throw Error(fmt::format("cannot make a file in memory: {}", reason()));
  }
  ~MemoryFile() { ::close(file_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  int descriptor() const { return file_; }

  void write(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t done = ::write(file_, bytes.data(), bytes.size());
      if (done < 0 && errno == EINTR) continue;
      if (done <= 0) throw Error(fmt::format("cannot hand {} bytes to a helper program: {}", bytes.size(), reason()));
      bytes.remove_prefix(static_cast<std::size_t>(done));
    }
    ::lseek(file_, 0, SEEK_SET);
  }

  std::string read() const {
    std::string bytes(static_cast<std::size_t>(std::max<off_t>(0, ::lseek(file_, 0, SEEK_END))), '\0');
    std::size_t size = 0;
    while (size < bytes.size()) {
      const ssize_t done = ::pread(file_, bytes.data() + size, bytes.size() - size, static_cast<off_t>(size));
      if (done < 0 && errno == EINTR) continue;
      if (done <= 0) break;
      size += static_cast<std::size_t>(done);
    }
    bytes.resize(size);
    return bytes;
  }

 private:
  int file_;
};

/// A child process; killed when it goes out of sight unless it has ended.
class Process {
 public:
  Process(const std::filesystem::path& program, const MemoryFile& in, const MemoryFile& out, const MemoryFile& log) {
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, in.descriptor(), STDIN_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, out.descriptor(), STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, log.descriptor(), STDERR_FILENO);
    posix_spawnattr_t attributes;
    ::posix_spawnattr_init(&attributes);
    // In a group of its own: Ctrl-C is for the run, which then ends its helpers itself.
    ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    std::string file = program.string();
    char* arguments[] = {file.data(), nullptr};
    const int failure = ::posix_spawn(&id_, file.c_str(), &actions, &attributes, arguments, environ);
    ::posix_spawnattr_destroy(&attributes);
    ::posix_spawn_file_actions_destroy(&actions);
    if (failure != 0) throw Error(fmt::format("cannot start {}: {}", file, std::generic_category().message(failure)));
  }
  ~Process() {
    if (status_) return;
    ::kill(id_, SIGKILL);
    ::waitpid(id_, nullptr, 0);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  bool ended() {
    int status = 0;
    look_at_memory();
    if (!status_ && ::waitpid(id_, &status, WNOHANG) == id_) status_ = status;
    return status_.has_value();
  }
  int status() const { return *status_; }
  // As far as it was looked at. Not wait4(2)'s: that starts with the peak of what the process was before exec.
  double peak_mebibytes() const { return peak_; }
  double resident_mebibytes() const { return resident_; }

 private:
  void look_at_memory() {
    std::ifstream file(fmt::format("/proc/{}/status", id_));
    for (std::string line; std::getline(file, line);) {
      if (line.starts_with("VmHWM:")) peak_ = std::strtod(line.c_str() + 6, nullptr) / 1024;
      if (line.starts_with("VmRSS:")) resident_ = std::strtod(line.c_str() + 6, nullptr) / 1024;
    }
  }
  pid_t id_ = -1;
  std::optional<int> status_;
  double peak_ = 0, resident_ = 0;
};

std::string last_line(std::string log) {
  while (!log.empty() && std::isspace(static_cast<unsigned char>(log.back())) != 0) log.pop_back();
  return log.substr(log.rfind('\n') + 1);
}

double wait_for(Process& process, const HelperProcess& helper, const Context& context) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  for (auto pause = std::chrono::milliseconds(1);; pause = std::min(2 * pause, std::chrono::milliseconds(10))) {
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    if (process.ended()) return seconds;
    context.check_cancelled();
    if (helper.seconds > 0 && seconds > helper.seconds)
      throw Error(fmt::format("{} was stopped after {} s, its time limit", helper.name, helper.seconds),
                  helper.at_time_limit);
    if (helper.mebibytes > 0 && process.resident_mebibytes() > helper.mebibytes)
      throw Error(fmt::format("{} was stopped at its memory limit of {} MiB, after {:.1f} s", helper.name,
                              helper.mebibytes, seconds),
                  helper.at_memory_limit);
    std::this_thread::sleep_for(pause);
  }
}

}  // namespace

std::filesystem::path folder_of_library(const void* address) {
  Dl_info info{};
  if (::dladdr(address, &info) == 0 || info.dli_fname == nullptr) return {};
  std::error_code ignored;
  return std::filesystem::canonical(info.dli_fname, ignored).parent_path();
}

HelperReply run_helper_process(const HelperProcess& helper, std::string_view request, const Context& context) {
  const MemoryFile in("request");
  const MemoryFile out("reply");
  const MemoryFile log("log");
  in.write(request);
  Process process(helper.file, in, out, log);
  HelperReply reply;
  reply.seconds = wait_for(process, helper, context);
  reply.mebibytes = process.peak_mebibytes();
  note_helper_memory(static_cast<std::uint64_t>(reply.mebibytes * 1024 * 1024));
  if (process.status() != 0) {
    const std::string end = WIFSIGNALED(process.status())
                                ? fmt::format("was ended by the signal '{}'", ::strsignal(WTERMSIG(process.status())))
                                : fmt::format("ended with {}", WEXITSTATUS(process.status()));
    throw Error(fmt::format("{} {} after {:.1f} s and {:.0f} MiB", helper.name, end, reply.seconds, reply.mebibytes),
                fmt::format("the last that it printed: {}", last_line(log.read())));
  }
  reply.bytes = out.read();
  return reply;
}

}  // namespace atrium
