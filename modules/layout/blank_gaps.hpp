#pragma once
#include <vector>

#include "modules/layout/face_holes.hpp"
#include "modules/layout/opening_pairs.hpp"

namespace atrium::layout {

/// A gap of a window's size in a wall, with a rim that was seen all around, nothing seen behind it and nothing that
/// stands before it: a pane that no ray came back from, or a picture or shelf that left no points.
struct BlankGap {
  std::size_t face = 0;
  FaceHole hole;
  bool window = false;  ///< in an outer wall, in sight, and as clean as panes are: it is taken for a window
};

/// Those gaps, by face. `masks`: of the evidence, before holes were taken from it; `found`: the holes. Cost: one pass
/// over the cloud.
std::vector<BlankGap> blank_gaps(const Building& building, const Cloud& cloud, const std::vector<FaceMask>& masks,
                                 const Evidence& evidence, const Found& found, const Openings::Params& params);

}  // namespace atrium::layout
