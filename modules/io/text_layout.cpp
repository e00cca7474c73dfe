#include "modules/io/text_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "graph/api/error.hpp"
#include "graph/api/text.hpp"
#include "modules/io/column_names.hpp"

namespace atrium::io {
namespace {

using Fields = std::vector<std::string_view>;

const char* const columns_help =
    "name the columns in a first line, for example: x y z intensity r g b nx ny nz (others are skipped)";

/// The fields of a row, without a comment behind its numbers.
Fields row_fields(std::string_view line, const TextDialect& dialect) {
  constexpr std::size_t least = 3;
  Fields fields = fields_of(line, dialect);
  const auto comment = std::find_if(fields.begin() + static_cast<std::ptrdiff_t>(std::min(least, fields.size())),
                                    fields.end(), [](std::string_view f) { return f.starts_with('#'); });
  double value = 0;
  if (std::all_of(fields.begin(), comment, [&](std::string_view f) { return parse_field(f, dialect, value); }))
    fields.erase(comment, fields.end());
  return fields;
}

bool is_numeric(const Fields& fields, const TextDialect& dialect) {
  double v = 0;
  return std::all_of(fields.begin(), fields.end(), [&](std::string_view t) { return parse_field(t, dialect, v); });
}

/// The numbers of some rows, which all have so many columns.
class SampledRows {
 public:
  SampledRows(const std::string& path, const std::vector<Row>& rows, const TextDialect& dialect, std::size_t width)
      : width_(width), numbers_(rows.size() * width) {
    const std::vector<Role> all(width, Role::x);
    for (std::size_t i = 0; i < rows.size(); ++i)
      read_numbers(path, rows[i], dialect, all, numbers_.data() + i * width);
  }
  template <class F>
  bool all(std::size_t column, F&& holds) const {
    for (std::size_t i = column; i < numbers_.size(); i += width_)
      if (!holds(numbers_[i])) return false;
    return true;
  }
  /// Whether columns c, c+1, c+2 are unit vectors in all of the rows (zero vectors and NaN may be among them).
  bool are_unit_vectors(std::size_t c) const {
    std::size_t unit = 0;
    for (std::size_t i = c; i < numbers_.size(); i += width_) {
      const double* v = numbers_.data() + i;
      const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
      if (!(length > 0)) continue;
      if (std::abs(length - 1.0) > 0.02) return false;
      ++unit;
    }
    return unit > 0;
  }
  /// Whether the first column is n, n + 1, n + 2, …
  bool counts() const {
    constexpr std::size_t least = 3;
    for (std::size_t i = width_; i < numbers_.size(); i += width_)
      if (numbers_[i] != numbers_[i - width_] + 1) return false;
    return numbers_.size() >= least * width_ && numbers_[0] == std::floor(numbers_[0]);
  }

