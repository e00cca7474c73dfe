#pragma once
#include <string>
#include <vector>

#include "modules/types/cloud.hpp"

namespace atrium::render {

/// Colours in a row: a ramp from low to high, or a handful of colours for classes.
struct ColourMap {
  std::vector<Colour> colours;

  /// Of a ramp, at 0 … 1 (clamped), between the two nearest colours.
  Colour at(double share) const;
  /// Of the i-th class: a short map is used over and over.
  Colour of_class(std::size_t i) const { return colours[i % colours.size()]; }
};

/// Reads share/colormaps/NAME.txt, in the source tree or where Atrium is installed. One colour per line: red, green and
/// blue, 0 to 255; lines that begin with # are comments. Throws Error: no such map (with those that there are), or
/// file, line and what is wrong with it.
ColourMap load_colour_map(const std::string& name);

}  // namespace atrium::render
