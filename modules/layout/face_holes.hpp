#pragma once
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "modules/geometry/plane_frame.hpp"
#include "modules/layout/free_space.hpp"
#include "modules/layout/openings.hpp"

namespace atrium::layout {

/// A rectangle of a face that was seen through.
struct FaceHole {
  std::string kind;  ///< as in BuildingOpening
  PlaneFrame frame;
  Eigen::AlignedBox2d box;               ///< in the frame
  std::vector<Eigen::Vector3d> outline;  ///< counter-clockwise seen from the room
};

/// From where the faces of a room were seen.
struct RoomView {
  std::vector<Eigen::Vector3d> places;
  std::size_t enough = 1;  ///< how many of them must see a square
};

/// Finds the holes of one face after the other (see layout.openings).
class HoleFinder {
 public:
  HoleFinder(const Building& building, const Cloud& cloud, const Openings::Params& params, double pixel);

  std::vector<FaceHole> holes(std::size_t face) const;

 private:
  RoomView view_of(std::int32_t room) const;
  bool seen_through(const BuildingFace& face, const FaceHole& hole) const;

  const Building& building_;
  const Cloud& cloud_;
  const Openings::Params& params_;
  double pixel_;
  FreeSpace space_;
  std::vector<RoomView> views_;  // per room
};

}  // namespace atrium::layout
