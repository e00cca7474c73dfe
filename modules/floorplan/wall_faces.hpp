#pragma once
#include <vector>

#include "modules/floorplan/surfaces.hpp"

namespace atrium::floorplan {

/// A piece of a line, in metres along it.
struct Span {
  double from = 0, to = 0;
  double length() const { return to - from; }
};

/// Disjoint spans in ascending order; those that overlap or are nearer than `gap` are one.
std::vector<Span> merged(std::vector<Span> spans, double gap);
/// What is left of the spans without `hole`.
std::vector<Span> without(const std::vector<Span>& spans, const Span& hole);
std::vector<Span> overlap(const std::vector<Span>& spans, const Span& window);

/// A wall's face cut by the plane of the section: a line seen from its left side.
struct WallFace {
  Eigen::Vector2d point = Eigen::Vector2d::Zero();
  Eigen::Vector2d normal = Eigen::Vector2d::UnitY();  ///< to the side from which it is seen
  std::vector<Span> spans;                            ///< along `along` from `point`, ascending
  std::int32_t primitive = -1;
  double backing = 0;  ///< how thick the wall is where no other face is behind this one; 0: not known

  Eigen::Vector2d along() const { return {normal.y(), -normal.x()}; }
  Eigen::Vector2d at(double s) const { return point + s * along(); }
  double coordinate(const Eigen::Vector2d& p) const { return along().dot(p - point); }
  double distance(const Eigen::Vector2d& p) const { return normal.dot(p - point); }
};

/// The walls of a storey cut at `height`. A wall that does not reach to there is cut at the nearest height that it has.
/// Surfaces that are no walls, or nearly horizontal, give none.
std::vector<WallFace> wall_faces(const std::vector<Surface>& surfaces, double height);

}  // namespace atrium::floorplan
