#pragma once
#include <cstdint>
#include <vector>

#include "graph/api/context.hpp"
#include "modules/plane/point_octree.hpp"

namespace atrium::plane {

/// How far apart the points are around a point of the cloud: the longest steps that it takes to reach all points of its
/// neighbourhood one after the other (edges of a minimum spanning tree, the very longest left out). Unlike a mean
/// distance it is right for scan lines, whose points are dense along and sparse across, and it follows the density,
/// which varies a hundredfold in one scan.
class LocalSpacing {
 public:
  LocalSpacing(const MortonOrder& order, const Context& context);
  /// Metres; `place` is the point's place in the order.
  float at(std::uint32_t place) const { return spacings_[place / stride_]; }
  /// The spacing below which this share of the cloud's neighbourhoods lies, metres; 0 for an empty cloud.
  double quantile(double share) const;
  /// The distance at which points of a surface are to be taken as connected, given some of its points: 3 cm, or what
  /// three quarters of its surroundings need if that is more.
  double reach(const std::vector<std::uint32_t>& places) const;

 private:
  std::size_t stride_ = 1;
  std::vector<float> spacings_;  ///< one for every `stride_` points
};

}  // namespace atrium::plane
