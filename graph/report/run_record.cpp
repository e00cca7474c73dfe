#include "graph/report/run_record.hpp"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "graph/api/fact_json.hpp"
#include "graph/api/files.hpp"
#include "graph/api/json_text.hpp"
#include "graph/api/text.hpp"
#include "graph/pipeline/yaml_tree.hpp"
#include "graph/run/node_json.hpp"

namespace atrium::report {
namespace {

using json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// Somebody else may have written the list: what is not in the folder is neither read nor shown.
void read_files(const json& artefacts, RunRecord& record) {
  for (const auto& entry : artefacts) {
    auto file = entry.get<Artefact>();
    if (place_inside(record.folder, file.path))
      record.files.push_back(std::move(file));
    else
      record.outside.push_back(std::move(file.path));
  }
}

void read_nodes(const json& nodes, RunRecord& record) {
  for (const auto& entry : nodes) {
    const NodeRecord& node = record.nodes.emplace_back(read_node(entry));
    if (record.message.empty() && !node.message.empty()) record.message = node.node + ": " + node.message;
  }
}

/// result.json
void read_variant(const json& result, RunRecord& record) {
  record.id = result.at("id").get<std::string>();
  record.status = result.at("status").get<std::string>();
  record.message = result.value("message", "");
  for (const auto& [axis, label] : result.at("choices").items())
    record.choices.emplace_back(axis, label.get<std::string>());
  read_nodes(result.at("nodes"), record);
  for (const auto& output : result.at("outputs"))
    for (const auto& fact : output.at("facts"))
      record.metrics.push_back({output.at("name").get<std::string>(), fact.get<Fact>()});
  read_files(result.at("artefacts"), record);
}

/// manifest.json
void read_manifest(const json& manifest, RunRecord& record) {
  record.status = manifest.at("status").get<std::string>();
  if (!manifest.contains("nodes")) return;  // it was killed, or runs still
  read_nodes(manifest.at("nodes"), record);
  for (const auto& node : manifest.at("nodes")) read_files(node.value("artefacts", json::array()), record);
  for (const auto& [name, output] : manifest.at("outputs").items())
    for (const auto& fact : output.value("facts", json::array())) record.metrics.push_back({name, fact.get<Fact>()});
}

std::string text_of(const YamlNode& node) {
  if (node.is_scalar()) return node.text;
  std::string text;
  for (const auto& item : node.items) text += (text.empty() ? "" : ", ") + text_of(item);
  return node.is_sequence() ? "[" + text + "]" : text;
}

void read_parameters(const YamlNode& root, RunRecord& record) {
  const auto add = [&](std::string address, const YamlNode& value) {
    record.parameters.emplace_back(std::move(address), text_of(value));
  };
  if (const auto* seed = root.find("seed")) add("seed", seed->value);
  if (const auto* versions = root.find("versions"))
    for (const auto& version : versions->value.entries) add(version.key + "'s version", version.value);
  const auto* nodes = root.find("nodes");
  if (nodes == nullptr) return;
  for (const auto& node : nodes->value.entries) {
    if (const auto* type = node.value.find("type")) add(node.key + ".type", type->value);
    if (const auto* in = node.value.find("in"))
      for (const auto& port : in->value.entries) add(node.key + ".in." + port.key, port.value);
    if (const auto* params = node.value.find("params"))
      for (const auto& param : params->value.entries) add(node.key + "." + param.key, param.value);
  }
}

/// The resolved pipeline. Names of folders may hold bytes that are no text in UTF-8: a mark stands for each.
YamlTree read_resolved(const std::string& file) {
  YamlTree tree;
  const auto text = read_yaml_text(file, tree);
  if (!text) return tree;
  std::string clean;
  for (std::string_view rest = *text; !rest.empty();) {
    const std::size_t good = std::min(first_not_text(rest), rest.size());
    clean += rest.substr(0, good);
    if (good < rest.size()) clean += "\xEF\xBF\xBD";
    rest.remove_prefix(std::min(good + 1, rest.size()));
  }
  return parse_yaml(clean);
}

}  // namespace

std::string name_of(const RunRecord::Metric& metric) {
  if (metric.fact.name.empty()) return metric.output;
  return metric.fact.name.starts_with(metric.output + ".") ? metric.fact.name : metric.output + "." + metric.fact.name;
}

/// A sweep has one model per variant: which one is meant?
void refuse_sweep(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::exists(folder / "sweep.json", ignored)) return;
  std::vector<std::string> variants;
  for (const auto& entry : fs::directory_iterator(folder / "variants", ignored))
    if (fs::exists(entry.path() / "result.json", ignored)) variants.push_back(entry.path().filename().string());
  std::sort(variants.begin(), variants.end());
  const std::string place = (folder / "variants").string();
  throw Error(folder.string() + " is the folder of a sweep, not of one run",
              variants.empty() ? "none of its variants is done: `atrium sweep run` goes on with it"
                               : "give one of its variants, as " + place + "/" + variants.front() + " (of " +
                                     std::to_string(variants.size()) + "); `atrium report " + folder.string() +
                                     "` compares all of them");
}

RunRecord read_run(const fs::path& folder) {
  RunRecord record;
  refuse_sweep(folder);
  record.folder = folder;
  const bool variant = fs::exists(folder / "result.json");
  const fs::path file = folder / (variant ? "result.json" : "manifest.json");
  if (!fs::exists(file))
    throw Error(folder.string() + " is no folder of a run: it has neither manifest.json nor result.json",
                "`atrium run FILE --out FOLDER` makes one, `atrium sweep run` one per variant: FOLDER/variants/ID");
  const json recorded = read_json_file(file);
  if (!recorded.is_object()) throw Error(file.string() + " cannot be read, or is no JSON file of Atrium");
  try {
    if (variant)
      read_variant(recorded, record);
    else
      read_manifest(recorded, record);
  } catch (const json::exception& error) {
    throw Error(file.string() + " cannot be understood: " + error.what(),
                "was it written by another version of Atrium?");
  }
  const YamlTree tree = read_resolved((folder / "resolved.yaml").string());
  if (!tree.root)
    throw Error((folder / "resolved.yaml").string() + ": " +
                (tree.problems.empty() ? "is empty" : tree.problems.front().message));
  read_parameters(*tree.root, record);
  return record;
}

}  // namespace atrium::report
