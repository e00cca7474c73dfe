#pragma once
#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <vector>

#include "graph/api/context.hpp"
#include "modules/types/plane_primitives.hpp"

namespace atrium::layout {

/// Which squares of a plane hold points. Outside of it all are empty.
struct Raster {
  Eigen::Vector2d low = Eigen::Vector2d::Zero();  ///< corner, a multiple of pixel
  double pixel = 0.05;
  int width = 0, height = 0;
  std::vector<std::uint8_t> bits;

  bool empty() const { return bits.empty(); }
  bool at(int x, int y) const {
    return x >= 0 && y >= 0 && x < width && y < height &&
           bits[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] != 0;
  }
  bool at(const Eigen::Vector2d& p) const { return at(column(p.x()), row(p.y())); }
  int column(double x) const { return static_cast<int>(std::floor((x - low.x()) / pixel)); }
  int row(double y) const { return static_cast<int>(std::floor((y - low.y()) / pixel)); }
  Eigen::Vector2d centre(int x, int y) const { return low + Eigen::Vector2d(x + 0.5, y + 0.5) * pixel; }
  Eigen::Vector2d high() const { return low + Eigen::Vector2d(width, height) * pixel; }
  double area() const;  ///< of the squares that hold points, square metres
  /// The same in squares `times` as wide.
  Raster coarse(int times) const;
  /// Whether it is as wide as `patch` (metres): squares of that width, of which the share `full` holds points, hold at
  /// least `least` of its points' squares. A shelf that runs around a corner is wide there only.
  bool is_wide(double patch, double full = 0.75, double least = 0.3) const;
};

/// The squares that points fall into.
Raster rasterize(const std::vector<Eigen::Vector2d>& points, double pixel);

/// An upright or horizontal primitive's points as a picture. A wall's first coordinate is along it (perpendicular to
/// its normal, to the left of one who looks along the normal), the second is z; other planes are seen from above (x,
/// y).
struct Footprint {
  bool upright = false;
  Eigen::Vector2d along = Eigen::Vector2d::UnitX();  ///< of walls
  Raster raster;
  double spacing = 0;  ///< edge of the squares that this surface fills, metres: the raster's, or up to four times it
  std::vector<double> tops;      ///< of walls, per column: the greatest z of its points; less than any z without points
  std::vector<double> open_top;  ///< of walls, per column: how far a ceiling goes on behind it (find_open_tops), 0 to 1
};
/// `from_above`: upright ones as well are seen from above (x, y).
Footprint footprint(const PlanePrimitive& primitive, const Cloud& cloud, double pixel, bool from_above = false);
std::vector<Footprint> footprints(const PlanePrimitives& planes, double pixel, const Context& context);

/// Whether a plane is a wall here: within 10° of the vertical.
inline bool is_upright(const Plane& plane) { return std::abs(plane.normal.z()) < 0.17364817766693; }
/// Within 10° of the horizontal.
inline bool is_level(const Plane& plane) { return std::abs(plane.normal.z()) > 0.98480775301221; }

/// The edge of squares that the scan fills: at least `least`, grown by steps of √2 until they are about
/// as full as they can be. Metres.
double fitting_pixel(const PlanePrimitives& planes, double least, const Context& context);

}  // namespace atrium::layout
