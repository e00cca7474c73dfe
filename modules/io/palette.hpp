#pragma once
#include "modules/types/cloud.hpp"
#include "modules/types/structure.hpp"

namespace atrium::io {

/// Colours of the surface classes in written files: from the palette of Okabe and Ito ("Color Universal Design", 2008),
/// which colour-blind readers can tell apart.
constexpr Colour colour_of(SurfaceClass surface) {
  switch (surface) {
    case SurfaceClass::wall: return {0, 114, 178};     // blue
    case SurfaceClass::floor: return {230, 159, 0};    // orange
    case SurfaceClass::ceiling: return {0, 158, 115};  // bluish green
    default: return {153, 153, 153};                   // grey
  }
}
inline constexpr SurfaceClass all_classes[] = {SurfaceClass::object, SurfaceClass::wall, SurfaceClass::floor,
                                               SurfaceClass::ceiling};

}  // namespace atrium::io
