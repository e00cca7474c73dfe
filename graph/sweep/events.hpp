#pragma once
#include <map>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "graph/run/runner.hpp"

namespace atrium {

/// Tells another process how far this one is: one JSON object in a line, written at once, so that what was said before
/// a crash is said. "e" names the kind:
///   begin (time, host, process), started (node), share (node, share), said (node, text, warning),
///   finished and described (record), end (what the run as a whole took).
class EventSink final : public ProgressSink {
 public:
  /// Writes into an open file, which stays open. What nobody reads is lost.
  explicit EventSink(int file) : file_(file) {}
  void begin();
  void end(const RunResult& run);

  void started(const std::string& node) override;
  void progress(const std::string& node, double share) override;
  void finished(const NodeRecord& node) override;
  void described(const NodeRecord& node) override;
  void message(const std::string& node, std::string_view text, bool warning) override;

 private:
  void write(const nlohmann::ordered_json& event);

  std::mutex mutex_;
  int file_;
  std::map<std::string, double> shares_;  ///< by node: the last that was said
};

/// Seconds since 1970.
double epoch_seconds();

/// What a process as a whole took, as the event `end` says it. Reading throws nlohmann::json::exception.
RunResult read_totals(const nlohmann::ordered_json& event);

}  // namespace atrium
