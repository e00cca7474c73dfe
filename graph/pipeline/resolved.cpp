#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "graph/pipeline/document.hpp"
#include "graph/pipeline/pipeline.hpp"

namespace atrium {
namespace {

std::string text(const std::string& value) {
  ParamInfo info;
  info.kind = ParamKind::text;
  return format_param(info, value);
}

/// Text values as a file must write them: `${` escaped.
ParamValue escaped(const ParamValue& value) {
  if (const auto* single = std::get_if<std::string>(&value)) return with_escapes(*single);
  if (const auto* list = std::get_if<std::vector<std::string>>(&value)) {
    std::vector<std::string> result;
    for (const auto& item : *list) result.push_back(with_escapes(item));
    return result;
  }
  return value;
}

std::string port_name(const Pipeline& pipeline, const Source& source) {
  const PipelineNode& node = pipeline[source.node];
  return fmt::format("{}.{}", node.path, node.type->outputs[source.output].name);
}

std::string wiring(const Pipeline& pipeline, const PortInfo& info, const std::vector<Source>& sources) {
  std::string list;
  for (const auto& source : sources) list += (list.empty() ? "" : ", ") + port_name(pipeline, source);
  return info.repeated ? "[" + list + "]" : list;
}

/// Where files are seen from.
struct View {
  const std::filesystem::path& folder;
  bool all;
};

/// A path in the folder as seen from there; any other stays absolute, unless all are to be seen from there that have
/// more in common with the folder than the root: they move together.
std::string seen_from(const std::string& path, const View& view) {
  if (view.folder.empty()) return path;
  const auto relative = std::filesystem::path(path).lexically_relative(view.folder);
  if (relative.empty()) return path;
  if (*relative.begin() != "..") return relative.string();
  const auto up = std::count(relative.begin(), relative.end(), "..");
  const auto depth = std::distance(view.folder.relative_path().begin(), view.folder.relative_path().end());
  return view.all && up < depth ? relative.string() : path;
}

ParamValue placed(const ParamInfo& info, const ParamValue& value, const View& view) {
  if (info.kind == ParamKind::input_path) return seen_from(std::get<std::string>(value), view);
  if (info.kind != ParamKind::input_paths) return value;
  auto paths = std::get<std::vector<std::string>>(value);
  for (auto& path : paths) path = seen_from(path, view);
  return paths;
}

std::string node_yaml(const Pipeline& pipeline, std::size_t n, const View& view) {
  const PipelineNode& node = pipeline[n];
  const auto inputs = inputs_of(n, pipeline);
  std::string result = fmt::format("  {}:\n    type: {}\n", node.path, node.type->type);
  std::string section;
  for (std::size_t i = 0; i < inputs.size(); ++i)
    if (!inputs[i].empty())
      section +=
          fmt::format("      {}: {}\n", node.type->inputs[i].name, wiring(pipeline, node.type->inputs[i], inputs[i]));
  if (!section.empty()) result += "    in:\n" + section;
  section.clear();
  for (std::size_t i = 0; i < node.params.size(); ++i)
    section +=
        fmt::format("      {}: {}\n", node.type->params[i].name,
                    format_param(node.type->params[i], escaped(placed(node.type->params[i], node.params[i], view))));
  if (!section.empty()) result += "    params:\n" + section;
  return result;
}

}  // namespace

std::string resolved_yaml(const Pipeline& pipeline, const std::filesystem::path& folder, bool all) {
  std::string result = "atrium: 1\n";
  const PipelineProperties& properties = pipeline[whole];
  if (!properties.summary.empty()) result += fmt::format("summary: {}\n", text(properties.summary));
  result += fmt::format("seed: {}\nversions:\n  atrium: {}\n", properties.seed, framework_version());
  std::map<std::string, int> versions;
  for (const std::size_t n : all_nodes(pipeline)) versions[pipeline[n].type->type] = pipeline[n].type->version;
  for (const auto& [type, version] : versions) result += fmt::format("  {}: {}\n", type, version);
  result += "nodes:\n";
  for (const std::size_t n : all_nodes(pipeline)) result += node_yaml(pipeline, n, {folder, all});
  if (!properties.outputs.empty()) result += "outputs:\n";
  for (const auto& output : properties.outputs)
    result += fmt::format("  {}: {}\n", output.name, port_name(pipeline, output.from));
  return result;
}

}  // namespace atrium
