#pragma once
#include <vector>

#include "modules/layout/face_holes.hpp"
#include "modules/layout/opening_pairs.hpp"

namespace atrium::layout {

/// Gaps of a window's size in walls, with a rim that was seen all around, nothing seen behind them and nothing that
/// stands before them: panes that no ray came back from, or pictures and shelves that left no points. They are no
/// openings, since nothing shows them, but a plan without them may lack windows. `masks`: of the evidence, before holes
/// were taken from it; `found`: the holes. Cost: one pass over the cloud.
std::vector<FaceHole> blank_gaps(const Building& building, const Cloud& cloud, const std::vector<FaceMask>& masks,
                                 const Evidence& evidence, const Found& found, const Openings::Params& params);

}  // namespace atrium::layout
