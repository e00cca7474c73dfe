// The frame of a helper program: request on the standard input, reply on the standard output; what libraries print goes
// to the standard error.
#include "helper_main.hpp"

#include <sys/prctl.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <string>

#include "graph/api/standard_streams.hpp"

namespace {

std::string read_all(int file) {
  std::string bytes;
  char buffer[1 << 16];
  for (ssize_t size = 0; (size = ::read(file, buffer, sizeof buffer)) > 0;) bytes.append(buffer, size);
  return bytes;
}

bool write_all(int file, const std::string& bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t size = ::write(file, bytes.data() + done, bytes.size() - done);
    if (size <= 0) return false;
    done += static_cast<std::size_t>(size);
  }
  return true;
}

}  // namespace

int main() {
  atrium::secure_standard_streams();
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // nothing is left of a run that is killed
  const int replies = ::dup(STDOUT_FILENO);
  ::dup2(STDERR_FILENO, STDOUT_FILENO);
  try {
    const auto request = atrium::baseline::from_bytes(read_all(STDIN_FILENO));
    return write_all(replies, to_bytes(atrium::baseline::computed(request))) ? 0 : 3;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
