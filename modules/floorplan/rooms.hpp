#pragma once
#include <optional>
#include <vector>

#include "modules/floorplan/regions.hpp"
#include "modules/floorplan/wall_faces.hpp"

namespace atrium::floorplan {

struct RoomLimits {
  double max_opening = 1.25;
  double min_width = 0.40;
  double min_area = 1.0;
};

/// Rooms of a storey: the connected parts of `ground` between the walls, largest first, without names and heights.
/// Parts of which less than a third is floor are none, where the storey has floors.
///
/// Besides the walls, what one face leaves open (a door) divides rooms if it is at most max_opening wide; so does any
/// passage below min_width. Parts below min_area, or nowhere min_width wide, are none.
std::vector<PlanRoom> rooms_of(const Region& ground, const PlanStorey& storey, const std::vector<WallFace>& faces,
                               const RoomLimits& limits);

/// Height of a room over `elevation`: the median by area of the ceilings above it; nothing if there is none.
std::optional<double> height_of(const PlanRoom& room, const std::vector<Surface>& ceilings, double elevation);

}  // namespace atrium::floorplan
