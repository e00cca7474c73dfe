#pragma once
#include <vector>

#include "modules/floorplan/walls.hpp"

namespace atrium::floorplan {

struct Line {
  Eigen::Vector2d point = Eigen::Vector2d::Zero();
  Eigen::Vector2d along = Eigen::Vector2d::UnitX();  ///< unit length
};

inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }
/// Where two lines meet that are not parallel.
inline Eigen::Vector2d meet(const Line& a, const Line& b) {
  return a.point + a.along * (cross(b.point - a.point, b.along) / cross(a.along, b.along));
}

/// A wall that is being made: its line from `from` to `to`, its faces, and the lines on which it ends.
struct WallPiece {
  Line left;             ///< the face seen from the left; the only one of a single face
  Line right;            ///< the opposite face, seen or given
  double thickness = 0;  ///< 0: one face only is known
  double given = 0;      ///< where the thickness was given: how long its only face is, from left.point; else 0
  Eigen::Vector2d from = Eigen::Vector2d::Zero();  ///< on the middle line, or on the only face
  Eigen::Vector2d to = Eigen::Vector2d::Zero();
  Line start, end;  ///< where it is cut off
  std::vector<std::int32_t> primitives;

  bool two_faces() const { return thickness > 0; }
  double length() const { return (to - from).norm(); }
};

/// Steps 1 and 2 of walls_of.
std::vector<WallPiece> paired_faces(const std::vector<WallFace>& faces, const WallLimits& limits);
/// Step 3.
std::vector<WallPiece> joined_ends(const std::vector<WallPiece>& pieces, double corner_gap);

}  // namespace atrium::floorplan
