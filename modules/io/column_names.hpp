#pragma once
#include <optional>
#include <string_view>
#include <vector>

#include "modules/io/raw_geometry.hpp"
#include "modules/io/text_fields.hpp"

namespace atrium::io {

/// What a line of column names says.
struct ColumnNames {
  std::vector<Role> roles;                ///< per column, with x, y and z among them; empty: the line names no columns
  std::optional<double> metres_per_unit;  ///< if the coordinates' names give one unit of length: "X [ft]", "Easting(m)"
};

/// Reads a line of names by the dialect of the rows or by any separator; of these, the first that gives `width` columns
/// if one does. Names may be quoted; those that are not known have the role `none`. Units behind other columns' names
/// ("range [ft]") say nothing about the coordinates.
ColumnNames column_names(std::string_view line, const TextDialect& dialect, std::size_t width);

/// The last comment before the first row that names columns; empty if there is none.
std::string_view names_in_comments(std::string_view text);

/// What blanks, tabs, commas and semicolons separate in a line, up to a comment.
std::vector<std::string_view> tokens_of(std::string_view line);

}  // namespace atrium::io
