#include "graph/pipeline/overrides.hpp"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "graph/api/text.hpp"

namespace atrium {
namespace {

/// A list or a quoted text is read as in a file; all else, "[hall].ply" and "'t Hof.ply", too, is the text itself.
bool is_yaml(std::string_view value) {
  if (value.size() < 2) return false;
  const char first = value.front(), last = value.back();
  return (first == '[' && last == ']') || ((first == '"' || first == '\'') && last == first);
}

/// The value that stands in the text. What cannot be read is returned.
std::optional<YamlProblem> read_value(const std::string& text, YamlNode& node) {
  node.kind = YamlNode::Kind::scalar;
  node.text = text;
  if (!is_yaml(text)) return std::nullopt;
  YamlTree tree = parse_yaml(text);
  if (!tree.root || !tree.problems.empty()) return tree.problems.front();
  node = std::move(*tree.root);
  return std::nullopt;
}

}  // namespace

Overrides::Overrides(const std::vector<Override>& given, const SourceFile& root, Findings& findings) {
  overrides_.reserve(given.size());  // by_node_ points into it
  for (const auto& item : given) add(item, root, findings);
}

const SourceFile* Overrides::source_of(const std::filesystem::path& folder) {
  std::error_code ignored;
  const auto place = folder.empty() ? std::filesystem::current_path(ignored) : folder;
  for (const auto& source : sources_)
    if (source.folder == place) return &source;
  return &sources_.emplace_back(SourceFile{"command line", place, 0});
}

void Overrides::add(const Override& given, const SourceFile& root, Findings& findings) {
  const std::string origin = given.origin.empty() ? "-s " + given.text : given.origin;
  const auto fail = [&](std::string message, std::string help) {
    findings.error({&root, {}}, std::move(message), std::move(help), {"set by " + origin});
  };
  const std::size_t equals = given.text.find('=');
  if (equals == std::string::npos || equals == 0) {
    fail(fmt::format("'{}' sets nothing", given.text),
         "write NODE.PARAMETER=VALUE, NODE.type=TYPE, NODE.pipeline=FILE or VARIABLE=VALUE");
    return;
  }
  const std::string target = given.text.substr(0, equals), value = given.text.substr(equals + 1);
  const std::size_t dot = target.rfind('.');
  ParsedOverride parsed;
  if (dot != std::string::npos) parsed.node = target.substr(0, dot);
  parsed.name = dot == std::string::npos ? target : target.substr(dot + 1);
  parsed.note = "set by " + origin;
  parsed.source = source_of(given.folder);
  YamlNode node;
  if (given.value) {
    node = *given.value;
  } else if (const auto problem = read_value(value, node)) {
    const bool star = value.find("[*") != std::string::npos || value.find(" *") != std::string::npos;
    fail(fmt::format("'{}' cannot be read: {}", value, problem->message),
         star ? "in a list, a pattern that begins with * stands in quotes: [\"*.ply\"]" : problem->help);
    return;
  }
  const std::size_t bad = given.value ? std::string::npos : first_not_text(given.text);
  if (bad != std::string::npos) {
    fail(fmt::format("'{}' is set to text that is not UTF-8: its byte {} is 0x{:02x}", target, bad,
                     static_cast<unsigned char>(given.text[bad])),
         "files name everything in UTF-8: rename the file (convmv does it for many)");
    if (first_not_text(target) != std::string::npos) return;
    node.text = "?";
  }
  if (value.empty() && !given.value) {
    fail(fmt::format("'{}' is set to nothing", target), "write a value after '='; an empty text is '\"\"'");
    return;
  }
  const SourceFile nowhere{root.name, {}, root.order};
  node.place = {};
  for (auto& item : node.items) item.place = {};
  parsed.setting = read_setting({parsed.name, {}}, node, nowhere, findings);
  parsed.setting.broken = parsed.setting.broken || bad != std::string::npos;
  auto& same_node = by_node_[parsed.node];
  for (const auto* earlier : same_node) {
    if (earlier->name != parsed.name) continue;
    fail(fmt::format("'{}' is set twice", target), fmt::format("it is {} already", earlier->note));
    return;
  }
  overrides_.push_back(std::move(parsed));
  same_node.push_back(&overrides_.back());
}

const std::vector<ParsedOverride*>& Overrides::of(const std::string& node) const {
  static const std::vector<ParsedOverride*> none;
  const auto found = by_node_.find(node);
  return found == by_node_.end() ? none : found->second;
}

const ParsedOverride* Overrides::find(const std::string& node, const std::string& name) const {
  for (const auto* item : of(node))
    if (item->name == name) return item;
  return nullptr;
}

ParsedOverride* Overrides::take(const std::string& node, const std::string& name) {
  for (auto* item : of(node)) {
    if (item->name != name) continue;
    item->used = true;
    return item;
  }
  return nullptr;
}

}  // namespace atrium
