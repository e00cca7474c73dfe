#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "graph/api/context.hpp"
#include "modules/types/plane_primitives.hpp"

namespace atrium::segment {

/// What segmentation knows of a primitive.
struct PlaneExtent {
  std::size_t primitive = 0;
  std::size_t points = 0;
  double angle = 0;  ///< between its normal's line and the vertical, degrees, 0 … 90
  bool faces_up = false;
  double height = 0;  ///< mean z of its points, metres
  double bottom = 0;  ///< least z
  double top = 0;     ///< greatest z
  /// Corners of the bounding rectangle in the plane; in a steep plane the first two are level and its foot.
  std::array<Eigen::Vector3d, 4> outline{};
  /// Of the bounding box along the plane, cubic metres; a box thinner than 5 cm counts as 5 cm thick.
  double volume = 0;
  /// The paper's "combination of number of points and volume of the bounding box": their product.
  double size() const { return static_cast<double>(points) * volume; }
  double extent() const { return top - bottom; }
  double length() const { return (outline[1] - outline[0]).norm(); }
};

/// One for each primitive, in their order; one without points has points = 0 and nothing else.
std::vector<PlaneExtent> measure(const PlanePrimitives& planes, const Context& context);

}  // namespace atrium::segment
