#include <fmt/format.h>

#include <algorithm>

#include "graph/api/text.hpp"
#include "graph/pipeline/document.hpp"

namespace atrium {

bool is_name(std::string_view text) {
  const auto letter = [](char c) { return c >= 'a' && c <= 'z'; };
  const auto follows = [&](char c) { return letter(c) || (c >= '0' && c <= '9') || c == '_'; };
  return !text.empty() && letter(text.front()) && std::all_of(text.begin(), text.end(), follows);
}

std::optional<std::string> variable_of(std::string_view text) {
  if (!text.starts_with("${") || !text.ends_with('}')) return std::nullopt;
  const std::string_view name = text.substr(2, text.size() - 3);
  if (name.find_first_of("${} ") != std::string_view::npos) return std::nullopt;
  return std::string(name);
}

namespace {

/// A '${' that is neither a whole value nor escaped.
bool has_stray_variable(std::string_view text) {
  if (variable_of(text)) return false;
  for (std::size_t at = text.find("${"); at != std::string_view::npos; at = text.find("${", at + 2))
    if (at == 0 || text[at - 1] != '$') return true;
  return false;
}

}  // namespace

std::string without_escapes(std::string_view text) { return replaced(text, "$${", "${"); }
std::string with_escapes(std::string_view text) { return replaced(text, "${", "$${"); }

Setting read_setting(const Located& name, const YamlNode& node, const SourceFile& source, Findings& findings) {
  Setting setting{name, {}, node.place};
  const auto fail = [&](Place place, std::string message, std::string help) {
    findings.error({&source, place}, std::move(message), std::move(help));
    setting.broken = true;
  };
  const auto add = [&](const YamlNode& item) {
    if (has_stray_variable(item.text))
      fail(item.place, fmt::format("'${{' inside other text: '{}'", item.text),
           "a variable stands for a whole value (\"${name}\"); a literal '${' is written '$${'");
    setting.value.items.push_back(item.text);
  };
  if (node.is_null()) {
    setting.unset = true;
  } else if (node.is_scalar()) {
    setting.value.quoted = node.quoted;
    add(node);
  } else if (node.is_mapping()) {
    fail(node.place, fmt::format("'{}' is a mapping; it must be one value or a list", name.text), {});
  } else {
    setting.value.is_list = true;
    for (const auto& item : node.items) {
      if (item.is_scalar())
        add(item);
      else
        fail(item.place, fmt::format("an item of '{}' is not a single value", name.text), {});
    }
    // Items of one list are text or not together: one in quotes makes all of them text.
    const auto quoted = [](const YamlNode& item) { return item.quoted && !variable_of(item.text); };
    setting.value.quoted = std::any_of(node.items.begin(), node.items.end(), quoted);
  }
  return setting;
}

}  // namespace atrium
