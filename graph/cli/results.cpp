#include "graph/cli/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "graph/api/json_text.hpp"

namespace atrium::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Row {
  std::string name, value, unit;
};

// What the pipeline's output shows, or nothing.
std::vector<Fact> facts_of(const PipelineOutput& output, const RunResult& result) {
  const NodeRecord& node = result.nodes[output.from.node];
  return node.status == NodeStatus::ok ? node.facts[output.from.output] : std::vector<Fact>{};
}

// Six digits say what is worth reading; whole numbers are shown whole.
std::string shown(const Fact& fact) {
  if (const auto* number = std::get_if<double>(&fact.value)) {
    const bool whole = std::abs(*number) < 1e15 && *number == std::trunc(*number);
    return whole ? fmt::format("{:.0f}", *number) : fmt::format("{:.6g}", *number);
  }
  return std::visit([](const auto& v) { return fmt::format("{}", v); }, fact.value);
}

Json to_json(const Fact& fact) {
  Json json;
  std::visit([&](const auto& v) { json["value"] = v; }, fact.value);
  if (!fact.unit.empty()) json["unit"] = fact.unit;
  return json;
}

}  // namespace

std::string results_table(const Pipeline& pipeline, const RunResult& result) {
  std::vector<Row> rows;
  std::map<std::string, int> uses;
  for (const auto& output : pipeline[whole].outputs)
    for (const auto& fact : facts_of(output, result)) ++uses[fact.name];
  // A metric's own name suffices unless two outputs have one of that name.
  for (const auto& output : pipeline[whole].outputs)
    for (const auto& fact : facts_of(output, result)) {
      const std::string own = fact.name.empty() ? output.name : fact.name;
      const bool shared = !fact.name.empty() && uses[fact.name] > 1;
      rows.push_back({shared ? output.name + "." + own : own, shown(fact), fact.unit});
    }
  std::size_t name = 0;
  std::size_t value = 0;
  for (const auto& row : rows) {
    name = std::max(name, row.name.size());
    value = std::max(value, row.value.size());
  }
  std::string text;
  for (const auto& row : rows)
    text +=
        fmt::format("{:<{}}  {:>{}}{}{}\n", row.name, name, row.value, value, row.unit.empty() ? "" : " ", row.unit);
  return text;
}

std::string results_json(const Pipeline& pipeline, const RunResult& result, const std::filesystem::path& folder) {
  Json outputs = Json::object();
  for (const auto& output : pipeline[whole].outputs) {
    const auto facts = facts_of(output, result);
    if (facts.empty()) continue;
    Json& json = outputs[output.name] = Json::object();
    for (const auto& fact : facts) {
      if (fact.name.empty())
        json = to_json(fact);
      else
        json[fact.name] = to_json(fact);
    }
  }
  Json failures = Json::array();
  for (const auto& f : result.failures)
    failures.push_back({{"node", f.node}, {"type", f.type}, {"message", f.message}, {"help", f.help}});
  const Json json{{"status", !result.failures.empty() ? "failed"
                             : result.cancelled       ? "cancelled"
                                                      : "ok"},
                  {"folder", folder.string()},
                  {"seconds", result.wall},
                  {"outputs", std::move(outputs)},
                  {"failures", std::move(failures)}};
  return json_text(json, 2) + "\n";
}

}  // namespace atrium::cli
