#pragma once
#include <vector>

#include "modules/layout/face_evidence.hpp"
#include "modules/layout/face_holes.hpp"

namespace atrium::layout {

/// How far from a wall's face points are looked at for leaves, metres.
inline constexpr double leaf_behind = 0.2, leaf_before = 0.12;

/// A leaf of a door's size, or a pane of a window's, that stands off its wall by a step.
struct ClosedLeaf {
  FaceHole hole;
  double step = 0;        ///< how far the leaf stands behind the wall around it, metres; below 0: in front of it
  double confidence = 1;  ///< 0 to 1: how clean step, rim and reveal are
};

/// Closed doors and windows in a face, from its evidence's `near` points: rectangles of 0.6 to 2 m by 1.85 to 2.4 m
/// that stand on the face's foot and lie 2 to 16 cm behind the wall around them, or 2 to 6 cm before it.
///
/// Each square of 5 cm (10 cm at most where points are sparse) has the median signed distance of its foremost points,
/// in 3 cm. Of all rectangles that have half of their squares and of those of a rim 20 cm wide on both sides and above
/// it, the one is taken whose squares differ most from the rim's in relation to how much both scatter; then the next
/// that does not touch it. Of its squares 85 % must lie within half the step of their median, of each side of the rim
/// 80 % of theirs (a casing, 1 to 6 cm before the wall, is left out), and the lowest 45 cm must belong to it: niches
/// and cupboards above the floor do not. One side may lack its rim, where the face ends at it. The wall may lean or
/// stand off its face's plane: only differences count. Windows, such as blinds, are 0.5 to 2.4 m wide and high, with a
/// sill 0.4 to 1.3 m over the foot and a head above 1.7 m, 3 to 16 cm behind the wall, with a rim on all four sides.
/// Faces that are no walls have none. Cost: linear in the points, and some thousand rectangles for each square of the
/// face's foot, of which a hundred are looked at closely for each 25 cm.
std::vector<ClosedLeaf> closed_leaves(const BuildingFace& face, const FaceEvidence& evidence);

}  // namespace atrium::layout
