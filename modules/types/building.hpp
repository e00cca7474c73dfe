#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "graph/api/value.hpp"
#include "modules/types/mesh.hpp"
#include "modules/types/plane_primitives.hpp"
#include "modules/types/structure.hpp"

namespace atrium {

/// A plane polygon of a room's inner surface. Rings are indices into Building::vertices, so that neighbouring faces
/// share their corners; two faces that meet along an edge both have all vertices that lie on it.
struct BuildingFace {
  static constexpr auto members() {
    return std::tuple{&BuildingFace::surface, &BuildingFace::storey,     &BuildingFace::room,
                      &BuildingFace::plane,   &BuildingFace::primitive,  &BuildingFace::outline,
                      &BuildingFace::holes,   &BuildingFace::observed,   &BuildingFace::residual,
                      &BuildingFace::backing, &BuildingFace::corrections};
  }
  SurfaceClass surface = SurfaceClass::wall;
  std::int32_t storey = 0;
  std::int32_t room = -1;
  Plane plane;                         ///< normal into the room
  std::int32_t primitive = -1;         ///< index of the primitive whose plane it is; −1: inferred
  std::vector<std::uint32_t> outline;  ///< counter-clockwise seen from the room
  std::vector<std::vector<std::uint32_t>>
      holes;            ///< clockwise seen from the room: not openings, but columns and the like
  double observed = 0;  ///< share of its area (without openings) that points cover
  double residual = 0;  ///< RMS distance of those points to the plane, metres; 0: no points
  double backing = 0;   ///< of a wall's face, by hand: how thick the wall is where no other face is behind it, metres;
                        ///< 0: not known
  std::vector<std::string> corrections;  ///< what building.correct did to it
};

/// A door, a passage, a window, or a hole in a slab: a polygon in the plane of a face.
struct BuildingOpening {
  static constexpr auto members() {
    return std::tuple{&BuildingOpening::kind,      &BuildingOpening::room_a,    &BuildingOpening::room_b,
                      &BuildingOpening::face_a,    &BuildingOpening::face_b,    &BuildingOpening::thickness,
                      &BuildingOpening::outline_a, &BuildingOpening::outline_b, &BuildingOpening::corrections};
  }
  std::string kind;          ///< "door", "passage" (wider than a door, without a leaf), "window", "slab"
  std::int32_t room_a = -1;  ///< the rooms that it joins; room_b −1: outside, or not known
  std::int32_t room_b = -1;
  std::int32_t face_a = -1;  ///< the faces that it pierces; face_b −1: none
  std::int32_t face_b = -1;
  double thickness = 0;                    ///< of the wall or slab, metres; 0: only one of its faces is known
  std::vector<Eigen::Vector3d> outline_a;  ///< in face_a's plane, counter-clockwise seen from room_a
  std::vector<Eigen::Vector3d> outline_b;  ///< in face_b's plane, counter-clockwise seen from room_b; empty without
  std::vector<std::string> corrections;    ///< what building.correct did to it
};

struct BuildingRoom {
  static constexpr auto members() {
    return std::tuple{&BuildingRoom::name,       &BuildingRoom::storey, &BuildingRoom::faces,  &BuildingRoom::outline,
                      &BuildingRoom::area,       &BuildingRoom::height, &BuildingRoom::volume, &BuildingRoom::holes,
                      &BuildingRoom::confidence, &BuildingRoom::doubts};
  }
  std::string name;
  std::int32_t storey = 0;
  std::vector<std::int32_t> faces;                  ///< its closed surface
  std::vector<Eigen::Vector3d> outline;             ///< of its floor, counter-clockwise from above
  double area = 0;                                  ///< of its plan: outline without holes, square metres
  double height = 0;                                ///< volume / area: the mean height, metres
  double volume = 0;                                ///< cubic metres
  std::vector<std::vector<Eigen::Vector3d>> holes;  ///< of its floor (columns), clockwise from above
  double confidence = -1;                           ///< 0 to 1 (layout.confidence); -1: nobody has said
  std::vector<std::string> doubts;                  ///< why it is not 1, the gravest first
};

struct BuildingStorey {
  static constexpr auto members() { return std::tuple{&BuildingStorey::elevation, &BuildingStorey::height}; }
  double elevation = 0;  ///< of its floor, metres, relative to origin
  double height = 0;     ///< mean height of its rooms, floor to ceiling: their volume / their area, metres
};

/// Two faces of one wall, back to back.
struct BuildingWall {
  static constexpr auto members() {
    return std::tuple{&BuildingWall::face_a, &BuildingWall::face_b, &BuildingWall::thickness, &BuildingWall::area};
  }
  std::int32_t face_a = -1;
  std::int32_t face_b = -1;
  double thickness = 0;  ///< mean distance between the faces where they overlap, metres
  double area = 0;       ///< of that overlap, square metres
};

/// A building as closed rooms: per room a closed 2-manifold of plane polygons, seen from inside. Metres, z up; a place
/// is origin + coordinate.
struct Building {
  static constexpr std::string_view port_type = "Building";
  static constexpr auto members() {
    return std::tuple{&Building::origin, &Building::vertices,   &Building::storeys,
                      &Building::rooms,  &Building::faces,      &Building::openings,
                      &Building::walls,  &Building::confidence, &Building::doubts};
  }
  /// How many storeys, rooms, faces (inferred: by no primitive), openings of each kind, floor area, volume, confidence.
  static std::vector<Fact> facts(const Building& building);

  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> vertices;
  std::vector<BuildingStorey> storeys;  ///< lowest first
  std::vector<BuildingRoom> rooms;
  std::vector<BuildingFace> faces;
  std::vector<BuildingOpening> openings;
  std::vector<BuildingWall> walls;
  double confidence = -1;           ///< of all rooms, by area: 0 to 1 (layout.confidence); -1: nobody has said
  std::vector<std::string> doubts;  ///< what of the scan the rooms leave out, and the like
};

/// The building in the transform's target frame: the origin moves, local coordinates only turn. Where z is not up
/// there, elevations of storeys count along what was z.
Building transformed(const Building& building, const Transform& transform);

}  // namespace atrium
