#pragma once
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <unordered_map>

#include "graph/sweep/events.hpp"
#include "graph/sweep/plan.hpp"

namespace atrium {

/// Joins what several processes tell of the nodes of one sweep (EventSink) to one run of its merged graph: of a node
/// that several of them had, the one counts that computed it. Tells a ProgressSink of each node once.
class JoinedRun {
 public:
  /// `wanted[v]`: variant v is run. `started`: seconds since 1970.
  JoinedRun(const SweepPlan& plan, const std::vector<bool>& wanted, double started, ProgressSink& progress);

  /// `process`: whose event it is, any name; `lane`: where the trace shows it. Besides what EventSink says: crashed
  /// (node, message), of a node that has no record because its process ended.
  void hear(const std::string& process, std::size_t lane, const nlohmann::ordered_json& event);
  /// The last record that a process has told of a node, "ID/x/y"; null if none.
  const NodeRecord* record_of(const std::string& node) const;

  const Pipeline& pipeline() const { return pipeline_; }
  /// The nodes that were run, in the order of pipeline(), and what the processes took together.
  RunResult run() const;

 private:
  void take(NodeRecord record, double shift, std::size_t lane);
  void crashed(const std::string& node, const std::string& message);
  void finish(std::size_t n, const NodeRecord& record);

  Pipeline pipeline_;
  ProgressSink& progress_;
  double started_;
  std::unordered_map<std::string, std::size_t> index_;  ///< "ID/x/y" of any variant: in pipeline_
  std::vector<NodeRecord> records_;
  std::vector<int> ranks_;      ///< how much the record of a node says; 0: there is none
  std::vector<bool> finished_;  ///< the progress was told so
  std::unordered_map<std::string, NodeRecord> last_;
  std::map<std::string, double> shifts_;  ///< by process: its start after the sweep's
  RunResult totals_;
  std::set<std::string> problems_;
};

/// A node that was never run because one that it reads failed.
void mark_skipped(const Pipeline& pipeline, std::size_t node, std::vector<NodeRecord>& records);

}  // namespace atrium
