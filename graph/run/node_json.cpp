#include "graph/run/node_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "graph/api/fact_json.hpp"
#include "graph/api/json_fields.hpp"

namespace atrium {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::tuple own_fields{json_field("start", &NodeRecord::start), json_field("thread", &NodeRecord::thread),
                                json_field("hash_start", &NodeRecord::hash_start),
                                json_field("hash_seconds", &NodeRecord::hash_wall),
                                json_field("outputs", &NodeRecord::outputs)};

Json cache_json(const CacheUse& use) {
  const bool hit = use.result == CacheUse::Result::hit;
  Json json{{"result", hit ? "hit" : "miss"}};
  if (!use.key.empty()) json["key"] = use.key;
  if (!use.why.empty()) json["why"] = use.why;
  if (!hit) return json;
  if (use.again) json["why"] = run_again;
  json["made"] = use.made;
  json["computing_wall_seconds"] = rounded_seconds(use.wall);
  json["computing_cpu_seconds"] = rounded_seconds(use.cpu);
  json["computing_peak_memory"] = use.peak_memory;
  return json;
}

CacheUse read_cache_use(const Json& json) {
  CacheUse use;
  use.result = json.at("result") == "hit" ? CacheUse::Result::hit : CacheUse::Result::miss;
  use.key = json.value("key", "");
  use.why = json.value("why", "");
  if (use.result == CacheUse::Result::miss) return use;
  use.again = !use.why.empty();
  use.why.clear();
  use.made = json.value("made", "");
  use.wall = json.value("computing_wall_seconds", 0.0);
  use.cpu = json.value("computing_cpu_seconds", 0.0);
  use.peak_memory = json.value("computing_peak_memory", std::uint64_t{0});
  return use;
}

NodeStatus read_status(std::string_view text) {
  for (const auto status : {NodeStatus::ok, NodeStatus::failed, NodeStatus::skipped})
    if (name_of(status) == text) return status;
  return NodeStatus::cancelled;
}

}  // namespace

double rounded_seconds(double seconds) { return std::round(seconds * 1e6) / 1e6; }

Json node_json(const NodeRecord& node) {
  Json json{{"node", node.node}, {"type", node.type}, {"version", node.version}, {"status", name_of(node.status)}};
  if (node.status == NodeStatus::failed) {
    json["message"] = node.message;
    if (!node.help.empty()) json["help"] = node.help;
  }
  if (!node.because.empty()) json["because"] = node.because;
  if (node.status == NodeStatus::ok || node.status == NodeStatus::failed) {
    json["wall_seconds"] = rounded_seconds(node.wall);
    json["cpu_seconds"] = rounded_seconds(node.cpu);
    json["peak_memory"] = node.peak_memory;
  }
  if (node.status == NodeStatus::ok) json["outputs"] = node.outputs;
  if (node.status == NodeStatus::ok)
    for (auto& output : json["outputs"]) output.erase("facts");
  if (node.cache.result != CacheUse::Result::off) json["cache"] = cache_json(node.cache);
  if (!node.warnings.empty()) json["warnings"] = node.warnings;
  if (!node.artefacts.empty()) json["artefacts"] = node.artefacts;
  return json;
}

Json whole_node_json(const NodeRecord& node) {
  Json json = node_json(node);
  json.update(fields_json(node, own_fields));
  return json;
}

NodeRecord read_node(const Json& json) {
  NodeRecord node;
  json.at("node").get_to(node.node);
  json.at("type").get_to(node.type);
  node.version = json.value("version", 1);
  node.status = read_status(json.at("status").get<std::string>());
  node.message = json.value("message", "");
  node.help = json.value("help", "");
  node.because = json.value("because", "");
  node.wall = json.value("wall_seconds", 0.0);
  node.cpu = json.value("cpu_seconds", 0.0);
  node.peak_memory = json.value("peak_memory", std::uint64_t{0});
  node.warnings = json.value("warnings", node.warnings);
  node.artefacts = json.value("artefacts", node.artefacts);
  if (json.contains("cache")) node.cache = read_cache_use(json.at("cache"));
  if (json.contains("thread"))
    read_fields(json, node, own_fields);
  else
    node.outputs = json.value("outputs", node.outputs);
  return node;
}

}  // namespace atrium
