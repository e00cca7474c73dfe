#pragma once
#include <filesystem>
#include <set>
#include <string>

#include "graph/run/runner.hpp"

namespace atrium {

/// Writes a whole file: beside, then renamed. Without `flush` it may be cut off after a power failure. Throws Error.
void write_file(const std::filesystem::path& target, const std::string& text, bool flush = true);

/// The file that marks the folder of a sweep.
inline constexpr std::string_view sweep_mark = "sweep.json";

/// Whether a folder holds nothing but what a killed process left of files that it was writing (AtomicFile).
bool holds_only_unfinished(const std::filesystem::path& folder);

/// The folder of one run. It is refused if it holds anything but an earlier run, whose files are removed first (those
/// that its manifest lists and that still have the size listed, those that it planned to write when it was killed, and
/// unfinished ones; unless this pipeline reads them): what is in the folder
/// afterwards is of this run. The folder of a sweep is refused too. Locked against a second run at the same time.
class RunFolder {
 public:
  /// Makes the folder; writes resolved.yaml and a manifest.json that says that the run is not finished. Throws
  /// FolderError.
  RunFolder(std::filesystem::path folder, const Pipeline& pipeline);
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;
  /// Writes manifest.json and trace.json.
  void finish(const RunResult& result);

 private:
  void lock();
  void remove_earlier_run();

  std::filesystem::path folder_;
  const Pipeline& pipeline_;
  std::string started_;
  int lock_ = -1;
};

}  // namespace atrium
