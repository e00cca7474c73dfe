#pragma once
#include <Eigen/Core>
#include <vector>

namespace atrium::render {

struct Viewpoint {
  Eigen::Vector3d eye, target;
};

/// A place at eye height (1.6 m above the lowest floor, or above the lowest points where no floor was seen) from which
/// much of the largest room is seen, and where to look. `surface`: points on what there is, z up, metres, a few
/// centimetres to decimetres apart. The place is over floor and away from what stands at eye height; among such places
/// and directions the one is taken whose field of view reaches over most floor.
Viewpoint inside_view(const std::vector<Eigen::Vector3f>& surface);

}  // namespace atrium::render
