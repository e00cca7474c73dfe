#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "modules/io/lines.hpp"
#include "modules/io/raw_geometry.hpp"
#include "modules/io/row_source.hpp"
#include "modules/io/text_fields.hpp"

namespace atrium::io {

/// What the columns of a text file of points are.
struct TextLayout {
  TextDialect dialect;
  std::vector<Role> roles;                ///< per column
  std::size_t first_row = 0;              ///< the first row of numbers: after a PTS count and a header line
  std::vector<RowScan> scans;             ///< of PTS, if there are several: each with its count in front
  std::optional<double> metres_per_unit;  ///< if the names of the columns say it
};

/// Finds the layout: first what separates the columns, then what they are. A line of names in front (also as a comment:
/// "//X Y Z R G B") says it; names may be quoted and have a unit of length ("X [m]", which is the file's), and those
/// that are not known are skipped, as is a column without a name. Without names the number of columns says it: 3 x y z;
/// 4 x y z intensity; 6 x y z and r g b, or nx ny nz if they have unit length; 7 x y z intensity r g b, or x y z r g b
/// label if the last are small whole numbers, and 4 to 6 are bytes; 9 x y z r g b nx ny nz, or with the last two
/// triples the other way round; 10 x y z intensity r g b nx ny nz. A first column that counts the rows is passed over
/// where one more follows than x y z. What could have been something else is a warning. A single whole number in front
/// (PTS) is the number of points; other such scans may follow them, also with the first columns only; a number that is
/// too small is a warning. Throws Error, with file and line, for anything else.
TextLayout text_layout(const std::string& path, std::string_view text, const Lines& lines, const Context& context);

/// Says of how many scans columns are missing that other scans of the file have.
void warn_of_narrow_scans(const std::string& path, const std::vector<RowScan>& scans, const std::vector<Role>& roles,
                          const Context& context);

/// The numbers of a row, NaN for empty fields; of columns whose role is `none` nothing is read. Throws Error, with file
/// and line, unless there are exactly as many as roles (empty fields behind them do not count).
void read_numbers(const std::string& path, const Row& row, const TextDialect& dialect, const std::vector<Role>& roles,
                  double* to);

}  // namespace atrium::io
