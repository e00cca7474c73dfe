#pragma once
#include <Eigen/Core>
#include <vector>

namespace atrium {

/// A convex polygon in a plane, counter-clockwise.
using Polygon2 = std::vector<Eigen::Vector2d>;

/// Signed area: positive if counter-clockwise (any simple polygon).
double area(const Polygon2& polygon);
/// Vector area of a planar polygon in space: its length is the area, its direction the normal of its winding.
Eigen::Vector3d vector_area(const std::vector<Eigen::Vector3d>& corners);

/// No reflex corner and a positive area; `tolerance` is how far, in metres, a corner may stand inside the chord of its
/// neighbours.
bool is_convex(const Polygon2& polygon, double tolerance);

/// Convex hull, counter-clockwise, without collinear corners (Andrew 1979). Fewer than 3 corners: all points on a line.
Polygon2 convex_hull(std::vector<Eigen::Vector2d> points);

/// A rectangle: corner positions are centre ± axis·half.x ± perpendicular(axis)·half.y.
struct Rectangle2 {
  Eigen::Vector2d low = Eigen::Vector2d::Zero();    ///< least coordinates along axis and its perpendicular
  Eigen::Vector2d high = Eigen::Vector2d::Zero();   ///< greatest
  Eigen::Vector2d axis = Eigen::Vector2d::UnitX();  ///< unit length
  Eigen::Vector2d perpendicular() const { return {-axis.y(), axis.x()}; }
  Polygon2 corners() const;  ///< counter-clockwise, from (low, low)
};

/// The rectangle of least area that holds the polygon (rotating calipers, Toussaint 1983: one side lies on an edge of
/// the hull). Among equals the one of the first edge. Needs a hull with at least 3 corners.
Rectangle2 minimum_area_rectangle(const Polygon2& hull);

/// A line in the plane; a point's side is the sign of normal · p + offset.
struct Line2 {
  Eigen::Vector2d normal = Eigen::Vector2d::UnitX();
  double offset = 0;
  double side(const Eigen::Vector2d& p) const { return normal.dot(p) + offset; }
};

/// The two parts of a convex polygon, in its winding; a part that the line leaves nothing of is empty. Corners within
/// `tolerance` of the line (in units of the line's normal) count as on it, so no sliver thinner than that is made.
struct CutPolygon {
  Polygon2 positive, negative;
};
CutPolygon cut(const Polygon2& polygon, const Line2& line, double tolerance);

}  // namespace atrium
