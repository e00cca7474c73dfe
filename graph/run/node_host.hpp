#pragma once
#include <atomic>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "graph/cache/cache.hpp"
#include "graph/pipeline/png_stamp.hpp"
#include "graph/run/runner.hpp"

namespace atrium {

/// In the folder of a run that is under way: the files that its nodes have written so far, one in a line.
inline constexpr std::string_view written_journal = ".written";

/// What a node's Context is connected to during a run.
class NodeHost final : public ContextHost {
 public:
  /// `folder` is the run's, `subfolder` the node's in it. With a cache the files that the node writes are kept.
  NodeHost(const std::string& node, const std::filesystem::path& folder, const std::filesystem::path& subfolder,
           std::function<bool()> cancelled, const PngStamp& stamp, ProgressSink& progress, Cache* cache)
      : node_(node),
        folder_(folder),
        subfolder_(subfolder),
        cancelled_(std::move(cancelled)),
        stamp_(stamp),
        progress_(progress),
        cache_(cache) {}

  void log(Level level, std::string_view text) override;
  void progress(double share) override { progress_.progress(node_, share); }
  bool cancelled() override { return cancelled_(); }
  std::filesystem::path output_folder() override {
    return folder_.empty() && subfolder_.empty() ? "." : folder_ / subfolder_;
  }
  void wrote(const std::filesystem::path& file) override;
  void helped(double cpu_seconds) override;

  /// Hands over what the node has said and written; after its end.
  void finish(NodeRecord& record);
  /// What the cache has of the files that were written: fewer if it could not keep one.
  std::vector<Artefact> kept();

 private:
  void keep(const std::filesystem::path& file);

  const std::string& node_;
  const std::filesystem::path& folder_;
  const std::filesystem::path& subfolder_;
  std::function<bool()> cancelled_;
  const PngStamp& stamp_;  ///< goes into every picture that the node writes
  ProgressSink& progress_;
  Cache* cache_;
  std::mutex mutex_;
  std::vector<std::string> warnings_;
  std::vector<std::filesystem::path> files_;
  std::map<std::string, Artefact> kept_;  ///< by path
  double helped_ = 0;
};

}  // namespace atrium
