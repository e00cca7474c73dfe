#include "modules/io/text_fields.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

namespace atrium::io {
namespace {

bool is_field_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

std::string_view trimmed_field(std::string_view text) {
  while (!text.empty() && is_field_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_field_blank(text.back())) text.remove_suffix(1);
  return text;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// "-12,5": a number with one comma, between digits.
bool has_decimal_comma(std::string_view token) {
  const std::size_t comma = token.find(',');
  return comma != std::string_view::npos && comma > 0 && comma + 1 < token.size() && is_digit(token[comma - 1]) &&
         is_digit(token[comma + 1]) && token.find(',', comma + 1) == std::string_view::npos &&
         token.find('.') == std::string_view::npos;
}

/// Whether the fields are numbers, some of them with a decimal comma, and none without one that has a comma.
bool are_decimal_commas(const std::vector<std::string_view>& fields) {
  constexpr std::size_t least = 3;
  std::size_t with = 0;
  for (const auto field : fields) {
    double value = 0;
    if (has_decimal_comma(field))
      ++with;
    else if (!field.empty() && (!parse_number(field, value) || field.find('.') != std::string_view::npos))
      return false;
  }
  return with > 0 && fields.size() >= least;
}

}  // namespace

bool next_field(std::string_view& line, const TextDialect& dialect, std::string_view& field) {
  if (dialect.separator == ' ') {
    std::size_t begin = 0;
    while (begin < line.size() && is_field_blank(line[begin])) ++begin;
    if (begin == line.size()) return false;
    std::size_t end = begin;
    while (end < line.size() && !is_field_blank(line[end])) ++end;
    field = line.substr(begin, end - begin);
    line.remove_prefix(end);
  } else {
    if (line.data() == nullptr) return false;
    // Separators within quotes are part of the field.
    const std::size_t first = std::min(line.find_first_not_of(" \t"), line.size());
    const std::size_t quoted = line.substr(first).starts_with('"') ? line.find('"', first + 1) : std::string_view::npos;
    const std::size_t end =
        std::min(line.find(dialect.separator, quoted == std::string_view::npos ? 0 : quoted), line.size());
    field = trimmed_field(line.substr(0, end));
    if (end == line.size())
      line = {};
    else
      line.remove_prefix(end + 1);
  }
  if (field.size() >= 2 && field.front() == '"' && field.back() == '"') field = field.substr(1, field.size() - 2);
  return true;
}

std::vector<std::string_view> fields_of(std::string_view line, const TextDialect& dialect) {
  while (!line.empty() && (line.back() == '\r' || line.back() == '\n')) line.remove_suffix(1);
  std::vector<std::string_view> fields;
  std::string_view field;
  while (next_field(line, dialect, field)) fields.push_back(field);
  return fields;
}

TextDialect dialect_of(const std::vector<std::string_view>& given) {
  std::vector<std::string_view> lines = given;
  for (auto& line : lines)  // a tab at the end separates nothing
    while (!line.empty() && is_field_blank(line.back())) line.remove_suffix(1);
  const auto all_have = [&](char c) {
    return std::all_of(lines.begin(), lines.end(),
                       [&](std::string_view l) { return l.find(c) != std::string_view::npos; });
  };
  const auto decimal = [&](TextDialect dialect) {
    // The first line may hold names; a comma in any other one decides.
    return std::any_of(lines.begin(), lines.end(),
                       [&](std::string_view line) { return are_decimal_commas(fields_of(line, dialect)); }) &&
           std::none_of(lines.begin() + (lines.size() > 1 ? 1 : 0), lines.end(), [&](std::string_view line) {
             return line.find(',') != std::string_view::npos && !are_decimal_commas(fields_of(line, dialect));
           });
  };
  if (lines.empty()) return {};
  for (const char separator : {';', '\t', ' '}) {
    if (separator != ' ' && !all_have(separator)) continue;
    const TextDialect dialect{separator, true};
    if (decimal(dialect)) return dialect;
    if (separator == ';') return {separator, false};
  }
  if (all_have(',')) return {',', false};
  // Tabs are blanks, unless fields are empty or hold blanks themselves, as names do.
  if (all_have('\t') && std::any_of(lines.begin(), lines.end(), [](std::string_view l) {
        return l.find("\t\t") != std::string_view::npos ||
               fields_of(l, {'\t', false}).size() != fields_of(l, {}).size();
      }))
    return {'\t', false};
  return {};
}

bool parse_field(std::string_view field, const TextDialect& dialect, double& value) {
  if (field.empty()) {
    value = std::numeric_limits<double>::quiet_NaN();
    return true;
  }
  if (!dialect.decimal_comma) return parse_number(field, value);
  constexpr std::size_t longest = 64;
  if (field.size() > longest) return false;
  char copy[longest];
  std::memcpy(copy, field.data(), field.size());
  std::replace(copy, copy + field.size(), ',', '.');
  return parse_number({copy, field.size()}, value);
}

}  // namespace atrium::io
