#include "graph/cache/mapped_file.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "graph/api/error.hpp"

namespace atrium {

MappedFile::MappedFile(const std::filesystem::path& file) {
  const auto fail = [&] {
    throw Error("cannot read " + file.string() + ": " + std::generic_category().message(errno));
  };
  const int number = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (number < 0) fail();
  struct stat info {};
  void* map = nullptr;
  bool good = ::fstat(number, &info) == 0;
  if (good && !S_ISREG(info.st_mode)) {
    good = false;
    errno = EINVAL;
  }
  if (good && info.st_size > 0) {
    map = ::mmap(nullptr, static_cast<std::size_t>(info.st_size), PROT_READ, MAP_PRIVATE | MAP_POPULATE, number, 0);
    good = map != MAP_FAILED;
  }
  const int reason = errno;
  ::close(number);
  errno = reason;
  if (!good) fail();
  data_ = static_cast<const std::byte*>(map);
  size_ = static_cast<std::size_t>(info.st_size);
}

MappedFile::~MappedFile() {
  if (size_ > 0) ::munmap(const_cast<std::byte*>(data_), size_);
}

}  // namespace atrium
