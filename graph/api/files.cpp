#include "graph/api/files.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "graph/api/error.hpp"

namespace atrium {

std::string read_text(const std::filesystem::path& file) {
  const int number = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  std::string text;
  bool good = number >= 0;
  struct stat info {};
  if (good && ::fstat(number, &info) == 0 && S_ISREG(info.st_mode))
    text.reserve(static_cast<std::size_t>(info.st_size));
  char block[1U << 16U];
  while (good) {
    const ssize_t got = ::read(number, block, sizeof block);
    if (got == 0) break;
    if (got > 0)
      text.append(block, static_cast<std::size_t>(got));
    else
      good = errno == EINTR;
  }
  const int reason = errno;
  if (number >= 0) ::close(number);
  if (!good) throw Error("cannot read " + file.string() + ": " + std::generic_category().message(reason));
  return text;
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw Error("cannot make the folder " + folder.string() + ": " + error.message());
}

}  // namespace atrium
