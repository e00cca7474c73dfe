#include "graph/sweep/joined_run.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "graph/run/node_json.hpp"
#include "graph/sweep/merge.hpp"
#include "graph/sweep/recorder.hpp"

namespace atrium {
namespace {

using Json = nlohmann::ordered_json;

constexpr int threads_of_a_lane = 100;  // so that the threads of two processes are told apart in the trace

int rank_of(const NodeRecord& record) {
  if (record.status == NodeStatus::ok) return record.is_hit() ? 3 : 4;
  return record.status == NodeStatus::failed ? 2 : 1;
}

}  // namespace

JoinedRun::JoinedRun(const SweepPlan& plan, const std::vector<bool>& wanted, double started, ProgressSink& progress)
    : progress_(progress), started_(started) {
  const std::vector<std::size_t> nodes = nodes_of(plan, wanted);
  pipeline_ = part_of(plan.merged, nodes);
  std::vector<std::size_t> place(node_count(plan.merged), 0);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    index_.emplace(plan.merged[nodes[i]].path, i);
    place[nodes[i]] = i;
  }
  for (std::size_t v = 0; v < plan.variants.size(); ++v)
    for (const std::size_t n : plan.variants[v].nodes)
      if (wanted[v]) index_.emplace(plan.variants[v].id + "/" + address_in_variant(plan.merged[n]), place[n]);
  const std::size_t size = node_count(pipeline_);
  ranks_.resize(size, 0);
  finished_.resize(size, false);
  records_.reserve(size);
  for (const std::size_t n : all_nodes(pipeline_)) records_.emplace_back(pipeline_[n]);
  progress_.planned(size);
}

void JoinedRun::hear(const std::string& process, std::size_t lane, const Json& event) {
  const std::string kind = event.value("e", "");
  if (kind == "begin") shifts_[process] = event.at("time").get<double>() - started_;
  if (kind == "finished" || kind == "described") take(read_node(event.at("record")), shifts_[process], lane);
  if (kind == "crashed") crashed(event.at("node").get<std::string>(), event.at("message").get<std::string>());
  if (kind == "end") {
    const RunResult totals = read_totals(event);
    totals_.cpu += totals.cpu;
    totals_.peak_memory = std::max(totals_.peak_memory, totals.peak_memory);
    totals_.loaded += totals.loaded;
    totals_.kept += totals.kept;
    problems_.insert(totals.cache_problems.begin(), totals.cache_problems.end());
  }
  if (!event.contains("node")) return;
  if (kind == "said" && event.at("node").get<std::string>().empty())  // of the process as a whole
    return progress_.message({}, event.at("text").get<std::string>(), event.at("warning").get<bool>());
  const auto found = index_.find(event.at("node").get<std::string>());
  if (found == index_.end() || finished_[found->second]) return;
  const std::string& node = pipeline_[found->second].path;
  if (kind == "started") progress_.started(node);
  if (kind == "share") progress_.progress(node, event.at("share").get<double>());
  if (kind == "said") progress_.message(node, event.at("text").get<std::string>(), event.at("warning").get<bool>());
}

void JoinedRun::take(NodeRecord record, double shift, std::size_t lane) {
  record.thread += static_cast<int>(lane) * threads_of_a_lane;
  record.start += shift;
  record.hash_start += shift;
  last_[record.node] = record;
  const auto found = index_.find(record.node);
  if (found == index_.end()) return;
  const std::size_t n = found->second;
  const std::string own = "variants/" + record.node.substr(0, record.node.find('/')) + "/";
  for (auto& file : record.artefacts)  // each variant has its copy
    if (file.path.starts_with(own)) file.path = (pipeline_[n].folder / file.path.substr(own.size())).generic_string();
  record.node = pipeline_[n].path;
  if (const int rank = rank_of(record); rank >= ranks_[n]) {
    ranks_[n] = rank;
    records_[n] = record;
  }
  if (record.status != NodeStatus::cancelled) finish(n, record);
}

void JoinedRun::finish(std::size_t n, const NodeRecord& record) {
  if (finished_[n]) return;
  finished_[n] = true;
  progress_.finished(record);
}

void JoinedRun::crashed(const std::string& node, const std::string& message) {
  const auto found = index_.find(node);
  if (found == index_.end()) return;
  NodeRecord record(pipeline_[found->second]);
  record.node = node;
  record.status = NodeStatus::failed;
  record.message = message;
  take(std::move(record), 0, 0);
}

const NodeRecord* JoinedRun::record_of(const std::string& node) const {
  const auto found = last_.find(node);
  return found == last_.end() ? nullptr : &found->second;
}

void mark_skipped(const Pipeline& pipeline, std::size_t node, std::vector<NodeRecord>& records) {
  for (const auto& edge : edges_into(node, pipeline)) {
    const NodeRecord& from = records[boost::source(edge, pipeline)];
    if (from.status != NodeStatus::failed && from.status != NodeStatus::skipped) continue;
    records[node].status = NodeStatus::skipped;
    records[node].because = from.status == NodeStatus::failed ? from.node : from.because;
  }
}

RunResult JoinedRun::run() const {
  RunResult run = totals_;
  run.nodes = records_;
  for (std::size_t n = 0; n < run.nodes.size(); ++n)
    if (ranks_[n] == 0) mark_skipped(pipeline_, n, run.nodes);
  sum_up(run);
  run.cache_problems.assign(problems_.begin(), problems_.end());
  return run;
}

}  // namespace atrium
