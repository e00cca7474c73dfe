#include <fmt/format.h>

#include <algorithm>

#include "graph/api/suggest.hpp"
#include "graph/pipeline/expansion.hpp"
#include "graph/pipeline/find_pipeline.hpp"

namespace atrium {
namespace {

constexpr std::string_view how_to_build = "./share/build, or ninja -C build, builds all of Atrium";
constexpr std::size_t most_nodes = 100'000;
constexpr std::size_t most_scopes = 20'000;
constexpr int deepest_chain = 32;

std::vector<std::string> names_of(const std::vector<Setting>& settings) {
  return words_of(settings, [](const Setting& setting) { return setting.name.text; });
}

/// The scope's place as settings name it: "" or "shell".
std::string address_of(const Scope& scope) {
  return scope.prefix.empty() ? "" : scope.prefix.substr(0, scope.prefix.size() - 1);
}

/// Whether a node that is not left out uses the variable.
bool is_needed(const Scope& scope, const std::string& variable) {
  const auto names = [&](const Setting& setting) {
    return std::any_of(setting.value.items.begin(), setting.value.items.end(),
                       [&](const std::string& item) { return variable_of(item) == variable; });
  };
  return std::any_of(scope.document->nodes.begin(), scope.document->nodes.end(), [&](const DocumentNode& node) {
    return !scope.dormant.contains(node.id.text) && (std::any_of(node.params.begin(), node.params.end(), names) ||
                                                     std::any_of(node.variables.begin(), node.variables.end(), names));
  });
}

/// Calls look(reference) for everything that a node of a document reads.
template <class Look>
void for_each_source(const DocumentNode& node, Look look) {
  for (const auto& wiring : node.inputs)
    for (const auto& source : wiring.sources) look(source);
}

}  // namespace

bool is_wired(const Scope& scope, const std::string& input) {
  if (scope.node == nullptr) return false;
  const auto& wirings = scope.node->inputs;
  return std::any_of(wirings.begin(), wirings.end(), [&](const Wiring& w) { return w.port.text == input; });
}

SettledValue settle(const Setting& setting, const Scope& scope, const SourceFile& from, const Where& where,
                    Findings& findings, std::vector<std::string> notes) {
  SettledValue result;
  result.notes = std::move(notes);
  result.value.is_list = setting.value.is_list;
  result.value.quoted = setting.value.quoted;
  result.broken = setting.broken;
  for (const auto& item : setting.value.items) {
    const auto name = variable_of(item);
    if (!name) {
      result.value.items.push_back(without_escapes(item));
      result.bases.push_back(&from);
      continue;
    }
    const auto found = scope.variables.find(*name);
    if (found == scope.variables.end()) {
      // What stands in a file has been reported by the file's own check.
      if (!setting.broken) findings.error(where, fmt::format("unknown variable '{}'", *name), {}, result.notes);
      result.broken = true;
      continue;
    }
    const SettledValue& variable = found->second;
    result.broken = result.broken || variable.broken;
    if (variable.value.is_list && setting.value.is_list) {
      findings.error(where, fmt::format("the variable '{}' is a list and stands in a list", *name),
                     "let it stand for the whole list", variable.notes);
      result.broken = true;
    }
    result.missing.insert(result.missing.end(), variable.missing.begin(), variable.missing.end());
    result.notes.insert(result.notes.end(), variable.notes.begin(), variable.notes.end());
    result.value.items.insert(result.value.items.end(), variable.value.items.begin(), variable.value.items.end());
    result.bases.insert(result.bases.end(), variable.bases.begin(), variable.bases.end());
    if (!setting.value.is_list) {
      result.value.is_list = variable.value.is_list;
      result.value.quoted = variable.value.quoted;
    }
  }
  return result;
}

void Expander::expand(const Document& root) {
  by_identity_.emplace(root.identity, &root);
  expansion_.scopes.emplace_back().document = &root;
  expansion_.graph.m_vertices.reserve(root.nodes.size());
  expansion_.origins.reserve(root.nodes.size());
  fill(expansion_.scopes.front());
  report_unknown_nodes();
}

/// A node sleeps if a default that is not used reads it, or another sleeping node, and nothing else does.
std::unordered_set<std::string> Expander::dormant_nodes(const Scope& scope) {
  const Document& document = *scope.document;
  std::unordered_set<std::string> dormant;
  for (const auto& input : document.inputs)
    if (input.default_source && is_wired(scope, input.name.text)) dormant.insert(input.default_source->node);
  if (dormant.empty()) return dormant;
  const auto grow = [&] {
    const std::size_t before = dormant.size();
    for (const auto& node : document.nodes)
      if (dormant.contains(node.id.text)) for_each_source(node, [&](const Reference& r) { dormant.insert(r.node); });
    return dormant.size() != before;
  };
  while (grow()) {
  }
  const auto shrink = [&] {  // what is read by others is awake
    const std::size_t before = dormant.size();
    for (const auto& output : document.outputs) dormant.erase(output.source.node);
    for (const auto& input : document.inputs)
      if (input.default_source && !is_wired(scope, input.name.text)) dormant.erase(input.default_source->node);
    for (const auto& node : document.nodes)
      if (!dormant.contains(node.id.text)) for_each_source(node, [&](const Reference& r) { dormant.erase(r.node); });
    return dormant.size() != before;
  };
  while (shrink()) {
  }
  return dormant;
}

void Expander::fill(Scope& scope) {
  scope.dormant = dormant_nodes(scope);
  settle_variables(scope);
  for (const auto& node : scope.document->nodes) {
    if (expansion_.origins.size() > most_nodes || expansion_.scopes.size() > most_scopes) return;
    if (scope.members.contains(node.id.text) || scope.dormant.contains(node.id.text)) continue;
    if (const ParsedOverride* swap = overrides_.take(scope.prefix + node.id.text, "pipeline"); swap != nullptr)
      open_pipeline(scope, swapped(node, *swap), swap);
    else if (node.pipeline.text.empty())
      add_node(scope, node);
    else
      open_pipeline(scope, node, nullptr);
  }
}

void Expander::settle_variables(Scope& scope) {
  const Scope& root = expansion_.scopes.front();
  const std::string address = address_of(scope);
  check_given_variables(scope);
  for (const auto& variable : scope.document->variables) {
    const std::string& name = variable.name.text;
    const Setting* given = nullptr;
    if (scope.node != nullptr)
      for (const auto& setting : scope.node->variables)
        if (setting.name.text == name) given = &setting;
    SettledValue value;
    if (const ParsedOverride* set = overrides_.take(address, name); set != nullptr) {
      value = settle(set->setting, root, *set->source, scope.at(variable.place), findings_, {set->note});
    } else if (given != nullptr) {
      const Where place = scope.parent->at(given->place);
      value = settle(*given, *scope.parent, scope.parent->document->source, place, findings_,
                     {fmt::format("'{}' is set by {}", name, to_string(place))});
    } else if (variable.unset && scope.node != nullptr && !is_needed(scope, name)) {
      value.missing.push_back(name);
    } else {
      const Where place = scope.at(variable.place);
      value = settle(variable, scope, scope.document->source, place, findings_,
                     {fmt::format("'{}' is set by {}", name, to_string(place))});
      if (variable.unset && scope.node == nullptr) {
        value.missing.push_back(name);
        expansion_.missing_variables.push_back(name);
      } else if (variable.unset) {
        findings_.error(scope.parent->at(scope.node->id.place),
                        fmt::format("the variable '{}' of '{}' has no value", name, scope.node->id.text),
                        fmt::format("add `vars: {{{}: …}}` to the node", name));
        value.broken = true;
      }
    }
    scope.variables.emplace(name, std::move(value));
  }
}

/// Variables that are set from outside must be there: in the sub-pipeline's file, or the outermost one.
void Expander::check_given_variables(const Scope& scope) {
  const std::vector<std::string> names = names_of(scope.document->variables);
  const auto known = [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  if (scope.node != nullptr)
    for (const auto& setting : scope.node->variables) {
      if (known(setting.name.text)) continue;
      if (const auto* swap = overrides_.find(address_of(scope), "pipeline"); swap != nullptr) {
        findings_.warning(scope.parent->at(setting.name.place),
                          fmt::format("the variable '{}' is ignored: {} has none of that name", setting.name.text,
                                      scope.document->source.name),
                          {}, {swap->note});
        continue;
      }
      const std::string hint = findings_.suggest(setting.name.text, names);
      findings_.error(scope.parent->at(setting.name.place),
                      fmt::format("{} has no variable '{}'", scope.document->source.name, setting.name.text),
                      hint.empty() && !names.empty() ? "its variables: " + join_words(names) : hint);
    }
  for (const auto* set : overrides_.of(address_of(scope))) {
    const bool outermost = scope.node == nullptr;
    if (known(set->name) || set->name == (outermost ? "seed" : "type") || (!outermost && set->name == "pipeline"))
      continue;
    std::vector<std::string> candidates = names;
    if (outermost) candidates.emplace_back("seed");
    std::string hint = findings_.suggest(set->name, candidates);
    for (const auto& node : scope.document->nodes)
      if (outermost && node.id.text == set->name)
        hint = fmt::format("a node's parameter: -s {}.PARAMETER=VALUE", set->name);
      else if (const auto& params = node.params;
               outermost &&
               std::any_of(params.begin(), params.end(), [&](const auto& p) { return p.name.text == set->name; }))
        hint = fmt::format("a parameter of the node '{0}': -s {0}.{1}=VALUE", node.id.text, set->name);
    if (hint.empty()) hint = candidates.empty() ? "it has no variables" : "what can be set: " + join_words(candidates);
    const Where where =
        scope.node == nullptr ? Where{&scope.document->source, {}} : scope.parent->at(scope.node->id.place);
    findings_.error(where,
                    scope.node == nullptr
                        ? fmt::format("unknown variable '{}'", set->name)
                        : fmt::format("{} has no variable '{}'", scope.document->source.name, set->name),
                    hint, {set->note});
  }
}

void Expander::add_node(Scope& scope, const DocumentNode& node) {
  PipelineNode vertex;
  vertex.path = scope.prefix + node.id.text;
  const NodeOrigin origin{&scope, &node, overrides_.take(vertex.path, "type")};
  Where where = scope.at(node.type.place);
  std::string type = node.type.text;
  std::vector<std::string> notes;
  if (origin.swap != nullptr) {
    type = origin.swap->setting.value.items.empty() ? "" : origin.swap->setting.value.items.front();
    notes.push_back(origin.swap->note);
    if (node.type.place.line == 0) where = origin.where();
  }
  if (!type.empty()) {
    vertex.type = registry_.find(type);
    if (vertex.type == nullptr)
      report_unknown_type(where, type, notes);
    else if (!Registry::missing_library(*vertex.type).empty())
      findings_.error(where, fmt::format("'{}' is not built", type), std::string(how_to_build), notes);
  }
  scope.members.emplace(node.id.text, Member{atrium::add_node(vertex, expansion_.graph), nullptr});
  expansion_.origins.push_back(origin);
  if (expansion_.origins.size() == most_nodes + 1)
    findings_.error(scope.at(node.id.place), fmt::format("the pipeline has more than {} nodes", most_nodes));
}

/// The node as a sub-pipeline of the file that the command line names, its wiring kept.
const DocumentNode& Expander::swapped(const DocumentNode& node, const ParsedOverride& swap) {
  DocumentNode& result = expansion_.swapped.emplace_back(node);
  const auto& items = swap.setting.value.items;
  result.type = {};
  result.params.clear();
  result.pipeline = {items.empty() ? "" : items.front(), node.id.place};
  return result;
}

void Expander::open_pipeline(Scope& scope, const DocumentNode& node, const ParsedOverride* swap) {
  const std::string path = scope.prefix + node.id.text;
  Member member;
  for (const auto* set : overrides_.of(path)) {
    if (set->name != "type") continue;
    findings_.error(scope.at(node.id.place), fmt::format("'{}' is a sub-pipeline, which has no type", path),
                    fmt::format("its nodes have: {}/NODE.type=TYPE", path), {set->note});
    overrides_.take(path, "type");
  }
  if (expansion_.scopes.size() == most_scopes)
    findings_.error(scope.at(node.id.place), fmt::format("the pipeline has more than {} sub-pipelines", most_scopes));
  const bool full = expansion_.scopes.size() > most_scopes;
  if (const Document* document = full ? nullptr : document_of(scope, node, swap); document != nullptr) {
    Scope& inner = expansion_.scopes.emplace_back();
    inner.document = document;
    inner.parent = &scope;
    inner.node = &node;
    inner.prefix = path + "/";
    member.scope = &inner;
  }
  scope.members.emplace(node.id.text, member);
  if (member.scope != nullptr) fill(*member.scope);
}

/// The sub-pipeline's file, read once; null when it cannot be opened or would open itself.
const Document* Expander::document_of(const Scope& scope, const DocumentNode& node, const ParsedOverride* swap) {
  const SourceFile& file = scope.document->source;
  const std::string& text = node.pipeline.text;
  const std::filesystem::path& folder = swap == nullptr ? file.folder : swap->source->folder;
  auto [known, fresh] = opened_.try_emplace(folder.string() + '\n' + text);
  std::error_code missing;
  if (fresh) {
    auto& [path, is_installed, identity] = known->second;
    const NamedPipeline found = find_pipeline(folder, text);
    path = found.path;
    is_installed = found.is_installed;
    if (std::filesystem::is_regular_file(path, missing)) identity = std::filesystem::canonical(path, missing).string();
  }
  const auto& [path, is_installed, identity] = known->second;
  const std::string name = swap == nullptr && !is_installed
                               ? (std::filesystem::path(file.name).parent_path() / text).lexically_normal().string()
                               : path.string();
  if (identity.empty()) {
    const std::string help = help_for_missing_pipeline(folder, text, findings_);
    findings_.error(scope.at(node.pipeline.place), fmt::format("no such pipeline file: {}", name),
                    swap == nullptr ? help + "; a path is relative to the file that it stands in" : help,
                    swap == nullptr ? std::vector<std::string>{} : std::vector{swap->note});
    return nullptr;
  }
  if (opens_itself(scope, node, identity, name)) return nullptr;
  const auto [entry, unread] = by_identity_.try_emplace(identity, nullptr);
  if (unread) {
    auto document = expansion_.read->read(path, name, expansion_.documents.size(), findings_);
    entry->second = document.get();
    if (document) expansion_.documents.push_back(std::move(document));
  }
  return entry->second;
}

bool Expander::opens_itself(const Scope& scope, const DocumentNode& node, const std::string& identity,
                            const std::string& name) {
  std::string chain = name;
  int depth = 0;
  for (const Scope* outer = &scope; outer != nullptr; outer = outer->parent, ++depth) {
    chain.insert(0, outer->document->source.name + " → ");
    const bool itself = outer->document->identity == identity;
    if (!itself && depth < deepest_chain) continue;
    findings_.error(scope.at(node.pipeline.place),
                    itself ? "a sub-pipeline opens itself: " + chain : "sub-pipelines are nested too deep: " + chain);
    return true;
  }
  return false;
}

void Expander::report_unknown_type(const Where& where, const std::string& type, std::vector<std::string> notes) {
  if (all_types_.empty()) {
    std::vector<std::string> problems;
    for (const auto* known : registry_.all(&problems)) all_types_.push_back(known->type);
    modules_ = registry_.modules();
  }
  const std::size_t dot = type.find('.');
  const std::string module = type.substr(0, dot);
  if (dot != std::string::npos && registry_.is_left_out(module)) {
    findings_.error(where, fmt::format("'{}' is not built: the plugin '{}' was left out", type, module),
                    std::string(how_to_build), std::move(notes));
    return;
  }
  std::string message = fmt::format("unknown node type '{}'", type), help = findings_.suggest(type, all_types_);
  std::vector<std::string> siblings;
  for (const auto& known : all_types_)
    if (known.starts_with(module + ".")) siblings.push_back(known);
  if (dot == std::string::npos) {
    if (help.empty()) help = "a type is named module.name; atrium nodes lists them";
  } else if (std::find(modules_.begin(), modules_.end(), module) == modules_.end()) {
    message += fmt::format(": there is no plugin '{}'", module);
    if (help.empty())
      help = fmt::format("modules: {}; plugins are also looked for in ATRIUM_PLUGIN_PATH", join_words(modules_, 40));
  } else if (help.empty()) {
    help = "types of the module: " + join_words(siblings);
  }
  findings_.error(where, std::move(message), std::move(help), std::move(notes));
}

/// Settings of nodes that are not there.
void Expander::report_unknown_nodes() {
  if (overrides_.all().empty()) return;
  const Document& root = *expansion_.scopes.front().document;
  std::vector<std::string> paths;
  for (const auto& scope : expansion_.scopes)
    for (const auto& node : scope.document->nodes)
      if (!scope.dormant.contains(node.id.text)) paths.push_back(scope.prefix + node.id.text);
  for (const auto& set : overrides_.all()) {
    if (set.node.empty() || std::find(paths.begin(), paths.end(), set.node) != paths.end()) continue;
    const std::string hint = findings_.suggest(set.node, paths);
    findings_.error({&root.source, {}}, fmt::format("unknown node '{}'", set.node),
                    hint.empty() ? "nodes: " + join_words(paths) : hint, {set.note});
  }
}

}  // namespace atrium
