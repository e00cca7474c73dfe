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

/// One opening for each hole, or for two that lie over each other in opposite faces. Doors wider than max_door_width
/// (metres) are passages.
std::vector<BuildingOpening> joined(const Building& building, const Found& found, double max_door_width);

}  // namespace atrium::layout
