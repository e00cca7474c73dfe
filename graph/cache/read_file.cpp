#include "graph/cache/read_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <vector>

#include "graph/api/context.hpp"
#include "graph/api/walk.hpp"

namespace atrium {
namespace {

constexpr std::size_t piece = std::size_t{1} << 20U;

[[noreturn]] void fail_reading(const std::filesystem::path& path, int reason) {
  throw UnreadableFile("cannot read " + path.string() + ": " + std::generic_category().message(reason));
}

/// Calls see(data, size) for the first `size` bytes of the file, in pieces.
template <class See>
void for_each_piece(const ReadFile& file, std::uint64_t size, See see) {
  std::vector<char> buffer(static_cast<std::size_t>(std::min<std::uint64_t>(size, piece)));
  for (std::uint64_t at = 0; at < size; at += buffer.size()) {
    const auto part = static_cast<std::size_t>(std::min<std::uint64_t>(buffer.size(), size - at));
    file.read(buffer.data(), at, part);
    see(buffer.data(), part);
  }
}

}  // namespace

ReadFile::ReadFile(const std::filesystem::path& path) : path_(path) {
  // Without waiting: to open a pipe would be to take part in it.
  file_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file_ < 0) fail_reading(path_, errno);
  struct stat status {};
  const int reason = ::fstat(file_, &status) != 0 ? errno : S_ISDIR(status.st_mode) ? EISDIR : EINVAL;
  if (!S_ISREG(status.st_mode)) {
    ::close(file_);
    fail_reading(path_, reason);
  }
  size_ = static_cast<std::uint64_t>(status.st_size);
  ::posix_fadvise(file_, 0, 0, POSIX_FADV_SEQUENTIAL);
}

ReadFile::~ReadFile() { ::close(file_); }

void ReadFile::read(void* to, std::uint64_t at, std::size_t size) const {
  auto* data = static_cast<char*>(to);
  while (size > 0) {
    const ssize_t got = ::pread(file_, data, size, static_cast<off_t>(at));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail_reading(path_, errno);
    if (got == 0) throw UnreadableFile("cannot read " + path_.string() + ": it has become shorter");
    data += got;
    at += static_cast<std::uint64_t>(got);
    size -= static_cast<std::size_t>(got);
  }
}

std::string ReadFile::hash(std::uint64_t size) const {
  ContentHash hash;
  for_each_piece(*this, size, [&](const char* data, std::size_t part) { hash.bytes(data, part); });
  return hash.hex();
}

std::string copy_hashed(const ReadFile& from, const std::filesystem::path& to, const std::string& wanted) {
  AtomicFile out(to);
  ContentHash hash;
  for_each_piece(from, from.size(), [&](const char* data, std::size_t part) {
    hash.bytes(data, part);
    out.write(data, part);
  });
  std::string digest = hash.hex();
  if (wanted.empty() || digest == wanted) out.publish();
  return digest;
}

}  // namespace atrium
