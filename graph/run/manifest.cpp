#include "graph/run/manifest.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "graph/api/fact_json.hpp"
#include "graph/api/json_text.hpp"
#include "graph/api/plugin.hpp"
#include "graph/pipeline/png_stamp.hpp"
#include "graph/run/record_json.hpp"

namespace atrium {
namespace {

using Json = nlohmann::ordered_json;

// To the microsecond: more digits are noise.
double rounded(double seconds) { return std::round(seconds * 1e6) / 1e6; }

Json head(const Pipeline& pipeline, const std::string& started, std::string_view status) {
  return {{"atrium", ATRIUM_VERSION},
          {"build", ATRIUM_STAMP},
          {"status", status},
          {"pipeline", pipeline[whole].file.string()},
          {"run", stamp_of(pipeline).run},
          {"started", started},
          {"seed", pipeline[whole].seed}};
}

Json outputs_of(const NodeRecord& node) {
  Json outputs = Json::array();
  for (const auto& o : node.outputs) {
    Json output{{"port", o.port}, {"type", o.type}, {"bytes", o.bytes}};
    if (!o.hash.empty()) output["hash"] = o.hash;
    outputs.push_back(std::move(output));
  }
  return outputs;
}

Json node_json(const NodeRecord& node, const NodeType& type) {
  Json json{{"node", node.node}, {"type", node.type}, {"version", type.version}, {"status", name_of(node.status)}};
  if (node.status == NodeStatus::failed) {
    json["message"] = node.message;
    if (!node.help.empty()) json["help"] = node.help;
  }
  if (!node.because.empty()) json["because"] = node.because;
  if (node.status == NodeStatus::ok || node.status == NodeStatus::failed) {
    json["wall_seconds"] = rounded(node.wall);
    json["cpu_seconds"] = rounded(node.cpu);
    json["peak_memory"] = node.peak_memory;
  }
  if (node.status == NodeStatus::ok) json["outputs"] = outputs_of(node);
  if (node.cache.result != CacheUse::Result::off) json["cache"] = cache_json(node.cache);
  if (!node.warnings.empty()) json["warnings"] = node.warnings;
  Json artefacts = Json::array();
  for (const auto& a : node.artefacts) artefacts.push_back({{"path", a.path}, {"bytes", a.bytes}});
  if (!artefacts.empty()) json["artefacts"] = std::move(artefacts);
  return json;
}

Json facts_json(const std::vector<Fact>& facts) {
  Json json = Json::array();
  for (const auto& fact : facts) json.push_back(fact_json(fact));
  return json;
}

Json pipeline_outputs(const Pipeline& pipeline, const RunResult& result) {
  Json outputs = Json::object();
  for (const auto& output : pipeline[whole].outputs) {
    const NodeRecord& node = result.nodes[output.from.node];
    const PortInfo& port = pipeline[output.from.node].type->outputs[output.from.output];
    Json json{{"from", node.node + "." + port.name}, {"type", port.type}};
    if (node.status == NodeStatus::ok && !node.outputs[output.from.output].hash.empty())
      json["hash"] = node.outputs[output.from.output].hash;
    if (node.status == NodeStatus::ok && !node.facts[output.from.output].empty())
      json["facts"] = facts_json(node.facts[output.from.output]);
    outputs[output.name] = std::move(json);
  }
  return outputs;
}

// Texts of nodes may hold bytes that are not UTF-8 (file names): they are replaced, never thrown at.
std::string manifest_text(const Json& json) { return json_text(json, 1) + "\n"; }

}  // namespace

Json cache_json(const CacheUse& use) {
  const bool hit = use.result == CacheUse::Result::hit;
  Json json{{"result", hit ? "hit" : "miss"}};
  if (!use.key.empty()) json["key"] = use.key;
  if (!use.why.empty()) json["why"] = use.why;
  if (!hit) return json;
  if (use.again) json["why"] = "run again: its value was needed and is not kept";
  json["made"] = use.made;
  json["computing_wall_seconds"] = rounded(use.wall);
  json["computing_cpu_seconds"] = rounded(use.cpu);
  json["computing_peak_memory"] = use.peak_memory;
  return json;
}

std::string manifest_json(const Pipeline& pipeline, const RunResult& result, const std::string& started) {
  const std::string_view status = !result.failures.empty() ? "failed" : result.cancelled ? "cancelled" : "ok";
  Json json = head(pipeline, started, status);
  json["threads"] = result.threads;
  json["wall_seconds"] = rounded(result.wall);
  json["cpu_seconds"] = rounded(result.cpu);
  json["peak_memory"] = result.peak_memory;
  double hashing = 0;
  for (const auto& node : result.nodes) hashing += node.hash_wall;
  json["hash_seconds"] = rounded(hashing);
  if (!result.cache_folder.empty()) {
    json["cache"] = {{"folder", result.cache_folder}, {"loaded_bytes", result.loaded}, {"kept_bytes", result.kept}};
    if (!result.cache_problems.empty()) json["cache"]["problems"] = result.cache_problems;
  }
  json["outputs"] = pipeline_outputs(pipeline, result);
  Json nodes = Json::array();
  for (std::size_t n = 0; n < result.nodes.size(); ++n) nodes.push_back(node_json(result.nodes[n], *pipeline[n].type));
  json["nodes"] = std::move(nodes);
  return manifest_text(json);
}

std::string unfinished_manifest(const Pipeline& pipeline, const std::string& started,
                                const std::vector<std::string>& to_remove) {
  auto manifest = head(pipeline, started, "running");
  manifest["planned"] = nlohmann::json::array();
  for (const std::size_t n : all_nodes(pipeline))
    for (std::size_t i = 0; i < pipeline[n].params.size(); ++i)
      if (pipeline[n].type->params[i].kind == ParamKind::output_path)
        manifest["planned"].push_back(std::get<std::string>(pipeline[n].params[i]));
  for (const auto& path : to_remove) manifest["planned"].push_back(path);
  return manifest_text(manifest);
}

}  // namespace atrium
