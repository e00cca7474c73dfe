#pragma once
#include <vector>

#include "modules/layout/face_evidence.hpp"
#include "modules/layout/face_holes.hpp"
#include "modules/types/building.hpp"

namespace atrium::layout {

using Evidence = std::vector<FaceEvidence>;        // per face
using Found = std::vector<std::vector<FaceHole>>;  // per face

/// The faces back to back with each face.
std::vector<std::vector<std::size_t>> opposite_faces(const Building& building);

/// What is hidden in a face and solid in the face behind it is no hole: it becomes solid.
void take_solid_from_behind(const Building& building, Evidence& evidence);

/// What is hidden in a face and a hole in the face behind it is a hole.
void take_holes_from_behind(const Building& building, Evidence& evidence);

struct JoinedOpenings {
  std::vector<BuildingOpening> openings;
  // Of holes down to the floor that lead out of the building and show neither a leaf nor a floor behind them:
  std::size_t blank_doors = 0;    ///< doors by their size
  std::size_t blank_windows = 0;  ///< windows by their size
  std::size_t low_blanks = 0;     ///< lower than min_door_height: left out
  std::size_t hidden_feet = 0;    ///< windows as wide as a door and up to its height, of which the wall below is hidden
  std::size_t only_doors = 0;     ///< of these the ones that are taken for doors, as no other leads into their room
};

/// One opening for each hole, or for two that lie over each other in opposite faces. Doors wider than max_door_width
/// are passages.
JoinedOpenings joined(const Building& building, const Found& found, const Openings::Params& params);

}  // namespace atrium::layout
