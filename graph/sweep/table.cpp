#include "graph/sweep/table.hpp"

#include <algorithm>

namespace atrium {
namespace {

/// Characters, not bytes.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::vector<std::size_t> widths(const Table& table) {
  std::vector<std::size_t> result;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    std::size_t width = width_of(table.columns[c].title);
    for (const auto& row : table.rows) width = std::max(width, width_of(row[c]));
    result.push_back(width);
  }
  return result;
}

std::string padded(const std::string& text, std::size_t width, bool right) {
  const std::string space(width - std::min(width, width_of(text)), ' ');
  return right ? space + text : text + space;
}

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
  return result + "\"";
}

std::string markdown_cell(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '|' ? "\\|" : c == '\n' ? " " : std::string(1, c);
  return result;
}

template <class Cell>
std::string joined(const Table& table, std::string_view separator, Cell cell) {
  std::string result;
  for (std::size_t c = 0; c < table.columns.size(); ++c) result += (c == 0 ? "" : std::string(separator)) + cell(c);
  return result;
}

}  // namespace

std::string as_text(const Table& table) {
  const auto width = widths(table);
  const auto line = [&](const auto& cell) {
    std::string text =
        joined(table, "  ", [&](std::size_t c) { return padded(cell(c), width[c], table.columns[c].is_number()); });
    text.erase(text.find_last_not_of(' ') + 1);
    return text + "\n";
  };
  std::string result = line([&](std::size_t c) { return table.columns[c].title; });
  for (const auto& row : table.rows) result += line([&](std::size_t c) { return row[c]; });
  return result;
}

std::string as_csv(const Table& table) {
  std::string result = joined(table, ",", [&](std::size_t c) { return csv_cell(table.columns[c].title); }) + "\n";
  for (const auto& row : table.rows)
    result += joined(table, ",", [&](std::size_t c) { return csv_cell(row[c]); }) + "\n";
  return result;
}

std::string as_markdown(const Table& table) {
  const auto line = [&](auto cell) { return "| " + joined(table, " | ", cell) + " |\n"; };
  std::string result = line([&](std::size_t c) { return markdown_cell(table.columns[c].title); });
  result += line([&](std::size_t c) { return std::string(table.columns[c].is_number() ? "--:" : "---"); });
  for (const auto& row : table.rows) result += line([&](std::size_t c) { return markdown_cell(row[c]); });
  return result;
}

}  // namespace atrium
