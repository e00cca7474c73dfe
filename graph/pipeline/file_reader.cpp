#include "graph/pipeline/file_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "graph/api/suggest.hpp"

namespace atrium {

void FileReader::check_keys(const YamlNode& mapping, const std::vector<std::string>& allowed, const std::string& what) {
  for (const auto& entry : mapping.entries) {
    if (std::find(allowed.begin(), allowed.end(), entry.key) != allowed.end()) continue;
    const std::string hint = findings_.suggest(entry.key, allowed);
    error(entry.place, fmt::format("unknown key '{}' in {}", entry.key, what),
          hint.empty() ? fmt::format("keys of {}: {}", what, join_words(allowed, 20)) : hint);
  }
}

void FileReader::check_format(const YamlNode& root) {
  const auto* entry = root.find("atrium");
  if (entry == nullptr)
    error({}, "the format version is missing", "begin the file with `atrium: 1`");
  else if (!entry->value.is_scalar() || entry->value.text != "1")
    error(entry->value.place, fmt::format("unknown format version '{}'", entry->value.text),
          "this program reads `atrium: 1`");
}

Located FileReader::scalar(const YamlNode::Entry& entry) {
  if (entry.value.is_scalar()) return {entry.value.text, entry.value.place};
  error(entry.value.place, entry.value.is_null() ? fmt::format("'{}' has no value", entry.key)
                                                 : fmt::format("'{}' must be a single value", entry.key));
  return {};
}

std::optional<std::int64_t> FileReader::whole(const YamlNode::Entry& entry, std::int64_t low, std::int64_t high) {
  const std::string text = scalar(entry).text;
  std::int64_t value = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem == std::errc{} && end == text.data() + text.size() && value >= low && value <= high) return value;
  error(entry.value.place, fmt::format("'{}' is no whole number from {} to {}", text, low, high));
  return std::nullopt;
}

const std::vector<YamlNode::Entry>& FileReader::mapping(const YamlNode::Entry* entry, const std::string& help,
                                                        bool may_be_empty) {
  static const std::vector<YamlNode::Entry> nothing;
  if (entry == nullptr || (may_be_empty && entry->value.is_null())) return nothing;
  if (entry->value.is_mapping() && (may_be_empty || !entry->value.entries.empty())) return entry->value.entries;
  error(entry->value.place,
        fmt::format("'{}' must be a mapping{}", entry->key, may_be_empty ? "" : " that is not empty"), help);
  return nothing;
}

}  // namespace atrium
