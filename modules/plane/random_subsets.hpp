#pragma once
#include <cstdint>
#include <vector>

#include "graph/api/context.hpp"
#include "modules/geometry/moments.hpp"
#include "modules/plane/point_octree.hpp"

namespace atrium::plane {

/// A random subset of the points that no plane has taken yet, with an octree of its own.
struct RandomSubset {
  PointColumns columns;
  std::vector<std::uint32_t> place;  ///< of each point in the MortonOrder
  PointOctree octree;
  std::size_t live = 0;  ///< points not taken out since

  std::uint32_t count(const FloatPlane& plane, const Tolerance& tolerance) const;
  /// Second moments of the points that support the plane, in the columns' frame.
  Moments moments(const FloatPlane& plane, const Tolerance& tolerance) const;
};

/// The points that support a plane, per subset, ascending.
using Support = std::vector<std::vector<std::uint32_t>>;

/// Disjoint random subsets of all points that have no owner, each about eight times as large as those before it
/// together: a candidate is scored on the first ones and on more of them only as long as it competes (Schnabel et
/// al., 4.5).
class RandomSubsets {
 public:
  /// `owner` has one entry per point of the order, negative for points that are still free.
  RandomSubsets(const MortonOrder& order, const std::vector<std::int32_t>& owner, std::uint64_t seed,
                const Context& context);

  std::size_t size() const { return subsets_.size(); }
  const RandomSubset& operator[](std::size_t i) const { return subsets_[i]; }
  std::size_t live() const { return live_; }
  std::size_t built() const { return built_; }

  std::uint32_t count(std::size_t subset, const FloatPlane& plane, const Tolerance& tolerance,
                      const Context& context) const;
  /// Support in the first `subsets` subsets.
  Support support(const FloatPlane& plane, const Tolerance& tolerance, std::size_t subsets,
                  const Context& context) const;
  void take_out(const Support& support, const Context& context);

 private:
  std::vector<RandomSubset> subsets_;
  std::size_t live_ = 0;
  std::size_t built_ = 0;
};

}  // namespace atrium::plane
