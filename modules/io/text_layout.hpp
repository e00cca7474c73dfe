#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "modules/io/lines.hpp"
#include "modules/io/raw_geometry.hpp"

namespace atrium::io {

/// What the columns of a text file of points are.
struct TextLayout {
  std::vector<Role> roles;    ///< per column
  std::size_t first_row = 0;  ///< the first row of numbers: after a PTS count and a header line
};

/// Finds the layout. A line of names in front (also as a comment: "//X Y Z R G B") says it; without one the number of
/// columns does: 3 x y z; 4 x y z intensity; 6 x y z and r g b, or nx ny nz if they have unit length; 7 x y z intensity
/// r g b; 9 x y z r g b nx ny nz, or with the last two triples the other way round; 10 x y z intensity r g b nx ny nz.
/// A single whole number in front (PTS) is the number of points. Throws Error, with file and line, for anything else.
TextLayout text_layout(const std::string& path, std::string_view text, const Lines& lines, const Context& context);

/// The numbers of a row. Throws Error, with file and line, unless there are exactly `width`.
void read_numbers(const std::string& path, const Row& row, std::size_t width, double* to);

}  // namespace atrium::io
