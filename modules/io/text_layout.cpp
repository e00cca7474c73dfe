#include "modules/io/text_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "graph/api/error.hpp"

namespace atrium::io {
namespace {

const char* const columns_help =
    "name the columns in a first line, for example: x y z intensity r g b nx ny nz (others are skipped)";

std::vector<std::string_view> tokens_of(std::string_view line) {
  std::vector<std::string_view> all;
  for (auto t = next_token(line); !t.empty(); t = next_token(line)) all.push_back(t);
  return all;
}

std::string_view unquoted(std::string_view name) {
  if (name.size() >= 2 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
  return name;
}

/// The roles if the tokens name the columns, with x, y and z among them; else empty.
std::vector<Role> named_roles(const std::vector<std::string_view>& names) {
  std::vector<Role> roles;
  bool position[3] = {false, false, false};
  for (const auto name : names) {
    Role role = role_of(unquoted(name));
    if (role == Role::packed_colour || std::find(roles.begin(), roles.end(), role) != roles.end()) role = Role::none;
    roles.push_back(role);
    if (role <= Role::z) position[static_cast<std::size_t>(role)] = true;
  }
  return position[0] && position[1] && position[2] ? roles : std::vector<Role>{};
}

bool is_numeric(const std::vector<std::string_view>& tokens) {
  double v = 0;
  return std::all_of(tokens.begin(), tokens.end(), [&](std::string_view t) { return parse_number(t, v); });
}

/// The names in the last comment before the first row that gives any.
std::vector<Role> roles_in_comments(std::string_view text) {
  std::vector<Role> roles;
  while (!text.empty()) {
    const std::size_t length = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, length);
    text.remove_prefix(std::min(text.size(), length + 1));
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos) continue;
    line.remove_prefix(begin);
    if (!line.starts_with('#') && !line.starts_with("//")) break;
    line.remove_prefix(std::min(line.find_first_not_of("#/"), line.size()));
    if (auto found = named_roles(tokens_of(line)); !found.empty()) roles = std::move(found);
  }
  return roles;
}

/// The first rows, up to `most` from `first` on.
std::vector<Row> some_rows(const Lines& lines, std::size_t first, std::size_t most, const Context& context) {
  std::vector<Row> rows(std::min(most, lines.rows() - first));
  lines.for_rows(first, first + rows.size(), context,
                 [&](std::size_t, const Row& row) { rows[row.index - first] = row; });
  return rows;
}

/// Whether columns c, c+1, c+2 are unit vectors in all of the rows (zero vectors and NaN may be among them).
bool are_unit_vectors(const std::string& path, const std::vector<Row>& rows, std::size_t width, std::size_t c) {
  std::vector<double> v(width);
  std::size_t unit = 0;
  for (const Row& row : rows) {
    read_numbers(path, row, width, v.data());
    const double length = std::sqrt(v[c] * v[c] + v[c + 1] * v[c + 1] + v[c + 2] * v[c + 2]);
    if (!(length > 0)) continue;
    if (std::abs(length - 1.0) > 0.02) return false;
    ++unit;
  }
  return unit > 0;
}

std::vector<Role> roles_by_count(const std::string& path, const std::vector<Row>& rows, std::size_t width) {
  using enum Role;
  switch (width) {
    case 3: return {x, y, z};
    case 4: return {x, y, z, intensity};
    case 6:
      if (are_unit_vectors(path, rows, width, 3)) return {x, y, z, nx, ny, nz};
      return {x, y, z, red, green, blue};
    case 7: return {x, y, z, intensity, red, green, blue};
    case 9:
      if (are_unit_vectors(path, rows, width, 3)) return {x, y, z, nx, ny, nz, red, green, blue};
      return {x, y, z, red, green, blue, nx, ny, nz};
    case 10: return {x, y, z, intensity, red, green, blue, nx, ny, nz};
    default:
      throw Error(fmt::format("{}:{}: {} columns without names: which of them are x, y, z cannot be told", path,
                              rows.front().line, width),
                  columns_help);
  }
}

void check_decimal_commas(const std::string& path, const Row& row) {
  if (row.text.find(';') != std::string_view::npos && row.text.find(',') != std::string_view::npos)
    throw Error(fmt::format("{}:{}: both ';' and ',' in a line: decimal commas cannot be read", path, row.line),
                "write numbers with a decimal point");
}

}  // namespace

TextLayout text_layout(const std::string& path, std::string_view text, const Lines& lines, const Context& context) {
  TextLayout layout{roles_in_comments(text), 0};
  std::vector<Row> rows = some_rows(lines, 0, 2, context);
  if (rows.empty()) throw Error(path + ": no points: every line is blank or a comment");
  auto tokens = tokens_of(rows[0].text);
  if (tokens.size() == 1 && rows.size() > 1 && is_numeric(tokens)) {  // PTS: the number of points
    double points = 0;
    parse_number(tokens[0], points);
    if (points != static_cast<double>(lines.rows() - 1))
      throw Error(fmt::format("{}:{}: {} points are declared, but {} lines follow", path, rows[0].line, tokens[0],
                              lines.rows() - 1),
                  "the file is cut short, or holds several scans");
    layout.first_row = 1;
    tokens = tokens_of(rows[1].text);
  }
  if (!is_numeric(tokens)) {
    const Row& row = rows[layout.first_row];
    layout.roles = named_roles(tokens);
    if (layout.roles.empty())
      throw Error(
          fmt::format("{}:{}: neither numbers nor column names with x, y and z: {}", path, row.line, quote(row.text)),
          columns_help);
    if (++layout.first_row >= lines.rows()) throw Error(path + ": no points after the line of column names");
  }
  rows = some_rows(lines, layout.first_row, 100, context);
  check_decimal_commas(path, rows.front());
  const std::size_t width = tokens_of(rows.front().text).size();
  if (layout.roles.empty()) layout.roles = roles_by_count(path, rows, width);
  if (layout.roles.size() != width)
    throw Error(fmt::format("{}:{}: {} columns are named, but the line has {} values", path, rows.front().line,
                            layout.roles.size(), width));
  return layout;
}

void read_numbers(const std::string& path, const Row& row, std::size_t width, double* to) {
  std::string_view rest = row.text;
  for (std::size_t c = 0; c < width; ++c) {
    const std::string_view token = next_token(rest);
    if (token.empty())
      throw Error(fmt::format("{}:{}: {} values instead of {} (cut short?)", path, row.line, c, width));
    if (!parse_number(token, to[c]))
      throw Error(fmt::format("{}:{}: {} is not a number", path, row.line, quote(token)));
  }
  if (const std::string_view token = next_token(rest); !token.empty())
    throw Error(fmt::format("{}:{}: more than {} values: {} follows", path, row.line, width, quote(token)));
}

}  // namespace atrium::io
