#pragma once
#include <filesystem>
#include <optional>

#include "graph/api/folder_lock.hpp"
#include "graph/sweep/sweep_file.hpp"

namespace atrium {

/// The sweep's folder, locked against a second run at the same time.
class SweepFolder {
 public:
  /// Makes it. Refused if it holds anything but a sweep. Throws FolderError.
  SweepFolder(const std::filesystem::path& folder, const SweepFile& sweep);
  /// For one of several processes that work on it. Throws FolderError.
  explicit SweepFolder(const std::filesystem::path& folder);
  SweepFolder(const SweepFolder&) = delete;
  SweepFolder& operator=(const SweepFolder&) = delete;

 private:
  std::optional<FolderLock> lock_;
};

}  // namespace atrium
