#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "modules/types/mesh.hpp"
#include "modules/types/structure.hpp"

namespace atrium {

/// One true surface of a simulated building: an outer ring and holes (openings), all in one plane. A door's hole meets
/// the floor, so it is a notch of the outline; a window's is a hole. Furniture that stands before a surface takes
/// nothing away.
struct TrueFace {
  static constexpr auto members() {
    return std::tuple{&TrueFace::surface, &TrueFace::storey,  &TrueFace::room,
                      &TrueFace::plane,   &TrueFace::outline, &TrueFace::holes};
  }
  SurfaceClass surface = SurfaceClass::wall;
  std::int32_t storey = 0;
  std::int32_t room = -1;                           ///< the room that sees it
  Plane plane;                                      ///< normal into the room
  std::vector<Eigen::Vector3d> outline;             ///< counter-clockwise seen from the room
  std::vector<std::vector<Eigen::Vector3d>> holes;  ///< clockwise seen from the room

  double area() const;  ///< without the holes, square metres
};

/// A door, window or slab opening. Its reveal (jambs, lintel, sill) belongs to no room and is no structural face.
struct TrueOpening {
  static constexpr auto members() {
    return std::tuple{&TrueOpening::kind,   &TrueOpening::room_a,    &TrueOpening::room_b, &TrueOpening::face_a,
                      &TrueOpening::face_b, &TrueOpening::thickness, &TrueOpening::outline};
  }
  std::string kind;          ///< "door", "window", "slab"
  std::int32_t room_a = -1;  ///< the rooms that it joins; -1: outside
  std::int32_t room_b = -1;
  std::int32_t face_a = -1;  ///< the faces that it pierces; -1: none
  std::int32_t face_b = -1;
  double thickness = 0;  ///< of the wall or slab that it pierces: from room_a's side along minus face_a's normal
  std::vector<Eigen::Vector3d> outline;  ///< on room_a's side, counter-clockwise seen from room_a
};

struct TrueRoom {
  static constexpr auto members() { return std::tuple{&TrueRoom::name, &TrueRoom::storey, &TrueRoom::outline}; }
  std::string name;
  std::int32_t storey = 0;
  std::vector<Eigen::Vector3d> outline;  ///< of its floor, counter-clockwise from above
};

/// Exact ground truth of a simulated scene, in the frame of its scan. A place is origin + coordinate, metres.
struct GroundTruth {
  static constexpr std::string_view port_type = "GroundTruth";
  static constexpr auto members() {
    return std::tuple{&GroundTruth::origin, &GroundTruth::faces, &GroundTruth::openings, &GroundTruth::rooms,
                      &GroundTruth::mesh};
  }
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  std::vector<TrueFace> faces;
  std::vector<TrueOpening> openings;
  std::vector<TrueRoom> rooms;
  Mesh mesh;  ///< the faces, triangulated with their holes left out; `primitives` is the index of the face
};

/// Area vector of a planar ring: its length is the ring's area, it points to the side that sees it counter-clockwise.
Eigen::Vector3d area_vector(const std::vector<Eigen::Vector3d>& ring);

/// The truth in the transform's target frame: the origin moves, local coordinates only turn.
GroundTruth transformed(const GroundTruth& truth, const Transform& transform);

}  // namespace atrium
