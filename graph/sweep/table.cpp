#include "graph/sweep/table.hpp"

#include <algorithm>

#include "graph/api/text.hpp"

namespace atrium {
namespace {

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  return "\"" + replaced(text, "\"", "\"\"") + "\"";
}

std::string markdown_cell(const std::string& text) { return replaced(replaced(text, "|", "\\|"), "\n", " "); }

template <class Cell>
std::string joined(const Table& table, std::string_view separator, Cell cell) {
  std::string result;
  for (std::size_t c = 0; c < table.columns.size(); ++c) result += (c == 0 ? "" : std::string(separator)) + cell(c);
  return result;
}

}  // namespace

std::string as_text(const Table& table) {
  std::vector<std::vector<std::string>> rows(1);
  std::vector<bool> right;
  for (const auto& column : table.columns) {
    rows.front().push_back(column.title);
    right.push_back(column.is_number());
  }
  rows.insert(rows.end(), table.rows.begin(), table.rows.end());
  return aligned(rows, right);
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
