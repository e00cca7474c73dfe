#include "graph/pipeline/registry.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <set>

#include "graph/api/plugin.hpp"
#include "graph/api/text_check.hpp"

namespace atrium {
namespace {

constexpr std::string_view prefix = "libatrium_";
constexpr std::string_view suffix = ".so";

/// The folder of the plugins that came with this library: <folder of libatrium.so>/atrium.
std::filesystem::path own_plugin_folder() {
  Dl_info info{};
  static const char anchor = 0;
  if (::dladdr(&anchor, &info) == 0 || info.dli_fname == nullptr) return {};
  std::error_code ignored;
  const std::filesystem::path library = std::filesystem::canonical(info.dli_fname, ignored);
  return ignored ? std::filesystem::path{} : library.parent_path() / "atrium";
}

std::vector<std::filesystem::path> plugin_folders() {
  std::vector<std::filesystem::path> folders;
  // NOLINTNEXTLINE(concurrency-mt-unsafe)
  if (const char* list = std::getenv("ATRIUM_PLUGIN_PATH"); list != nullptr) {
    std::string_view rest = list;
    while (!rest.empty()) {
      const std::size_t end = std::min(rest.find(':'), rest.size());
      if (end > 0) folders.emplace_back(rest.substr(0, end));
      rest.remove_prefix(std::min(rest.size(), end + 1));
    }
  }
  if (auto own = own_plugin_folder(); !own.empty()) folders.push_back(std::move(own));
  return folders;
}

std::string module_of(const std::string& type) { return type.substr(0, type.find('.')); }

bool is_module_name(std::string_view name) {
  const auto good = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; };
  return !name.empty() && std::all_of(name.begin(), name.end(), good);
}

/// Whether Atrium's own build has a plugin of that name: modules.txt, beside the plugins, lists them, built or not.
bool is_own_module(const std::string& module) {
  std::ifstream list(own_plugin_folder() / "modules.txt");
  for (std::string line; std::getline(list, line);)
    if (line == module) return true;
  return false;
}

using StampFunction = const char* (*)();
using NodesFunction = void (*)(std::vector<NodeType>&);
using ChecksFunction = void (*)(std::vector<TextCheck>&);

/// What the loaded plugins say of their texts, by node type and parameter.
class TextChecks {
 public:
  static TextChecks& all() {
    static TextChecks checks;
    return checks;
  }
  void take(void* handle) {
    const auto function = reinterpret_cast<ChecksFunction>(::dlsym(handle, "atrium_plugin_text_checks"));
    if (function == nullptr) return;
    std::vector<TextCheck> checks;
    function(checks);
    const std::lock_guard lock(mutex_);
    for (const auto& check : checks)
      checks_.try_emplace({std::string(check.type), std::string(check.param)}, check.check);
  }
  void run(const std::string& type, const std::string& param, const std::string& text) {
    decltype(TextCheck::check) check = nullptr;
    {
      const std::lock_guard lock(mutex_);
      if (const auto found = checks_.find({type, param}); found != checks_.end()) check = found->second;
    }
    if (check != nullptr) check(text);
  }

 private:
  std::mutex mutex_;
  std::map<std::pair<std::string, std::string>, decltype(TextCheck::check)> checks_;
};

void check_stamp(void* handle, const std::string& file) {
  const auto stamp = reinterpret_cast<StampFunction>(::dlsym(handle, "atrium_plugin_stamp"));
  if (stamp == nullptr || ::dlsym(handle, "atrium_plugin_nodes") == nullptr)
    throw PluginError(fmt::format("{} is not an Atrium plugin", file),
                      "build it with atrium_add_plugin(), or move it out of the plugin folder");
  const std::string_view theirs = stamp();
  if (theirs != ATRIUM_STAMP)
    throw PluginError(fmt::format("{} was built for another framework", file),
                      fmt::format("it says '{}', this program needs '{}': rebuild it", theirs, ATRIUM_STAMP));
}

std::vector<NodeType> load_plugin(const std::filesystem::path& file, const std::string& module) {
  void* handle = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);  // never closed: values outlive any scope we know
  if (handle == nullptr) throw PluginError(fmt::format("cannot load the plugin '{}': {}", module, ::dlerror()));
  check_stamp(handle, file.string());
  std::vector<NodeType> nodes;
  reinterpret_cast<NodesFunction>(::dlsym(handle, "atrium_plugin_nodes"))(nodes);
  TextChecks::all().take(handle);
  std::set<std::string> names;
  for (const auto& node : nodes) {
    if (module_of(node.type) != module || node.type.size() <= module.size() + 1)
      throw PluginError(fmt::format("{} has the node type '{}'", file.string(), node.type),
                        fmt::format("the types of this plugin begin with '{}.'", module));
    if (!names.insert(node.type).second)
      throw PluginError(fmt::format("{} has the node type '{}' twice", file.string(), node.type));
  }
  return nodes;
}

