#pragma once
#include <Eigen/Core>
#include <vector>

#include "modules/geometry/plane_frame.hpp"
#include "modules/layout/face_mask.hpp"
#include "modules/layout/free_space.hpp"
#include "modules/layout/openings.hpp"

namespace atrium::layout {

/// What the points say about one face, in the face's own frame.
struct FaceEvidence {
  PlaneFrame frame;
  FaceMask open;                         ///< its solid squares are those that points behind the face show through
  FaceMask seen_from_both;               ///< its holes are those that are holes of the face behind it too
  FaceMask mask;                         ///< no squares: the face was not looked at
  std::vector<Eigen::Vector2d> on;       ///< points of the face
  std::vector<Eigen::Vector3d> behind;   ///< points up to a metre behind it; the third number is how far
  std::vector<Eigen::Vector3d> lower;    ///< the same below a wall's foot, up to 20 cm: floors outside lie lower
  std::vector<Eigen::Vector2d> through;  ///< where the ways from the room's scanner places to points behind it cross
                                         ///< it; where those are not known: the points within the wall
  std::vector<Eigen::Vector3f> near;  ///< of walls: points up to `leaf_behind` behind and `leaf_before` before it; the
                                      ///< third number is how far before
  double stray = 0;                   ///< how many of these there are per solid square, where none can be
  bool ways_known = false;            ///< whether it is known from where points were seen; otherwise none cross it
  double tolerance = 0;               ///< points this near lie on the face, metres
  double spacing = 0;                 ///< how far points stand for the surface around them, metres (FaceMask::cover)
  bool looked_at() const { return mask.width() > 0; }
};

/// How far behind a face points are looked at, metres.
double depth_behind(const Openings::Params& params);

/// From where the faces of a room were seen.
struct RoomView {
  std::vector<Eigen::Vector3d> places;
  std::vector<std::size_t> sensors;  ///< of the cloud; empty: the places are made up
};

/// Gathers the evidence of one face after the other (see layout.openings). Building and cloud have one origin. Safe to
/// use from several threads.
class EvidenceFinder {
 public:
  EvidenceFinder(const Building& building, const Cloud& cloud, const Openings::Params& params);

  /// Points and mask: which squares are solid, which hidden. Faces of no room are not looked at.
  FaceEvidence gather(std::size_t face) const;
  /// Turns hidden squares that were in sight, or through which points were seen, into holes.
  void look_through(std::size_t face, FaceEvidence& evidence) const;

 private:
  RoomView view_of(std::int32_t room) const;
  /// How far the face's own points scatter, metres: as the middle one does. The residual of its plane also holds what
  /// stands before the wall and within it, such as reveals and backs of cupboards.
  double noise_of(const BuildingFace& face) const;
  void collect_points(const BuildingFace& face, FaceEvidence& evidence) const;
  void find_ways(const BuildingFace& face, FaceEvidence& evidence) const;
  /// The least thickness of the walls that the face is a side of; max_thickness if it is none.
  double thickness_at(std::size_t index) const;
  void find_body(std::size_t face, FaceEvidence& evidence) const;

  const Building& building_;
  const Cloud& cloud_;
  const Openings::Params& params_;
  FreeSpace space_;
  std::vector<RoomView> views_;                      // per room
  std::vector<std::vector<std::uint32_t>> seen_by_;  // per sensor its points
};

}  // namespace atrium::layout
