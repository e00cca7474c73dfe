#include "graph/cli/results.hpp"

#include <map>
#include <nlohmann/json.hpp>

#include "graph/api/fact_json.hpp"
#include "graph/api/json_text.hpp"
#include "graph/api/text.hpp"

namespace atrium::cli {
namespace {

using Json = nlohmann::ordered_json;

// What the pipeline's output shows, or nothing.
std::vector<Fact> facts_of(const PipelineOutput& output, const RunResult& result) {
  const NodeRecord& node = result.nodes[output.from.node];
  return node.status == NodeStatus::ok ? node.outputs[output.from.output].facts : std::vector<Fact>{};
}

}  // namespace

std::string results_table(const Pipeline& pipeline, const RunResult& result) {
  std::vector<std::vector<std::string>> rows;
  std::map<std::string, int> uses;
  for (const auto& output : pipeline[whole].outputs)
    for (const auto& fact : facts_of(output, result)) ++uses[fact.name];
  // A metric's own name suffices unless two outputs have one of that name.
  for (const auto& output : pipeline[whole].outputs)
    for (const auto& fact : facts_of(output, result)) {
      const std::string own = fact.name.empty() ? output.name : fact.name;
      const bool shared = !fact.name.empty() && uses[fact.name] > 1;
      rows.push_back({shared ? output.name + "." + own : own, fact_text(fact), fact.unit});
    }
  return aligned(rows, {false, true});
}

std::string results_json(const Pipeline& pipeline, const RunResult& result, const std::filesystem::path& folder) {
  Json outputs = Json::object();
  for (const auto& output : pipeline[whole].outputs) {
    const auto facts = facts_of(output, result);
    if (facts.empty()) continue;
    for (const auto& fact : facts) {
      Json& json = fact.name.empty() ? outputs[output.name] : outputs[output.name][fact.name];
      json = fact;
      json.erase("name");
    }
  }
  Json failures = Json::array();
  for (const auto& f : result.failures)
    failures.push_back({{"node", f.node}, {"type", f.type}, {"message", f.message}, {"help", f.help}});
  const Json json{{"status", status_of(result)},
                  {"folder", folder.string()},
                  {"seconds", result.wall},
                  {"outputs", std::move(outputs)},
                  {"failures", std::move(failures)}};
  return json_text(json, 2) + "\n";
}

}  // namespace atrium::cli
