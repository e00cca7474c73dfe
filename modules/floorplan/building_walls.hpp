#pragma once
#include <vector>

#include "modules/floorplan/wall_faces.hpp"
#include "modules/types/building.hpp"

namespace atrium::floorplan {

/// The walls of a building's storey cut at `height` over its floor, their primitives being indices of faces. Where a
/// face ends below that, it is cut where it is; what is only above is no wall, unless all of the face is. Steps within
/// a room (between its floors or ceilings), with the room on both sides, are no walls. `rooms` are the building's rooms
/// seen from above.
std::vector<WallFace> wall_faces(const Building& building, std::int32_t storey, double height,
                                 const std::vector<PlanPolygon>& rooms);

/// The doors, windows and slab openings of a storey, without those in steps within a room. `number` gives a building's
/// room its place among the storey's, or −1.
std::vector<PlanOpening> plan_openings(const Building& building, std::int32_t storey,
                                       const std::vector<PlanPolygon>& rooms, const std::vector<std::int32_t>& number);

/// Marks the walls of whose faces none was seen on more than a tenth of its area.
void mark_inferred(const Building& building, std::vector<PlanWall>& walls);

/// Marks the walls of which a face was corrected by hand.
void mark_corrected(const Building& building, std::vector<PlanWall>& walls);

/// Takes doors and windows out of the walls.
void interrupt(std::vector<PlanWall>& walls, const std::vector<PlanOpening>& openings);

}  // namespace atrium::floorplan
