#include "graph/run/manifest.hpp"

#include <nlohmann/json.hpp>

#include "graph/api/fact_json.hpp"
#include "graph/api/json_text.hpp"
#include "graph/api/plugin.hpp"
#include "graph/pipeline/png_stamp.hpp"
#include "graph/run/node_json.hpp"

namespace atrium {
namespace {

using Json = nlohmann::ordered_json;

Json head(const Pipeline& pipeline, const std::string& started, std::string_view status) {
  return {{"atrium", ATRIUM_VERSION},
          {"build", ATRIUM_STAMP},
          {"status", status},
          {"pipeline", pipeline[whole].file.string()},
          {"run", stamp_of(pipeline).run},
          {"started", started},
          {"seed", pipeline[whole].seed}};
}

Json pipeline_outputs(const Pipeline& pipeline, const RunResult& result) {
  Json outputs = Json::object();
  for (const auto& output : pipeline[whole].outputs) {
    const NodeRecord& node = result.nodes[output.from.node];
    const PortInfo& port = pipeline[output.from.node].type->outputs[output.from.output];
    Json json{{"from", node.node + "." + port.name}, {"type", port.type}};
    if (node.status == NodeStatus::ok) {
      const OutputRecord& shown = node.outputs[output.from.output];
      if (!shown.hash.empty()) json["hash"] = shown.hash;
      if (!shown.facts.empty()) json["facts"] = shown.facts;
    }
    outputs[output.name] = std::move(json);
  }
  return outputs;
}

// Texts of nodes may hold bytes that are not UTF-8 (file names): they are replaced, never thrown at.
std::string manifest_text(const Json& json) { return json_text(json, 1) + "\n"; }

}  // namespace

std::string manifest_json(const Pipeline& pipeline, const RunResult& result, const std::string& started) {
  Json json = head(pipeline, started, status_of(result));
  json["threads"] = result.threads;
  json["wall_seconds"] = rounded_seconds(result.wall);
  json["cpu_seconds"] = rounded_seconds(result.cpu);
  json["peak_memory"] = result.peak_memory;
  double hashing = 0;
  for (const auto& node : result.nodes) hashing += node.hash_wall;
  json["hash_seconds"] = rounded_seconds(hashing);
  if (!result.cache_folder.empty()) {
    json["cache"] = {{"folder", result.cache_folder}, {"loaded_bytes", result.loaded}, {"kept_bytes", result.kept}};
    if (!result.cache_problems.empty()) json["cache"]["problems"] = result.cache_problems;
  }
  json["outputs"] = pipeline_outputs(pipeline, result);
  json["nodes"] = Json::array();
  for (const auto& node : result.nodes) json["nodes"].push_back(node_json(node));
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
