#include <fmt/format.h>

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

std::string port_name(const Pipeline& pipeline, const Edge& edge) {
  const PipelineNode& node = pipeline.nodes[edge.node];
  return fmt::format("{}.{}", node.path, node.type->outputs[edge.output].name);
}

std::string wiring(const Pipeline& pipeline, const PortInfo& info, const std::vector<Edge>& edges) {
  std::string list;
  for (const auto& edge : edges) list += (list.empty() ? "" : ", ") + port_name(pipeline, edge);
  return info.repeated ? "[" + list + "]" : list;
}

/// A path in `folder` as seen from there; any other stays absolute.
std::string seen_from(const std::string& path, const std::filesystem::path& folder) {
  if (folder.empty()) return path;
  const auto relative = std::filesystem::path(path).lexically_relative(folder);
  return relative.empty() || *relative.begin() == ".." ? path : relative.string();
}

ParamValue placed(const ParamInfo& info, const ParamValue& value, const std::filesystem::path& folder) {
  if (info.kind == ParamKind::input_path) return seen_from(std::get<std::string>(value), folder);
  if (info.kind != ParamKind::input_paths) return value;
  auto paths = std::get<std::vector<std::string>>(value);
  for (auto& path : paths) path = seen_from(path, folder);
  return paths;
}

std::string node_yaml(const Pipeline& pipeline, const PipelineNode& node, const std::filesystem::path& folder) {
  std::string result = fmt::format("  {}:\n    type: {}\n", node.path, node.type->type);
  std::string section;
  for (std::size_t i = 0; i < node.inputs.size(); ++i)
    if (!node.inputs[i].empty())
      section += fmt::format("      {}: {}\n", node.type->inputs[i].name,
                             wiring(pipeline, node.type->inputs[i], node.inputs[i]));
  if (!section.empty()) result += "    in:\n" + section;
  section.clear();
  for (std::size_t i = 0; i < node.params.size(); ++i)
    section +=
        fmt::format("      {}: {}\n", node.type->params[i].name,
                    format_param(node.type->params[i], escaped(placed(node.type->params[i], node.params[i], folder))));
  if (!section.empty()) result += "    params:\n" + section;
  return result;
}

}  // namespace

std::string resolved_yaml(const Pipeline& pipeline, const std::filesystem::path& folder) {
  std::string result = "atrium: 1\n";
  if (!pipeline.summary.empty()) result += fmt::format("summary: {}\n", text(pipeline.summary));
  result += fmt::format("seed: {}\nversions:\n  atrium: {}\n", pipeline.seed, framework_version());
  std::map<std::string, int> versions;
  for (const auto& node : pipeline.nodes) versions[node.type->type] = node.type->version;
  for (const auto& [type, version] : versions) result += fmt::format("  {}: {}\n", type, version);
  result += "nodes:\n";
  for (const auto& node : pipeline.nodes) result += node_yaml(pipeline, node, folder);
  if (!pipeline.outputs.empty()) result += "outputs:\n";
  for (const auto& output : pipeline.outputs)
    result += fmt::format("  {}: {}\n", output.name, port_name(pipeline, output.from));
  return result;
}

}  // namespace atrium
