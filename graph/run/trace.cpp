#include "graph/run/trace.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "graph/api/json_text.hpp"

namespace atrium {
namespace {

using Json = nlohmann::ordered_json;

std::int64_t microseconds(double seconds) { return std::llround(seconds * 1e6); }

Json span(const NodeRecord& node, std::string_view category, double start, double length) {
  return {{"name", node.node},           {"cat", category}, {"ph", "X"},         {"ts", microseconds(start)},
          {"dur", microseconds(length)}, {"pid", 1},        {"tid", node.thread}};
}

void add_node(Json& events, const NodeRecord& node) {
  Json event = span(node, node.type, node.start, node.wall);
  event["args"] = {{"type", node.type}, {"status", name_of(node.status)}, {"cpu_seconds", node.cpu}};
  if (node.cache.result != CacheUse::Result::off)
    event["args"]["cache"] = !node.is_hit() ? "miss" : node.cache.again ? "run again" : "hit";
  if (!node.message.empty()) event["args"]["message"] = node.message;
  for (const auto& output : node.outputs) event["args"]["bytes." + output.port] = output.bytes;
  events.push_back(std::move(event));
  events.push_back({{"name", "peak memory"},
                    {"ph", "C"},
                    {"ts", microseconds(node.start + node.wall)},
                    {"pid", 1},
                    {"args", {{"bytes", node.peak_memory}}}});
  if (node.hash_wall < 1e-3) return;
  events.push_back(span(node, "hash", node.hash_start, node.hash_wall));
}

}  // namespace

std::string trace_json(const RunResult& result) {
  Json events = Json::array();
  events.push_back({{"name", "process_name"}, {"ph", "M"}, {"pid", 1}, {"args", {{"name", "atrium"}}}});
  for (const auto& node : result.nodes)
    if (node.status == NodeStatus::ok || node.status == NodeStatus::failed) add_node(events, node);
  const Json trace{{"displayTimeUnit", "ms"}, {"traceEvents", std::move(events)}};
  return json_text(trace) + "\n";
}

}  // namespace atrium
