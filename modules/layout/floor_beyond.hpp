#pragma once
#include <Eigen/Core>

#include "modules/types/building.hpp"
#include "modules/types/plane_primitives.hpp"

namespace atrium::layout {

/// Floor that was seen beside the rooms, between walls, and that no room holds: rooms seen through a door only, and
/// parts of rooms that are missing.
struct FloorBeyond {
  double area = 0;                                  ///< of all pieces, square metres
  double largest = 0;                               ///< of these pieces, square metres
  Eigen::Vector3d where = Eigen::Vector3d::Zero();  ///< on the floor of the largest
};

/// Looks at squares of 40 cm outside of a storey's rooms, up to 4 m from one, in which a plane looks up that lies
/// within 10 cm of that room's floor. A room of another storey hides such a square only if it is there at that height.
/// A piece of them counts if it touches a room (but for a wall's thickness), has 0.8 m² or more that are further from
/// it, and if something higher than a parapet stands around it, 0.8 m long in all: most terraces, streets and gardens
/// have nothing of the kind so near. Building and planes have one origin, z up. Cost: linear in the points, for each
/// storey.
FloorBeyond floor_beyond_rooms(const Building& building, const PlanePrimitives& planes);

}  // namespace atrium::layout
