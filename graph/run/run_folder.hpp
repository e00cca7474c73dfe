#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "graph/api/folder_lock.hpp"
#include "graph/run/runner.hpp"

namespace atrium {

/// Writes a whole file: beside, then renamed. Without `flush` it may be cut off after a power failure. Throws Error.
void write_file(const std::filesystem::path& target, const std::string& text, bool flush = true);

/// Makes the folder. Throws FolderError.
void make_out_folder(const std::filesystem::path& folder);
/// Locks it; `what` ("run", "sweep") has it if it cannot be had. Throws FolderError.
void lock_out_folder(const std::filesystem::path& folder, FolderLock::Kind kind, std::string_view what,
                     std::optional<FolderLock>& lock);
/// Files in it, and below, that nobody has finished. To be called by who has locked it alone.
std::vector<std::filesystem::path> unfinished_files(const std::filesystem::path& folder);

/// The file that marks the folder of a sweep.
inline constexpr std::string_view sweep_mark = "sweep.json";

/// The folder of one run. It is refused if it holds anything but an earlier run. Of that run the files are removed
/// first: those that its manifest lists and that still have the size listed; if it was killed, those that it planned to
/// write; and unfinished ones (AtomicFile). Before that its manifest is replaced: one that says that a run is done
/// stands beside all of its files, always. A file that this pipeline reads stays, and nothing outside of the folder is
/// touched, whatever the manifest lists. The folder of a sweep is refused too. Locked against a second run at the same
/// time (FolderLock).
class RunFolder {
 public:
  /// Makes the folder; writes resolved.yaml and a manifest.json that says that the run is not finished. Throws
  /// FolderError.
  RunFolder(std::filesystem::path folder, const Pipeline& pipeline);
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;
  /// Writes manifest.json and trace.json.
  void finish(const RunResult& result);

 private:
  std::vector<std::string> files_of_earlier_run() const;
  void remove_unless_read(const std::vector<std::filesystem::path>& files) const;

  std::filesystem::path folder_;
  const Pipeline& pipeline_;
  std::string started_;
  std::optional<FolderLock> lock_;
};

}  // namespace atrium
