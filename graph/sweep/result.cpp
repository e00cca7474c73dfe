#include "graph/sweep/result.hpp"

#include <nlohmann/json.hpp>

#include "graph/api/fact_json.hpp"
#include "graph/api/files.hpp"
#include "graph/api/json_fields.hpp"
#include "graph/api/json_text.hpp"
#include "graph/cache/blob.hpp"
#include "graph/cache/node_key.hpp"
#include "graph/run/node_json.hpp"
#include "graph/run/run_folder.hpp"

namespace atrium {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr std::tuple output_fields{json_field("name", &VariantResult::Output::name),
                                   json_field("facts", &VariantResult::Output::facts)};

/// A hash of what tells whether a file, or one in a folder, was changed.
Json state_of(const fs::path& path) {
  try {
    return {{"path", path.string()}, {"state", hash_of_text(FileHashes::fingerprint(path))}};
  } catch (const Error&) {
    return {{"path", path.string()}, {"missing", true}};
  }
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

/// Nothing if there is none, or none of this version.
std::optional<VariantResult> result_in(const Json& json, const std::string& build) {
  try {
    if (json.at("build") != build) return std::nullopt;
    VariantResult result;
    result.status = read_status(json.at("status").get<std::string>());
    result.message = json.value("message", "");
    for (const auto& node : json.at("nodes")) result.nodes.push_back(read_node(node));
    for (const auto& output : json.at("outputs")) read_fields(output, result.outputs.emplace_back(), output_fields);
    json.at("artefacts").get_to(result.artefacts);
    return result;
  } catch (const Json::exception&) {
    return std::nullopt;
  }
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

void write_result(const fs::path& folder, const VariantName& name, const SweepPlan& plan, const SweepVariant& variant,
                  const VariantResult& result, const std::string& build, const std::string& inputs) {
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
  for (const auto& output : result.outputs) json["outputs"].push_back(fields_json(output, output_fields));
  auto artefacts = result.artefacts;
  for (auto& artefact : artefacts) artefact.hash = hash_if_readable(folder / artefact.path);
  json["artefacts"] = std::move(artefacts);
  json["nodes"] = Json::array();
  for (const auto& node : result.nodes) {
    json["nodes"].push_back(node_json(node));
    if (node.is_from_cache()) json["nodes"].back()["known"] = true;
  }
  write_file(folder / "result.json", json_text(json, 1) + "\n", false);  // if it is cut off, the variant is not done
}

std::optional<VariantResult> read_result(const fs::path& folder, const std::string& build) {
  return result_in(read_json_file(folder / "result.json"), build);
}

std::optional<VariantResult> reusable_result(const fs::path& folder, const SweepPlan& plan, const SweepVariant& variant,
                                             const std::string& build) {
  const Json json = read_json_file(folder / "result.json");
  auto result = result_in(json, build);
  if (!result || result->status != VariantStatus::ok || json.value("inputs", Json()) != inputs_of(plan, variant))
    return std::nullopt;
  for (const auto& artefact : result->artefacts) {
    const auto file = place_inside(folder, artefact.path);
    if (!file || artefact.hash.empty() || hash_if_readable(*file) != artefact.hash) return std::nullopt;
  }
  result->reused = true;
  return result;
}

}  // namespace atrium
