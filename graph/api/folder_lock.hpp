#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace atrium {

/// In a folder that a process works on: the file that is locked.
inline constexpr std::string_view lock_file_name = ".atrium-lock";

/// A lock on a folder, which ends with the process. It is one on a file in it (flock(2)): Linux keeps such a lock on
/// the server of a network file system, so that it holds between machines; one on the folder itself would hold on one
/// machine only.
class FolderLock {
 public:
  enum class Kind { alone, shared };
  /// Tries once. Throws Error if the folder cannot be written, or its file system has no locks.
  FolderLock(const std::filesystem::path& folder, Kind kind);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  bool held() const { return file_ >= 0; }
  /// Of one that is not held: who has it, "process 71 on node5".
  const std::string& holder() const { return holder_; }

 private:
  std::filesystem::path path_;
  std::string holder_;
  int file_ = -1;
  Kind kind_;
};

}  // namespace atrium
