#pragma once
#include <array>

#include "modules/geometry/upright_evidence.hpp"
#include "modules/geometry/upright_view.hpp"

namespace atrium {

/// What stands and what hangs between floor and ceiling, as seen along an axis: fills furniture, doors, clutter, rough,
/// floor and bound of the evidence for the axis itself (first) and for its opposite. Cost: O(n log n) for n pieces.
void add_things(const UprightView& view, std::array<UprightEvidence, 2>& evidence);

}  // namespace atrium
