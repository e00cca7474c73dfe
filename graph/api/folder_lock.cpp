#include "graph/api/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>

#include "graph/api/error.hpp"
#include "graph/api/text.hpp"

namespace atrium {
namespace {

std::string who_am_i() { return fmt::format("process {} on {}\n", ::getpid(), host_name()); }

std::string read_holder(int file) {
  std::array<char, 400> text{};
  const ssize_t size = ::pread(file, text.data(), text.size(), 0);
  std::string holder(text.data(), size > 0 ? static_cast<std::size_t>(size) : 0);
  holder.resize(std::min(holder.find('\n'), holder.size()));
  return holder.empty() ? "another process" : holder;
}

/// Whether the path still leads to the open file: who ended last has removed it.
bool is_there(int file, const std::filesystem::path& path) {
  struct stat open {};
  struct stat there {};
  return ::fstat(file, &open) == 0 && ::lstat(path.c_str(), &there) == 0 && open.st_ino == there.st_ino &&
         open.st_dev == there.st_dev;
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder, Kind kind) : path_(folder / lock_file_name), kind_(kind) {
  const auto fail = [&](const std::string& what, int reason) {
    if (file_ >= 0) ::close(file_);
    throw Error(fmt::format("cannot {} {}: {}", what, path_.string(), std::generic_category().message(reason)),
                what == "lock" ? "two processes could write into this folder at once: take one on a file system that "
                                 "has locks (of NFS: with a lock service, not mounted with 'nolock')"
                               : "");
  };
  while (true) {
    file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (file_ < 0) fail("open", errno);
    if (::flock(file_, (kind == Kind::alone ? LOCK_EX : LOCK_SH) | LOCK_NB) != 0) {
      if (errno != EWOULDBLOCK) fail("lock", errno);
      holder_ = read_holder(file_);
      ::close(file_);
      file_ = -1;
      return;
    }
    if (is_there(file_, path_)) break;
    ::close(file_);
  }
  const std::string text = who_am_i();
  if (::ftruncate(file_, 0) != 0 || ::pwrite(file_, text.data(), text.size(), 0) < 0) fail("write", errno);
}

FolderLock::~FolderLock() {
  if (file_ < 0) return;
  // While it is held alone: whoever waits for it makes a new file. Of several that share it the last one may.
  if ((kind_ == Kind::alone || ::flock(file_, LOCK_EX | LOCK_NB) == 0) && is_there(file_, path_))
    ::unlink(path_.c_str());
  ::close(file_);
}

}  // namespace atrium
