#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "graph/api/context.hpp"
#include "modules/geometry/plane_frame.hpp"
#include "modules/types/building.hpp"
#include "modules/types/plane_primitives.hpp"

namespace atrium::layout {

/// A face in squares of about 25 cm: which of them lie on it, and which hold points of planes that lie on it. Coarser
/// than `observed`, so that furniture in front of a wall and sparse points count for less.
struct FaceGrid {
  enum Square : std::uint8_t { outside, unseen, seen };
  PlaneFrame frame;
  Eigen::AlignedBox2d box;  ///< in the frame; in an upright face the second coordinate is the height over its corner 0
  int width = 0, height = 0;
  std::vector<Square> squares;

  Square at(int x, int y) const {
    if (x < 0 || y < 0 || x >= width || y >= height) return outside;
    return squares[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
  Square at(const Eigen::Vector2d& p) const { return at(column(p.x()), row(p.y())); }
  void set(int x, int y, Square what) {
    squares[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] = what;
  }
  Eigen::Vector2d step() const { return box.sizes().cwiseQuotient(Eigen::Vector2d(width, height)); }
  Eigen::Vector2d centre(int x, int y) const {
    return box.min() + step().cwiseProduct(Eigen::Vector2d(x + 0.5, y + 0.5));
  }
  int column(double x) const { return static_cast<int>(std::floor((x - box.min().x()) / step().x())); }
  int row(double y) const { return static_cast<int>(std::floor((y - box.min().y()) / step().y())); }

  std::size_t count(Square what) const;
  double area(Square what) const { return static_cast<double>(count(what)) * step().prod(); }
  /// The height of a face that is not upright, over a place seen from above; nothing beside the face.
  std::optional<double> height_over(const Eigen::Vector2d& place) const;
};

/// The grids of all faces. Openings are no part of them. Building and planes have one origin. In the order of the faces
/// whatever the number of threads; the cost is that of the points of planes near each face.
std::vector<FaceGrid> face_grids(const Building& building, const PlanePrimitives& planes, const Context& context);

/// Whether a place lies in a polygon seen from above (even number of crossings: outside). Rings: outline and holes.
bool inside_rings(const std::vector<std::vector<Eigen::Vector2d>>& rings, const Eigen::Vector2d& p);

/// The distance from a place to the nearest edge of these rings, in their unit.
double distance_to_rings(const std::vector<std::vector<Eigen::Vector2d>>& rings, const Eigen::Vector2d& p);

}  // namespace atrium::layout
