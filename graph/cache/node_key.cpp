#include "graph/cache/node_key.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>

#include "graph/api/plugin.hpp"
#include "graph/api/plugin_data.hpp"

namespace atrium {
namespace {

namespace fs = std::filesystem;

/// The folder of libatrium.so.
fs::path library_folder() {
  Dl_info info{};
  static const char anchor = 0;
  if (::dladdr(&anchor, &info) == 0 || info.dli_fname == nullptr) return {};
  std::error_code ignored;
  return fs::canonical(info.dli_fname, ignored).parent_path();
}

template <class Good>
void add_files(const fs::path& folder, Good good, std::vector<fs::path>& files) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (entry.is_regular_file(ignored) && !entry.is_symlink(ignored) && good(entry.path().filename().string()))
      files.push_back(entry.path());
}

/// Atrium's own libraries.
std::vector<fs::path> own_libraries() {
  std::vector<fs::path> files;
  add_files(
      library_folder(),
      [](const std::string& name) { return name.starts_with("libatrium") && name.find(".so") != std::string::npos; },
      files);
  return files;
}

/// A plugin's library, its second one, the programs beside them, and the files that its nodes read.
std::vector<fs::path> plugin_files(const fs::path& library) {
  const std::string second = library.stem().string() + "-run.so";
  std::vector<fs::path> files{library};
  const auto good = [&](const std::string& name) { return name == second || name.starts_with("atrium-"); };
  add_files(library.parent_path(), good, files);
  const auto data = plugin_data_files(library);
  files.insert(files.end(), data.begin(), data.end());
  return files;
}

std::string fingerprints(const std::vector<fs::path>& files) {
  std::string text;
  for (const auto& file : files) text += FileHashes::fingerprint(file) + "\n";
  return text;
}

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

const BuildIds::Build& BuildIds::build_of(const NodeType& type) {
  const auto [known, fresh] = known_.try_emplace(type.library);
  Build& build = known->second;
  if (!fresh && !build.hash.empty()) return build;
  build.files = own_libraries();
  if (!type.library.empty()) {
    auto more = plugin_files(type.library);
    build.files.insert(build.files.end(), more.begin(), more.end());
  }
  std::sort(build.files.begin(), build.files.end());
  build.fingerprint = fingerprints(build.files);
  std::string text = fmt::format("{}\n", ATRIUM_STAMP);
  for (const auto& file : build.files) text += fmt::format("{} {}\n", file.filename().string(), files_.of(file));
  ContentHash hash;
  hash.bytes(text.data(), text.size());
  build.hash = hash.hex();
  return build;
}

std::string BuildIds::of(const NodeType& type) {
  const std::lock_guard lock(mutex_);
  return build_of(type).hash;
}

bool BuildIds::unchanged(const NodeType& type) {
  const std::lock_guard lock(mutex_);
  const Build& build = build_of(type);
  return fingerprints(build.files) == build.fingerprint;
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
        add_file(key, fmt::format("{}[{}]", info.name, k), paths[k], files);
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
