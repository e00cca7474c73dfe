#pragma once
#include "modules/layout/prism_stacks.hpp"

namespace atrium::layout {

/// Writes into the stacks of a space what was seen of their surfaces and through their prisms: at places at most a
/// pixel apart, from each ceiling down to what was seen below it, or to the floor that is hidden there. Places so near
/// to a wall that noise reaches them do not count. Cost: linear in the points of planes that are not upright.
void measure_stacks(const PlanePrimitives& planes, const std::vector<Footprint>& footprints, PrismSpace& space,
                    const Context& context);

}  // namespace atrium::layout
