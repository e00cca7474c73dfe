#pragma once
#include "modules/types/building.hpp"

namespace atrium {

/// By how much the two faces of a wall may be out of parallel, degrees.
constexpr double wall_parallel_angle = 3;

/// Throws an Error that names the first storey, room, face, opening or wall with a number that is not finite, a face of
/// fewer than three corners, or an index of what is not there. Rooms and faces of an opening, and a face's room, may be
/// −1: none.
void check(const Building& building);

/// The same places relative to another origin. z is up.
Building with_origin(Building building, const Eigen::Vector3d& origin);

}  // namespace atrium
