#pragma once
#include "modules/building/elements.hpp"
#include "modules/floorplan/regions.hpp"

/// The steps of elements_of.
namespace atrium::building {

using floorplan::Region;

/// Boxes around polygons, so that only near ones are cut with each other.
struct Box {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e300), high = Eigen::Vector2d::Constant(-1e300);
  explicit Box(const PlanRing& ring) {
    for (const auto& p : ring) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
  bool meets(const Box& other, double reach = 0) const {
    return (low.array() <= other.high.array() + reach).all() && (other.low.array() <= high.array() + reach).all();
  }
};

/// The space that a room takes: its plan, and over which part of it what heights are.
struct RoomSpace {
  struct Level {
    Region region;
    double low = 0, high = 0;
  };
  PlanPolygon polygon;
  double low = 0, high = 0;
  Box box{{}};
  std::vector<Level> floors, ceilings;
};
/// Where the room has more than `least` of its height between two heights: of a room with a stairwell, over the storey
/// above that is the stairwell only.
Region occupied(const RoomSpace& room, double low, double high, double least);
std::vector<RoomSpace> spaces_of(const Building& building);

/// Step 1 and 2 (columns, wall stretches) with step 3's profiles, for all storeys; sets `lines` too.
void add_columns(const Building& building, const ElementLimits& limits, Elements& elements);
void add_walls(const Building& building, const ElementLimits& limits, const std::vector<RoomSpace>& rooms,
               Elements& elements);
/// Which walls and columns stand behind each line.
void find_backing(Elements& elements);
/// The openings of walls and slabs.
void add_holes(const Building& building, Elements& elements);
/// Whether an opening pierces a floor, a ceiling or a roof rather than a wall.
inline bool in_slab(const Building& building, const BuildingOpening& opening) {
  const auto of_slab = [&](std::int32_t f) {
    return f >= 0 && building.faces[static_cast<std::size_t>(f)].surface != SurfaceClass::wall;
  };
  return opening.kind == "slab" || of_slab(opening.face_a) || of_slab(opening.face_b);
}
/// Step 4.
void add_slabs(const Building& building, const ElementLimits& limits, const std::vector<RoomSpace>& rooms,
               Elements& elements);

}  // namespace atrium::building
