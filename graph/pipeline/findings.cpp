#include "graph/pipeline/findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <tuple>

#include "graph/api/suggest.hpp"

namespace atrium {

std::string to_string(const Where& where) {
  if (where.file == nullptr) return {};
  if (where.place.line == 0) return where.file->name;
  return fmt::format("{}:{}:{}", where.file->name, where.place.line, where.place.column);
}

std::string to_string(const Diagnostic& diagnostic) {
  std::string text = diagnostic.file;
  if (diagnostic.line > 0) text += fmt::format(":{}:{}", diagnostic.line, diagnostic.column);
  text +=
      fmt::format("{}{}: {}", text.empty() ? "" : ": ", diagnostic.warning ? "warning" : "error", diagnostic.message);
  if (!diagnostic.help.empty()) text += "\n  help: " + diagnostic.help;
  for (const auto& note : diagnostic.notes) text += "\n  note: " + note;
  return text;
}

Findings::Item Findings::item(const Where& where, std::string message, std::string help,
                              std::vector<std::string> notes) {
  Item result{where.file == nullptr ? 0 : where.file->order, {}};
  if (where.file != nullptr) result.diagnostic.file = where.file->name;
  result.diagnostic.line = where.place.line;
  result.diagnostic.column = where.place.column;
  result.diagnostic.message = std::move(message);
  result.diagnostic.help = std::move(help);
  result.diagnostic.notes = std::move(notes);
  return result;
}

void Findings::error(const Where& where, std::string message, std::string help, std::vector<std::string> notes) {
  errors_.push_back(item(where, std::move(message), std::move(help), std::move(notes)));
}

void Findings::warning(const Where& where, std::string message, std::string help, std::vector<std::string> notes) {
  warnings_.push_back(item(where, std::move(message), std::move(help), std::move(notes)));
  warnings_.back().diagnostic.warning = true;
}

std::string Findings::suggest(std::string_view word, const std::vector<std::string>& candidates) {
  return suggestions_++ < most_suggestions ? did_you_mean(word, candidates) : std::string{};
}

std::vector<Diagnostic> Findings::sorted(std::vector<Item> items) {
  const auto key = [](const Item& i) {
    // What has no place comes after what has one.
    const int line = i.diagnostic.line == 0 ? std::numeric_limits<int>::max() : i.diagnostic.line;
    return std::tuple(i.order, line, i.diagnostic.column);
  };
  std::stable_sort(items.begin(), items.end(), [&](const Item& a, const Item& b) { return key(a) < key(b); });
  std::vector<Diagnostic> result;
  for (auto& i : items) {
    const auto same = [&](const Diagnostic& d) {
      return d.file == i.diagnostic.file && d.line == i.diagnostic.line && d.column == i.diagnostic.column &&
             d.message == i.diagnostic.message;
    };
    bool seen = false;
    for (auto it = result.rbegin(); it != result.rend() && it->line == i.diagnostic.line && !seen; ++it)
      seen = same(*it);
    if (!seen) result.push_back(std::move(i.diagnostic));
  }
  return result;
}

}  // namespace atrium
