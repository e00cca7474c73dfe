#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "modules/layout/raster.hpp"

namespace atrium::layout {

/// Tells the fronts of cupboards from walls: over a front that ends below the ceiling, the same ceiling goes on right
/// behind it. Behind a wall's face there is none for as far as the wall is thick.
class CeilingsBehind {
 public:
  /// `planes`: z up. Cost: sorting the points of level planes that look down.
  explicit CeilingsBehind(const PlanePrimitives& planes);

  /// For columns of an upright plane, `width` wide, the first one beginning at `from` along `along` (a unit vector in
  /// plan), which end at `tops` (z; less than any z: not seen): at which share of the places within half a metre a
  /// ceiling seen right before the plane goes on at the same height behind it, 4 to 50 cm over the column's end. The
  /// strips on both sides reach from three times the noise to 6.5 cm; with noise of 1.5 cm nothing can be told.
  std::vector<double> shares(const Plane& plane, const Eigen::Vector2d& along, double from, double width,
                             const std::vector<double>& tops) const;

 private:
  static constexpr double edge = 0.25;  // metres: of the squares that the points are sorted into
  struct Square {
    std::int64_t key;
    Eigen::Vector3f point;
  };
  static std::int64_t key_of(std::int64_t x, std::int64_t y) { return y * (std::int64_t{1} << 31) + x; }

  /// Calls work(point) for the points in squares that the strips beside the plane lie in, between two places along it.
  template <class Work>
  void each_near(const Plane& plane, const Eigen::Vector2d& along, const Eigen::Vector2d& ends, double height,
                 const Work& work) const;

  double noise_ = 0;
  std::vector<Square> points_;  // by key
};

/// Fills `open_top` of the walls among the footprints.
void find_open_tops(const PlanePrimitives& planes, std::vector<Footprint>& footprints, const Context& context);

}  // namespace atrium::layout
