#pragma once
#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <signal.h>  // NOLINT(modernize-deprecated-headers): kill
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace atrium::test {

struct ProcessOptions {
  std::filesystem::path folder;          ///< working folder; empty: the test's own
  std::vector<std::string> environment;  ///< "NAME=VALUE", in addition to the test's own; there is no cache otherwise
  double timeout = 60;                   ///< seconds, then the process is killed
  bool terminal = false;                 ///< stderr is a terminal of 80 columns
  /// Called every few milliseconds while the process runs, with what it has written to stderr so far.
  std::function<void(pid_t process, const std::string& err)> watch;
};

struct ProcessResult {
  int exit_code = -1;  ///< 128 + the signal's number if a signal ended it
  bool timed_out = false;
  std::string out, err;
};

namespace detail {

struct Channel {
  int parent = -1, child = -1;
};
inline Channel make_pipe() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("pipe");
  return {ends[0], ends[1]};
}
inline Channel make_terminal() {
  Channel channel;
  winsize size{};
  size.ws_row = 25;
  size.ws_col = 80;
  if (::openpty(&channel.parent, &channel.child, nullptr, nullptr, &size) != 0) throw std::runtime_error("openpty");
  ::fcntl(channel.parent, F_SETFD, FD_CLOEXEC);
  return channel;
}

[[noreturn]] inline void become(const std::vector<std::string>& command, const ProcessOptions& options, int out,
                                int err) {
  ::dup2(out, STDOUT_FILENO);
  ::dup2(err, STDERR_FILENO);
  if (!options.folder.empty() && ::chdir(options.folder.c_str()) != 0) ::_exit(127);
  ::setenv("ATRIUM_CACHE", "off", 1);  // NOLINT(concurrency-mt-unsafe): the user's is no part of a test
  for (const auto& variable : options.environment) ::putenv(const_cast<char*>(variable.c_str()));
  std::vector<char*> arguments;
  for (const auto& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  ::execvp(arguments[0], arguments.data());
  ::_exit(127);
}

/// Adds what is there to read; false at the end of the stream (a closed terminal says EIO).
inline bool drain(int file, std::string& text) {
  std::array<char, 4096> buffer{};
  const ssize_t size = ::read(file, buffer.data(), buffer.size());
  if (size > 0) text.append(buffer.data(), static_cast<std::size_t>(size));
  return size > 0;
}

}  // namespace detail

/// Runs a program to its end and gives what it returned and wrote.
inline ProcessResult run_process(const std::vector<std::string>& command, const ProcessOptions& options = {}) {
  const detail::Channel out = detail::make_pipe();
  const detail::Channel err = options.terminal ? detail::make_terminal() : detail::make_pipe();
  const pid_t process = ::fork();
  if (process < 0) throw std::runtime_error("fork");
  if (process == 0) detail::become(command, options, out.child, err.child);
  ::close(out.child);
  ::close(err.child);
  ProcessResult result;
  std::array<pollfd, 2> files{{{out.parent, POLLIN, 0}, {err.parent, POLLIN, 0}}};
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(options.timeout);
  while (files[0].fd >= 0 || files[1].fd >= 0) {
    ::poll(files.data(), files.size(), 5);
    if (files[0].revents != 0 && !detail::drain(files[0].fd, result.out)) files[0].fd = -1;
    if (files[1].revents != 0 && !detail::drain(files[1].fd, result.err)) files[1].fd = -1;
    if (options.watch) options.watch(process, result.err);
    if (!result.timed_out && std::chrono::steady_clock::now() > end) {
      result.timed_out = true;
      ::kill(process, SIGKILL);
    }
  }
  int status = 0;
  ::waitpid(process, &status, 0);
  ::close(out.parent);
  ::close(err.parent);
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}

}  // namespace atrium::test
