#include "graph/cache/node_key.hpp"

#include <fmt/format.h>

namespace atrium {
namespace {

namespace fs = std::filesystem;

void add_file(NodeKey& key, const std::string& name, const std::string& path, FileHashes& files) {
  key.fields.push_back({name, files.of(path) + " " + fs::path(path).filename().string()});
}

}  // namespace

std::string NodeKey::hex() const {
  ContentHash hash;
  for (const auto& field : fields) {
    const std::string text = fmt::format("{}={}:{}\n", field.name, field.value.size(), field.value);
    hash.bytes(text.data(), text.size());
  }
  return hash.hex();
}

NodeKey make_key(const PipelineNode& node, const std::vector<std::vector<std::string>>& inputs,
                 const std::string& build, FileHashes& files) {
  const NodeType& type = *node.type;
  NodeKey key;
  key.fields = {{"type", type.type}, {"version", std::to_string(type.version)}, {"build", build}};
  if (type.random) key.fields.push_back({"seed", std::to_string(node.seed)});
  for (std::size_t i = 0; i < type.params.size(); ++i) {
    const ParamInfo& info = type.params[i];
    if (info.kind == ParamKind::input_path) {
      add_file(key, info.name, std::get<std::string>(node.params[i]), files);
    } else if (info.kind == ParamKind::input_paths) {
      const auto& paths = std::get<std::vector<std::string>>(node.params[i]);
      for (std::size_t k = 0; k < paths.size(); ++k)
        add_file(key, paths.size() == 1 ? info.name : fmt::format("{}[{}]", info.name, k), paths[k], files);
    } else {
      key.fields.push_back({info.name, format_param(info, node.params[i])});
    }
  }
  for (std::size_t i = 0; i < inputs.size(); ++i)
    for (std::size_t k = 0; k < inputs[i].size(); ++k)
      key.fields.push_back(
          {type.inputs[i].repeated ? fmt::format("in {}[{}]", type.inputs[i].name, k) : "in " + type.inputs[i].name,
           inputs[i][k]});
  return key;
}

std::vector<fs::path> input_files(const PipelineNode& node) {
  std::vector<fs::path> files;
  for (std::size_t i = 0; i < node.params.size(); ++i) {
    const ParamKind kind = node.type->params[i].kind;
    if (kind == ParamKind::input_path) files.emplace_back(std::get<std::string>(node.params[i]));
    if (kind == ParamKind::input_paths)
      for (const auto& path : std::get<std::vector<std::string>>(node.params[i])) files.emplace_back(path);
  }
  return files;
}

}  // namespace atrium
