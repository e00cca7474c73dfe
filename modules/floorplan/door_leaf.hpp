#pragma once
#include <vector>

#include "modules/types/floor_plan.hpp"

namespace atrium::floorplan {

/// The leaf of a door, as plans draw it: open at a right angle, with the quarter circle that it sweeps.
struct DoorLeaf {
  Eigen::Vector2d hinge, open, closed;  ///< the sweep goes from `closed` to `open` about `hinge`
  double radius() const { return (open - hinge).norm(); }
  /// Whether it goes counter-clockwise.
  bool left() const;
};

/// The leaves of an opening of the storey: one, two above 1.3 m, none above 2.6 m (a passage) and in windows and slabs.
///
/// A scan does not tell which way a door goes, so the symbol follows custom: into the room rather than outside, into
/// the smaller one of two, hinged at the end that is nearer to a corner of that room.
std::vector<DoorLeaf> door_leaves(const PlanOpening& opening, const PlanStorey& storey);

}  // namespace atrium::floorplan