/// The second libraries that have been loaded: their node types by name.
const NodeType& node_of_second_library(const std::string& file, const std::string& module, const std::string& type) {
  static std::mutex mutex;
  static std::map<std::string, std::map<std::string, NodeType>> loaded;
  const std::lock_guard lock(mutex);  // nodes that run side by side may ask for the same one
  auto library = loaded.find(file);
  if (library == loaded.end()) {
    std::map<std::string, NodeType> types;
    for (auto& node : load_plugin(file, module)) types.emplace(node.type, node);
    library = loaded.emplace(file, std::move(types)).first;
  }
  const auto found = library->second.find(type);
  if (found == library->second.end())
    throw PluginError(fmt::format("{} has no node type '{}'", file, type),
                      "build and install both libraries of the plugin");
  return found->second;
}

/// The function of a node type that is in a second library.
struct SecondLibrary {
  std::string file, type;
  std::vector<Value> operator()(const std::vector<std::vector<Value>>& inputs, const std::vector<ParamValue>& params,
                                Context& context) const {
    return node_of_second_library(file, module_of(type), type).run(inputs, params, context);
  }
};

}  // namespace

void check_text(const std::string& type, const std::string& param, const std::string& text) {
  TextChecks::all().run(type, param, text);
}

decltype(NodeType::run) detail::run_of_second_library(const void* anchor, const std::string& type) {
  Dl_info info{};
  const bool known = ::dladdr(anchor, &info) != 0 && info.dli_fname != nullptr;
  std::string file = known ? info.dli_fname : "";
  if (file.ends_with(suffix)) file.resize(file.size() - suffix.size());
  file += "-run.so";
  return SecondLibrary{file, type};
}

struct Registry::Impl {
  std::vector<std::filesystem::path> folders;
  std::map<std::string, NodeType, std::less<>> types;  // nodes of a map do not move
  std::set<std::string> loaded;

  std::filesystem::path plugin_file(const std::string& module) const {
    for (const auto& folder : folders) {
      std::filesystem::path file = folder / fmt::format("{}{}{}", prefix, module, suffix);
      std::error_code ignored;
      if (std::filesystem::is_regular_file(file, ignored)) return file;
    }
    return {};
  }

  void load(const std::string& module) {
    if (!is_module_name(module) || loaded.contains(module)) return;
    const std::filesystem::path file = plugin_file(module);
    if (file.empty()) return;
    for (auto& node : load_plugin(file, module)) {
      node.library = file.string();
      std::string name = node.type;
      types.try_emplace(std::move(name), std::move(node));
    }
    loaded.insert(module);
  }
};

Registry::Registry() : Registry(plugin_folders()) {}
Registry::Registry(std::vector<std::filesystem::path> folders) : impl_(std::make_unique<Impl>()) {
  impl_->folders = std::move(folders);
}
Registry::~Registry() = default;

const NodeType* Registry::find(const std::string& type) {
  auto found = impl_->types.find(type);
  if (found == impl_->types.end()) {
    impl_->load(module_of(type));
    found = impl_->types.find(type);
  }
  return found == impl_->types.end() ? nullptr : &found->second;
}

std::vector<const NodeType*> Registry::all(std::vector<std::string>* problems) {
  for (const auto& module : modules()) {
    try {
      impl_->load(module);
    } catch (const PluginError& error) {
      if (problems == nullptr) throw;
      problems->emplace_back(error.what());
    }
  }
  std::vector<const NodeType*> result;
  for (const auto& [name, type] : impl_->types) result.push_back(&type);
  return result;
}

bool Registry::is_left_out(const std::string& module) const {
  return impl_->plugin_file(module).empty() && is_own_module(module);
}

std::string Registry::missing_library(const NodeType& type) {
  const auto* second = type.run.target<SecondLibrary>();
  std::error_code ignored;
  return second == nullptr || std::filesystem::exists(second->file, ignored) ? "" : second->file;
}

void Registry::add(NodeType type) {
  std::string name = type.type;
  impl_->types.insert_or_assign(std::move(name), std::move(type));
}

std::vector<std::filesystem::path> Registry::plugin_files() const {
  std::vector<std::filesystem::path> files;
  for (const auto& module : modules())
    if (auto file = impl_->plugin_file(module); !file.empty()) files.push_back(std::move(file));
  return files;
}

std::vector<std::string> Registry::modules() const {
  std::set<std::string> names;
  for (const auto& folder : impl_->folders) {
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
      const std::string file = entry.path().filename().string();
      if (file.size() <= prefix.size() + suffix.size() || !file.starts_with(prefix) || !file.ends_with(suffix))
        continue;
      std::string name = file.substr(prefix.size(), file.size() - prefix.size() - suffix.size());
      if (is_module_name(name)) names.insert(std::move(name));
    }
  }
  for (const auto& [name, type] : impl_->types) names.insert(module_of(name));
  return {names.begin(), names.end()};
}

}  // namespace atrium
