#pragma once
#include <vector>

#include "modules/segment/plane_extent.hpp"

namespace atrium::segment {

/// The limits of segment.structure that concern horizontal planes; its parameters describe them.
struct StoreyLimits {
  double ceiling_share, floor_share, storey_share, min_storey_height, min_wall_height;
  bool share_alone = false;  ///< of several storeys: storey_share decides without equation 1
  bool by_mean = false;      ///< a ceiling's height is its mean, not its top
  double height_of(const PlaneExtent& ceiling) const { return by_mean ? ceiling.height : ceiling.top; }
};

/// One storey: its floors and ceilings, and the heights between which walls are its own.
struct Storey {
  std::vector<PlaneExtent> floors, ceilings;
  double low, high;  ///< metres; the lowest storey begins at −∞, the highest ends at +∞
};

/// Sorts horizontal planes (and slanted ceilings) into storeys, the lowest first, and decides which are floors and
/// ceilings (paper, "Segmentation", equation 1 and the rule for several storeys). At least one storey, which may have
/// no floor or no ceiling or neither.
std::vector<Storey> find_storeys(const std::vector<PlaneExtent>& horizontal, const std::vector<PlaneExtent>& walls,
                                 const StoreyLimits& limits);

}  // namespace atrium::segment
