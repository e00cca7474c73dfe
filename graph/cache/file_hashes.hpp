#pragma once
#include <filesystem>
#include <map>
#include <mutex>
#include <string>

namespace atrium {

/// Content hashes of files that others may change. A hash is remembered, in memory and in a folder, with all that the
/// system tells cheaply about the file (device, inode, size, times of change of contents and status, in nanoseconds)
/// and used again as long as that is the same. A file that was changed less than two seconds before it was read is not
/// remembered: a second change within the same tick of the file system's clock would not show.
class FileHashes {
 public:
  /// `folder`: where hashes are remembered for later runs; empty: nowhere.
  explicit FileHashes(std::filesystem::path folder = {}) : folder_(std::move(folder)) {}

  /// Of a file's bytes; of a folder, of the names and bytes of all files in it. Throws Error if one cannot be read.
  std::string of(const std::filesystem::path& path);
  /// A cheap fingerprint from stat(2); of a folder: of every file in it. If it changes, the contents may have changed.
  /// Throws Error if one cannot be read.
  static std::string fingerprint(const std::filesystem::path& path);
  /// Whether a file of that name in the folder is what it was when it was written.
  static bool is_whole(const std::string& text, const std::string& name);

 private:
  std::string of_file(const std::filesystem::path& file);

  std::filesystem::path folder_;
  std::mutex mutex_;
  std::map<std::string, std::string> known_;  ///< by fingerprint
};

}  // namespace atrium
