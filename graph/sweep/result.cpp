#include "graph/sweep/result.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "graph/api/fact_json.hpp"
#include "graph/api/files.hpp"
#include "graph/api/json_text.hpp"
#include "graph/cache/blob.hpp"
#include "graph/cache/node_key.hpp"
#include "graph/run/manifest.hpp"
#include "graph/run/record_json.hpp"

namespace atrium {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// A hash of what tells whether a file, or one in a folder, was changed.
Json state_of(const fs::path& path) {
  try {
    const std::string fingerprint = FileHashes::fingerprint(path);
    ContentHash hash;
    hash.bytes(fingerprint.data(), fingerprint.size());
    return {{"path", path.string()}, {"state", hash.hex()}};
  } catch (const Error&) {
    return {{"path", path.string()}, {"missing", true}};
  }
}

Json node_json(const VariantResult::Node& node) {
  Json json{{"node", node.path},         {"type", node.type},       {"status", name_of(node.status)},
            {"wall_seconds", node.wall}, {"cpu_seconds", node.cpu}, {"peak_memory", node.peak_memory}};
  if (node.known) json["known"] = true;
  if (node.cache.result != CacheUse::Result::off) json["cache"] = cache_json(node.cache);
  json["outputs"] = Json::array();
  for (const auto& output : node.outputs) {
    Json described{{"port", output.port}, {"type", output.type}, {"bytes", output.bytes}};
    if (!output.hash.empty()) described["hash"] = output.hash;
    json["outputs"].push_back(std::move(described));
  }
  return json;
}

Json inputs_of(const SweepPlan& plan, const SweepVariant& variant) {
  Json inputs = Json::array();
  for (const std::size_t n : variant.nodes)
    for (const auto& path : input_files(plan.merged[n])) inputs.push_back(state_of(path));
  return inputs;
}

VariantStatus read_status(const std::string& text) {
  for (const auto status : {VariantStatus::ok, VariantStatus::failed, VariantStatus::crashed})
    if (name_of(status) == text) return status;
  return VariantStatus::cancelled;
}

VariantResult read_result_json(const Json& json) {
  VariantResult result;
  result.status = read_status(json.at("status").get<std::string>());
  result.message = json.value("message", "");
  for (const auto& node : json.at("nodes")) {
    std::vector<OutputRecord> outputs;
    for (const auto& output : node.at("outputs"))
      outputs.push_back({output.at("port").get<std::string>(), output.at("type").get<std::string>(),
                         output.at("bytes").get<std::uint64_t>(), output.value("hash", "")});
    result.nodes.push_back({node.at("node").get<std::string>(), node.at("type").get<std::string>(),
                            read_node_status(node.at("status").get<std::string>()),
                            node.at("wall_seconds").get<double>(), node.at("cpu_seconds").get<double>(),
                            node.at("peak_memory").get<std::uint64_t>(), std::move(outputs),
                            node.value("known", false)});
  }
  for (const auto& output : json.at("outputs")) {
    auto& facts = result.outputs.emplace_back(VariantResult::Output{output.at("name").get<std::string>(), {}}).facts;
    for (const auto& fact : output.at("facts")) facts.push_back(read_fact(fact));
  }
  for (const auto& artefact : json.at("artefacts"))
    result.artefacts.push_back({artefact.at("path").get<std::string>(), artefact.at("bytes").get<std::uint64_t>()});
  return result;
}

}  // namespace

std::string_view name_of(VariantStatus status) {
  switch (status) {
    case VariantStatus::ok: return "ok";
    case VariantStatus::failed: return "failed";
    case VariantStatus::crashed: return "crashed";
    case VariantStatus::missing: return "missing";
    case VariantStatus::running: return "running";
    case VariantStatus::lost: return "lost";
    default: return "cancelled";
  }
}

std::string state_of_inputs(const SweepPlan& plan, const SweepVariant& variant) {
  return json_text(inputs_of(plan, variant));
}

std::string result_json(const fs::path& folder, const VariantName& name, const SweepPlan& plan,
                        const SweepVariant& variant, const VariantResult& result, const std::string& build,
                        const std::string& inputs) {
  Json json{{"atrium", framework_version()},
            {"build", build},
            {"id", variant.id},
            {"variant", name.label},
            {"status", name_of(result.status)}};
  if (!result.message.empty()) json["message"] = result.message;
  json["choices"] = Json::object();
  for (const auto& [axis, choice] : name.choices) json["choices"][axis] = choice;
  json["inputs"] = inputs_of(plan, variant);
  if (json_text(json["inputs"]) != inputs) json["inputs"] = "changed while the variant was run";
  json["outputs"] = Json::array();
  for (const auto& output : result.outputs) {
    Json facts = Json::array();
    for (const auto& fact : output.facts) facts.push_back(fact_json(fact));
    json["outputs"].push_back({{"name", output.name}, {"facts", std::move(facts)}});
  }
  json["artefacts"] = Json::array();
  for (const auto& artefact : result.artefacts)
    json["artefacts"].push_back(
        {{"path", artefact.path}, {"bytes", artefact.bytes}, {"hash", hash_if_readable(folder / artefact.path)}});
  json["nodes"] = Json::array();
  for (const auto& node : result.nodes) json["nodes"].push_back(node_json(node));
  return json_text(json, 1) + "\n";
}

std::optional<VariantResult> read_result(const fs::path& folder, const std::string& build) {
  const Json json = read_json_file(folder / "result.json");
  if (!json.is_object()) return std::nullopt;
  try {
    return json.at("build") == build ? std::optional(read_result_json(json)) : std::nullopt;
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

std::optional<VariantResult> reusable_result(const fs::path& folder, const SweepPlan& plan, const SweepVariant& variant,
                                             const std::string& build) {
  const Json json = read_json_file(folder / "result.json");
  if (!json.is_object()) return std::nullopt;
  try {
    if (json.at("build") != build || json.at("status") != "ok" || json.at("inputs") != inputs_of(plan, variant))
      return std::nullopt;
    VariantResult result = read_result_json(json);
    for (const auto& artefact : json.at("artefacts")) {
      const auto file = place_inside(folder, artefact.at("path").get<std::string>());
      if (!file || hash_if_readable(*file) != artefact.at("hash").get<std::string>()) return std::nullopt;
    }
    result.reused = true;
    return result;
  } catch (const Json::exception&) {  // of another version, or not ours
    return std::nullopt;
  }
}

}  // namespace atrium
