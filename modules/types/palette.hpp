#pragma once
#include <cstddef>

#include "modules/types/cloud.hpp"
#include "modules/types/structure.hpp"

namespace atrium {

/// The colour of a surface class in files and pictures; told apart with any colour vision (after Okabe and Ito 2008).
constexpr Colour class_colour(SurfaceClass surface) {
  switch (surface) {
    case SurfaceClass::wall: return {86, 180, 233};
    case SurfaceClass::floor: return {230, 159, 0};
    case SurfaceClass::ceiling: return {0, 158, 115};
    default: return {170, 170, 170};
  }
}

/// A colour for the i-th primitive, room or variant: neighbours in i differ in hue and lightness; repeats after 24.
constexpr Colour index_colour(std::size_t i) {
  constexpr Colour base[8] = {{0, 114, 178},  {230, 159, 0}, {0, 158, 115},  {204, 121, 167},
                              {86, 180, 233}, {213, 94, 0},  {240, 228, 66}, {120, 94, 240}};
  constexpr int light[3] = {0, 35, -30};
  Colour colour = base[i % 8];
  for (auto& channel : colour) {
    const int level = channel + light[(i / 8) % 3] * (light[(i / 8) % 3] > 0 ? (255 - channel) : channel) / 60;
    channel = static_cast<std::uint8_t>(level);
  }
  return colour;
}

}  // namespace atrium