 private:
  std::size_t width_;
  std::vector<double> numbers_;
};

bool is_byte(double v) { return std::isnan(v) || (v >= 0 && v <= 255 && v == std::floor(v)); }
bool is_share(double v) { return std::isnan(v) || (v >= 0 && v <= 1); }
bool is_small_label(double v) { return v >= 0 && v <= 40 && v == std::floor(v); }

/// Roles of columns without names, from column `c` on, which are all that are left; empty if they cannot be told.
std::vector<Role> roles_by_count(const SampledRows& rows, std::size_t width, std::size_t c) {
  using enum Role;
  switch (width - c) {
    case 3: return {x, y, z};
    case 4: return {x, y, z, intensity};
    case 6:
      if (rows.are_unit_vectors(c + 3)) return {x, y, z, nx, ny, nz};
      return {x, y, z, red, green, blue};
    case 7: {
      const auto are_bytes = [&](std::size_t first) {
        return rows.all(first, is_byte) && rows.all(first + 1, is_byte) && rows.all(first + 2, is_byte);
      };
      const auto are_shares = [&](std::size_t first) {
        return rows.all(first, is_share) && rows.all(first + 1, is_share) && rows.all(first + 2, is_share);
      };
      const bool bytes = are_bytes(c + 3);
      const bool bright =
          !rows.all(c + 3, is_small_label) || !rows.all(c + 4, is_small_label) || !rows.all(c + 5, is_small_label);
      if (bytes && bright && rows.all(c + 6, is_small_label)) return {x, y, z, red, green, blue, label};
      if (are_bytes(c + 4) || are_shares(c + 4)) return {x, y, z, intensity, red, green, blue};
      if (bytes || are_shares(c + 3)) return {x, y, z, red, green, blue, intensity};
      return {};
    }
    case 9:
      if (rows.are_unit_vectors(c + 3)) return {x, y, z, nx, ny, nz, red, green, blue};
      if (rows.are_unit_vectors(c + 6)) return {x, y, z, red, green, blue, nx, ny, nz};
      return {};
    case 10:
      if (rows.are_unit_vectors(c + 7)) return {x, y, z, intensity, red, green, blue, nx, ny, nz};
      if (rows.are_unit_vectors(c + 6)) return {x, y, z, red, green, blue, nx, ny, nz, intensity};
      return {};
    default: return {};
  }
}

std::string text_of(const std::vector<Role>& roles) {
  static constexpr const char* names[role_count] = {"x", "y", "z",   "nx",        "ny",    "nz",    "r",
                                                    "g", "b", "rgb", "intensity", "label", "source"};
  std::string text;
  for (const Role role : roles) {
    if (!text.empty()) text += ' ';
    text += role == Role::none ? "-" : names[static_cast<std::size_t>(role)];
  }
  return text;
}

std::vector<Role> unnamed_roles(const std::string& path, const std::vector<Row>& rows, const TextDialect& dialect,
                                std::size_t width, bool pts, const Context& context) {
  using enum Role;
  if (pts && width == 7) return {x, y, z, intensity, red, green, blue};
  if (width == 6 && lower_case(path).ends_with(".xyzn")) return {x, y, z, nx, ny, nz};
  if (width == 6 && lower_case(path).ends_with(".xyzrgb")) return {x, y, z, red, green, blue};
  const SampledRows numbers(path, rows, dialect, width);
  std::vector<Role> roles;
  const bool counts = width > 3 && numbers.counts();
  if (counts) {
    roles = roles_by_count(numbers, width, 1);
    if (!roles.empty()) roles.insert(roles.begin(), Role::none);
  }
  if (roles.empty()) roles = roles_by_count(numbers, width, 0);
  if (roles.empty())
    throw Error(fmt::format("{}:{}: {} columns without names: which of them are x, y, z cannot be told", path,
                            rows.front().line, width),
                columns_help);
  const std::string taken = fmt::format("{}: columns without names, taken for {}", path, text_of(roles));
  if (roles.front() == Role::none)
    context.warn(taken + ": the first one counts the rows");
  else if (roles.back() == Role::label || (width == 7 && roles.back() == Role::intensity))
    context.warn(taken + ": a line of names in front would say so");
  else
    context.info(taken);
  return roles;
}

/// The first row from `at` on that is one field; lines.rows() if there is none.
std::size_t next_single(const Lines& lines, std::size_t at) {
  std::size_t found = lines.rows();
  for (std::size_t p = 0; p < lines.pieces().size() && found == lines.rows(); ++p)
    lines.rows_of(p, at, lines.rows(), [&](const Row& row) {
      if (found == lines.rows() && tokens_of(row.text).size() == 1) found = row.index;
    });
  return found;
}

/// The scans of a PTS file, each led by the number of its points; those without points are left out.
std::vector<RowScan> counted_scans(const std::string& path, const Lines& lines, const Context& context) {
  std::vector<RowScan> scans;
  for (std::size_t at = 0; at < lines.rows();) {
    const Row head = lines.row(at);
    const Fields tokens = tokens_of(head.text);
    if (tokens.size() != 1 && !scans.empty()) {  // more points than were promised
      RowScan& last = scans.back();
      at = next_single(lines, at);
      context.warn(fmt::format("{}:{}: {} declared, but {}: all are read", path, lines.row(last.first - 1).line,
                               counted(last.rows, "point is", "points are"),
                               counted(at - last.first, "line follows", "lines follow")));
      last.rows = at - last.first;
      continue;
    }
    const std::size_t left = lines.rows() - at - 1;
    double points = 0;
    const bool good = tokens.size() == 1 && parse_number(tokens[0], points) && points >= 0 &&
                      points <= static_cast<double>(left) && points == std::floor(points);
    if (!good && tokens.size() == 1 && parse_number(tokens[0], points) &&
        !(points >= 0 && points == std::floor(points)))
      throw Error(fmt::format("{}:{}: {} is no number of points", path, head.line, quote(tokens[0])),
                  "a PTS file begins with how many points follow");
    if (!good)
      throw Error(fmt::format("{}:{}: {} points are declared, but {}", path, head.line,
                              tokens.size() == 1 ? std::string(tokens[0]) : quote(head.text),
                              counted(left, "line follows", "lines follow")),
                  "the file is cut short");
    const auto rows = static_cast<std::size_t>(points);
    if (rows > 0) scans.push_back({at + 1, rows, Eigen::Affine3d::Identity(), false, false, 0});
    at += 1 + rows;
  }
  if (scans.empty()) throw Error(path + ": no points: the scans have 0 points");
  return scans;
}

/// Notes how many columns each scan has; the first one of those with the most.
const RowScan& widest_of(std::vector<RowScan>& scans, const Lines& lines) {
  for (auto& scan : scans) scan.columns = tokens_of(lines.row(scan.first).text).size();
  return *std::max_element(scans.begin(), scans.end(),
                           [](const RowScan& a, const RowScan& b) { return a.columns < b.columns; });
}

/// Scans of fewer columns have the first ones only: x y z, or these and an intensity.
void check_narrow_scans(const std::string& path, const std::vector<RowScan>& scans, const std::vector<Role>& roles,
                        const Lines& lines) {
  for (const auto& scan : scans)
    if (scan.columns != roles.size() && scan.columns != 3 && (scan.columns != 4 || roles[3] != Role::intensity))
      throw Error(
          fmt::format("{}:{}: {} values a point, where the file's other scans have {}: which columns are "
                      "missing cannot be told",
                      path, lines.row(scan.first).line, scan.columns, roles.size()));
}

/// The first rows, up to `most` from `first` on.
std::vector<Row> some_rows(const Lines& lines, std::size_t first, std::size_t most) {
  std::vector<Row> rows;
  const std::size_t end = std::min(lines.rows(), first + most);
  for (std::size_t p = 0; p < lines.pieces().size() && rows.size() < end - first; ++p)
    lines.rows_of(p, first, end, [&](const Row& row) { rows.push_back(row); });
  return rows;
}

/// The first row may hold names.
TextDialect dialect_of_rows(const std::vector<Row>& rows) {
  Fields sample;
  for (std::size_t i = rows.size() > 1 ? 1 : 0; i < rows.size(); ++i) sample.push_back(rows[i].text);
  return dialect_of(sample);
}

/// How many fields there are without the empty ones at the end, three at least.
std::size_t filled_width(const Fields& fields) {
  std::size_t width = fields.size();
  while (width > 3 && fields[width - 1].empty()) --width;
  return width;
}

/// A row has a value for each column; empty fields may follow.
void check_width(const std::string& path, const Row& row, const Fields& fields, const std::vector<Role>& roles) {
  const bool behind =
      fields.size() > roles.size() && std::all_of(fields.begin() + static_cast<std::ptrdiff_t>(roles.size()),
                                                  fields.end(), [](std::string_view f) { return f.empty(); });
  if (roles.size() != fields.size() && !behind)
    throw Error(fmt::format("{}:{}: {} columns are named, but the line has {}", path, row.line, roles.size(),
                            counted(fields.size(), "value")));
}

}  // namespace

TextLayout text_layout(const std::string& path, std::string_view text, const Lines& lines, const Context& context) {
  constexpr std::size_t looked_at = 100;
  TextLayout layout;
  if (lines.rows() == 0) throw Error(path + ": no points: every line is blank or a comment");
  std::size_t end = lines.rows();
  const Fields first = tokens_of(lines.row(0).text);
  double count = 0;
  const bool pts = first.size() == 1 && parse_number(first[0], count) && (lines.rows() > 1 || count == 0);
  if (pts) {  // how many points
    auto scans = counted_scans(path, lines, context);
    const RowScan& shown = widest_of(scans, lines);
    layout.first_row = shown.first;
    end = shown.first + shown.rows;
    if (scans.size() > 1 || end != lines.rows()) layout.scans = std::move(scans);
  }
  std::vector<Row> rows = some_rows(lines, layout.first_row, std::min(looked_at, end - layout.first_row));
  layout.dialect = dialect_of_rows(rows);
  if (layout.dialect.decimal_comma) context.info(path + ": numbers with a decimal comma");

  const std::size_t width_below = row_fields(rows.back().text, layout.dialect).size();
  std::string_view names = names_in_comments(text);
  const auto take_names = [&] {
    ColumnNames named = column_names(names, layout.dialect, width_below);
    layout.roles = std::move(named.roles);
    layout.metres_per_unit = named.metres_per_unit;
  };
  if (!is_numeric(row_fields(rows[0].text, layout.dialect), layout.dialect)) {
    names = rows[0].text;
    take_names();
    if (layout.roles.empty())
      throw Error(fmt::format("{}:{}: neither numbers nor column names with x, y and z: {}", path, rows[0].line,
                              quote(rows[0].text)),
                  columns_help);
    ++layout.first_row;
    rows.erase(rows.begin());
    if (rows.empty()) throw Error(path + ": no points after the line of column names");
  } else if (!names.empty()) {
    take_names();
  }
  const Fields fields = row_fields(rows.front().text, layout.dialect);
  if (layout.roles.empty()) {
    layout.roles = unnamed_roles(path, rows, layout.dialect, filled_width(fields), pts, context);
  }
  check_width(path, rows.front(), fields, layout.roles);
  if (!layout.scans.empty()) {
    check_narrow_scans(path, layout.scans, layout.roles, lines);
    warn_of_narrow_scans(path, layout.scans, layout.roles, context);
  }
  return layout;
}

void warn_of_narrow_scans(const std::string& path, const std::vector<RowScan>& scans, const std::vector<Role>& roles,
                          const Context& context) {
  const auto narrow =
      std::count_if(scans.begin(), scans.end(), [&](const RowScan& scan) { return scan.columns < roles.size(); });
  if (narrow > 0)
    context.warn(fmt::format("{}: {} of {} scans have fewer columns than {}: what they lack is 0", path, narrow,
                             scans.size(), text_of(roles)));
}

void read_numbers(const std::string& path, const Row& row, const TextDialect& dialect, const std::vector<Role>& roles,
                  double* to) {
  std::string_view rest = row.text, field;
  for (std::size_t c = 0; c < roles.size(); ++c) {
    if (!next_field(rest, dialect, field))
      throw Error(
          fmt::format("{}:{}: {} instead of {} (cut short?)", path, row.line, counted(c, "value"), roles.size()));
    if (roles[c] != Role::none && !parse_field(field, dialect, to[c]))
      throw Error(fmt::format("{}:{}: {}", path, row.line, no_number(field)));
  }
  while (next_field(rest, dialect, field) && !field.starts_with('#'))
    if (!field.empty())
      throw Error(fmt::format("{}:{}: more than {} values: {} follows", path, row.line, roles.size(), quote(field)));
}

}  // namespace atrium::io
