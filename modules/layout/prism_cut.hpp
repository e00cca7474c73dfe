#pragma once
#include <vector>

#include "modules/layout/wall_cover.hpp"

namespace atrium::layout {

/// Weights of the terms, per square metre of surface.
struct PrismWeights {
  double ceiling = 2, floor = 0.5, outside = 0.3, wall = 1, smoothness = 0.5, complexity = 0.02;
};

/// Which prisms are inside: per cell and prism. One minimum cut over all prisms of the building.
///
/// - A prism that something was seen through, from a ceiling down to what lies below it, should be inside
///   (`ceiling` times the area seen through); one over a floor, seen through or with nothing seen above it, as well
///   (`floor`); as far as nothing was seen through it, it should be outside (`outside`). Prisms that are open above or
///   below are outside.
/// - Behind a surface that was seen it is outside (`wall` times what was seen), the less the more was seen through what
///   lies there. So it is behind walls, and before them it is inside.
/// - A border between inside and outside costs `smoothness` times its area that nothing shows, and `complexity` times
///   all of it.
std::vector<std::vector<bool>> inside_prisms(const PrismSpace& space, WallCover& walls, const PrismWeights& weights);

}  // namespace atrium::layout
