#pragma once
#include <filesystem>

#include "graph/sweep/sweep_file.hpp"

namespace atrium {

/// The sweep's folder, locked against a second run at the same time. Refused if it holds anything but a sweep. Throws
/// FolderError.
class SweepFolder {
 public:
  SweepFolder(const std::filesystem::path& folder, const SweepFile& sweep);
  ~SweepFolder();
  SweepFolder(const SweepFolder&) = delete;
  SweepFolder& operator=(const SweepFolder&) = delete;

 private:
  int lock_ = -1;
};

}  // namespace atrium
