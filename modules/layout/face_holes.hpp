#pragma once
#include <Eigen/Geometry>
#include <array>
#include <string>
#include <vector>

#include "modules/layout/face_evidence.hpp"
#include "modules/layout/openings.hpp"

namespace atrium::layout {

/// A rectangle of a face that was seen through.
struct FaceHole {
  std::string kind;  ///< as in BuildingOpening
  PlaneFrame frame;
  Eigen::AlignedBox2d box;               ///< in the frame
  std::array<std::size_t, 4> support{};  ///< how many points say where each side is: left, right, bottom, top
  double foot = 0;                       ///< of the face, in the frame
  bool foot_hidden = false;              ///< it may go on down to the foot: what is below it was not seen
  bool leads_on = false;                 ///< points behind it are a leaf, or a place to go to
  bool doubtful = false;                 ///< too little of the face around it was seen
};

/// A rectangle of squares as a hole, its sides moved to where the face's points around it begin.
FaceHole fitted_hole(const Eigen::AlignedBox2i& squares, const FaceEvidence& evidence);

/// The rectangles that the evidence's hole squares fill, where something shows behind them. Uses the squares up.
std::vector<FaceHole> face_holes(const BuildingFace& face, FaceEvidence& evidence, const Openings::Params& params);

/// Its corners, counter-clockwise seen from the room.
std::vector<Eigen::Vector3d> outline_of(const FaceHole& hole);

}  // namespace atrium::layout
