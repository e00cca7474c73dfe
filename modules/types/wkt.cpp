#include "modules/types/wkt.hpp"

#include <cctype>

namespace atrium::wkt {
namespace {

bool opens(char c) { return c == '[' || c == '('; }
bool closes(char c) { return c == ']' || c == ')'; }

}  // namespace

std::string_view without_blanks(std::string_view text) {
  while (!text.empty() && (static_cast<unsigned char>(text.back()) <= ' ')) text.remove_suffix(1);
  while (!text.empty() && (static_cast<unsigned char>(text.front()) <= ' ')) text.remove_prefix(1);
  return text;
}

std::size_t find_node(std::string_view wkt, std::string_view name) {
  for (std::size_t at = wkt.find(name); at != std::string_view::npos; at = wkt.find(name, at + 1)) {
    const bool begins = at == 0 || (std::isalnum(static_cast<unsigned char>(wkt[at - 1])) == 0 && wkt[at - 1] != '_');
    if (begins && is_node(wkt.substr(at), name)) return at;
  }
  return std::string_view::npos;
}

std::string_view node_at(std::string_view wkt, std::size_t begin) {
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = begin; i < wkt.size(); ++i) {
    if (wkt[i] == '"') quoted = !quoted;
    if (quoted) continue;
    if (opens(wkt[i])) ++depth;
    if (closes(wkt[i]) && --depth == 0) return wkt.substr(begin, i + 1 - begin);
  }
  return wkt.substr(begin);
}

std::vector<std::string_view> parts_of(std::string_view node) {
  std::vector<std::string_view> parts;
  int depth = 0;
  bool quoted = false;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < node.size(); ++i) {
    if (node[i] == '"') quoted = !quoted;
    if (quoted) continue;
    const bool ends = depth == 1 && (node[i] == ',' || closes(node[i]));
    if (ends) parts.push_back(without_blanks(node.substr(begin, i - begin)));
    if (ends || (depth == 0 && opens(node[i]))) begin = i + 1;
    if (opens(node[i])) ++depth;
    if (closes(node[i]) && --depth <= 0) return parts;
  }
  if (depth > 0) parts.push_back(without_blanks(node.substr(begin)));
  return parts;
}

bool is_node(std::string_view part, std::string_view name) {
  if (!part.starts_with(name)) return false;
  part = without_blanks(part.substr(name.size()));
  return !part.empty() && opens(part.front());
}

std::string_view first_node(std::string_view wkt, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names)
    if (const std::size_t at = find_node(wkt, name); at != std::string_view::npos) return node_at(wkt, at);
  return {};
}

}  // namespace atrium::wkt
