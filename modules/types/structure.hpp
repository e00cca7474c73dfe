#pragma once
#include <cstdint>
#include <memory>
#include <string_view>
#include <tuple>
#include <vector>

#include "modules/types/plane_primitives.hpp"

namespace atrium {

/// What a surface is in the building. The numbers are those of the property `class` in written files.
enum class SurfaceClass : std::uint8_t { object = 0, wall = 1, floor = 2, ceiling = 3 };
constexpr std::string_view name_of(SurfaceClass c) {
  switch (c) {
    case SurfaceClass::wall: return "wall";
    case SurfaceClass::floor: return "floor";
    case SurfaceClass::ceiling: return "ceiling";
    default: return "object";
  }
}

/// The segmented primitives (paper, section "Segmentation"): aligned, z up.
struct Structure {
  static constexpr std::string_view port_type = "Structure";
  static constexpr auto members() {
    return std::tuple{&Structure::primitives, &Structure::classes, &Structure::storeys, &Structure::storey_count};
  }
  std::shared_ptr<const PlanePrimitives> primitives = std::make_shared<const PlanePrimitives>();
  std::vector<SurfaceClass> classes;  ///< per primitive; object: not part of the structure
  std::vector<std::int32_t> storeys;  ///< per primitive, 0 is the lowest; -1 for objects
  std::int32_t storey_count = 0;
};

}  // namespace atrium
