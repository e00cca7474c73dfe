#pragma once
#include <string>
#include <string_view>

namespace atrium::floorplan {

/// Width of a line of UTF-8 text in a font of the given size, at most: after DejaVu Sans, the widest of the fonts that
/// a drawing names.
double font_width(std::string_view text, double size, bool bold = false);

struct FittedText {
  std::string text;
  double size = 0;
};

/// The text no wider than `width`: in a smaller font, down to `least_size`; if it is too long even so, cut off, with
/// "…" at its end.
FittedText fitted(std::string_view text, double width, double size, double least_size, bool bold = false);

}  // namespace atrium::floorplan
