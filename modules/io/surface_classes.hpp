#pragma once
#include "modules/types/palette.hpp"
#include "modules/types/structure.hpp"

namespace atrium::io {

inline constexpr SurfaceClass all_classes[] = {SurfaceClass::object, SurfaceClass::wall, SurfaceClass::floor,
                                               SurfaceClass::ceiling};

}  // namespace atrium::io
