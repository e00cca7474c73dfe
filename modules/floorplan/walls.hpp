#pragma once
#include <vector>

#include "modules/floorplan/wall_faces.hpp"

namespace atrium::floorplan {

/// How faces become walls; the meaning of each stands with the parameters of floorplan.project. Metres, degrees.
struct WallLimits {
  double min_thickness = 0.03;
  double max_thickness = 0.60;
  double parallel_angle = 5;
  double corner_gap = 0.30;
  double merge_distance = 0.03;
  double min_length = 0.10;
};

/// Walls of a storey from its faces.
///
/// 1. Two faces that look away from each other (antiparallel normals, each behind the other) make a wall where they
///    overlap. The nearest pairs take their part of both faces first, so that a face may have several opposite ones
///    along its length, and each part of a face belongs to one wall.
/// 2. What is left of a face is a wall of which only that face is known: thickness 0, seen from the left of from → to.
///    Where the thickness behind it is given (WallFace::backing), it is a wall as if the other face had been seen.
/// 3. A wall whose end is at most corner_gap away from another's face is extended or cut to it: a wall of two faces to
///    the far face of the other, so that corners and T-junctions close; a single face to the near one.
/// 4. Single faces that lie in another wall, or run beside a face that is there within merge_distance, are left out, as
///    are those shorter than min_length; and so are walls of given thickness whose face does.
std::vector<PlanWall> walls_of(const std::vector<WallFace>& faces, const WallLimits& limits);

}  // namespace atrium::floorplan
