#pragma once
#include <fcntl.h>
#include <unistd.h>

#include <cstdio>

namespace atrium {

/// Opens /dev/null as the file `number` if that is closed. Returns whether it was open before.
inline bool keep_occupied(int number, int how) {
  if (::fcntl(number, F_GETFD) != -1) return true;
  int opened = ::open("/dev/null", how);           // NOLINT(android-cloexec-open): children are to have it, too
  if (opened < 0) opened = ::open("/", O_RDONLY);  // NOLINT(android-cloexec-open): what is written there fails
  if (opened < 0 || opened == number) return false;
  ::dup2(opened, number);
  ::close(opened);
  return false;
}

/// To be called first in main: of the files 0 to 2 those that are closed (daemons, some job runners) lead to /dev/null
/// then. Otherwise the next files that are opened would have their numbers, and what is printed would go into them.
/// What is written to such a standard output fails, since nobody would get it. Returns whether there is a standard
/// output.
inline bool secure_standard_streams() {
  keep_occupied(STDIN_FILENO, O_RDONLY);
  const bool has_output = keep_occupied(STDOUT_FILENO, O_RDONLY);
  keep_occupied(STDERR_FILENO, O_WRONLY);
  return has_output;
}

/// While it lives, what is printed to the standard output goes to the standard error: the libraries behind nodes print
/// what they like (PCL's solvers do), and the standard output holds results only. The buffers of stdout are emptied
/// before and after. Of the whole program: one at a time, and nothing else may be printing results.
class StandardOutputSetAside {
 public:
  StandardOutputSetAside() {
    std::fflush(stdout);
    was_good_ = std::ferror(stdout) == 0;
    constexpr int above_the_standard_ones = 3;
    kept_ = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, above_the_standard_ones);
    if (kept_ >= 0) ::dup2(STDERR_FILENO, STDOUT_FILENO);
  }
  ~StandardOutputSetAside() {
    std::fflush(stdout);
    if (kept_ < 0) return;
    ::dup2(kept_, STDOUT_FILENO);
    ::close(kept_);
    if (was_good_) std::clearerr(stdout);  // what a full standard error has lost is no result
  }
  StandardOutputSetAside(const StandardOutputSetAside&) = delete;
  StandardOutputSetAside& operator=(const StandardOutputSetAside&) = delete;

 private:
  int kept_ = -1;
  bool was_good_ = true;
};

}  // namespace atrium
