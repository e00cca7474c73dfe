#include "graph/api/mapped_file.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "graph/api/error.hpp"

namespace atrium {
namespace {

[[noreturn]] void fail(const std::string& path, int error) {
  throw Error("cannot read " + path + ": " + std::strerror(error));
}

/// Closes at the end of the scope.
struct Descriptor {
  explicit Descriptor(const std::string& path) : number(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number;
};

}  // namespace

MappedFile::MappedFile(const std::filesystem::path& path, Kinds kinds) : path_(path.string()) {
  const Descriptor file(path_);
  if (file.number < 0) fail(path_, errno);
  struct stat status {};
  if (::fstat(file.number, &status) != 0) fail(path_, errno);
  if (S_ISDIR(status.st_mode)) fail(path_, EISDIR);
  if (!S_ISREG(status.st_mode)) {
    if (kinds == Kinds::regular) fail(path_, EINVAL);
    read_all(file.number);
    return;
  }
  size_ = static_cast<std::size_t>(status.st_size);
  if (size_ == 0) return;
  void* mapping = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file.number, 0);
  if (mapping == MAP_FAILED) fail(path_, errno);
  mapping_ = mapping;
  ::madvise(mapping_, size_, MADV_WILLNEED);
  data_ = static_cast<const std::byte*>(mapping_);
}

MappedFile::~MappedFile() {
  if (mapping_ != nullptr) ::munmap(mapping_, size_);
}

void MappedFile::read_all(int descriptor) {
  constexpr std::size_t block = std::size_t{1} << 20U;
  for (;;) {
    buffer_.resize(size_ + block);
    const ssize_t got = ::read(descriptor, buffer_.data() + size_, block);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail(path_, errno);
    if (got == 0) break;
    size_ += static_cast<std::size_t>(got);
  }
  data_ = buffer_.data();
}

}  // namespace atrium
