#pragma once
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <map>

#include "modules/types/simulated_scene.hpp"

namespace atrium::synth {

/// The outline of an opening as the given room sees it, counter-clockwise; empty if it is not the room's.
inline std::vector<Eigen::Vector3d> opening_seen_from(const GroundTruth& truth, const TrueOpening& opening, int room) {
  std::vector<Eigen::Vector3d> ring;
  if (opening.room_a == room) return opening.outline;
  if (opening.room_b != room) return ring;
  const Eigen::Vector3d depth = -opening.thickness * truth.faces[opening.face_a].plane.normal;
  for (auto p = opening.outline.rbegin(); p != opening.outline.rend(); ++p) ring.push_back(*p + depth);
  return ring;
}

/// Volume of a room by the divergence theorem over its faces and the openings that close it.
inline double room_volume(const GroundTruth& truth, int room) {
  double volume = 0;
  const auto add = [&](const std::vector<Eigen::Vector3d>& ring) {
    if (!ring.empty()) volume -= ring.front().dot(area_vector(ring)) / 3;  // normals point inwards
  };
  for (const auto& face : truth.faces) {
    if (face.room != room) continue;
    add(face.outline);
    for (const auto& hole : face.holes) add(hole);
  }
  for (const auto& opening : truth.openings) add(opening_seen_from(truth, opening, room));
  return volume;
}

/// What holds for every scene: planar, closed rooms, a mesh of the faces' area, sound columns, usable positions.
/// `lean`: sine of the angle by which walls may be off the vertical.
inline void check_scene(const SimulatedScene& scene, double lean = 0) {
  const auto& truth = scene.truth;
  ASSERT_FALSE(truth.faces.empty());
  for (const auto& face : truth.faces) {
    EXPECT_NEAR(face.plane.normal.norm(), 1, 1e-12);
    EXPECT_GT(area_vector(face.outline).dot(face.plane.normal), 0);
    for (const auto& p : face.outline) EXPECT_NEAR(face.plane.signed_distance(p), 0, 1e-9);
    for (const auto& hole : face.holes) {
      EXPECT_LT(area_vector(hole).dot(face.plane.normal), 0);
      for (const auto& p : hole) EXPECT_NEAR(face.plane.signed_distance(p), 0, 1e-9);
    }
    if (face.surface == SurfaceClass::wall) {
      EXPECT_NEAR(face.plane.normal.z(), 0, lean + 1e-12);
    }
    if (face.surface == SurfaceClass::floor) {
      EXPECT_GT(face.plane.normal.z(), 0.99);
    }
    if (face.surface == SurfaceClass::ceiling) {
      EXPECT_LT(face.plane.normal.z(), -0.05);
    }
  }
  // Each room's faces and openings close it: their area vectors cancel.
  for (int room = 0; room < std::ssize(truth.rooms); ++room) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto& face : truth.faces) {
      if (face.room != room) continue;
      sum += area_vector(face.outline);
      for (const auto& hole : face.holes) sum += area_vector(hole);
    }
    for (const auto& opening : truth.openings)
      if (const auto ring = opening_seen_from(truth, opening, room); !ring.empty()) sum += area_vector(ring);
    EXPECT_LT(sum.norm(), 1e-9) << "room " << truth.rooms[room].name;
  }
  // The mesh covers each face exactly: signed areas, each triangle turned the right way, sum to the face's.
  std::vector<double> areas(truth.faces.size(), 0);
  for (std::size_t i = 0; i < truth.mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = truth.mesh.triangles[i];
    const auto& face = truth.faces[truth.mesh.primitives[i]];
    const auto& v = truth.mesh.vertices;
    const double area = (v[b] - v[a]).cross(v[c] - v[a]).dot(face.plane.normal) / 2;
    EXPECT_GT(area, 0);
    EXPECT_EQ(truth.mesh.classes[i], face.surface);
    areas[truth.mesh.primitives[i]] += area;
  }
  for (std::size_t i = 0; i < areas.size(); ++i) EXPECT_NEAR(areas[i], truth.faces[i].area(), 1e-9);
  // Faces end where others begin: inside one face every edge has two triangles but those of its rings.
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : truth.mesh.triangles)
    for (int k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  for (const auto& [edge, count] : edges) EXPECT_EQ(count, 1);

  ASSERT_EQ(scene.surfaces.size(), scene.triangles.size());
  ASSERT_EQ(scene.colours.size(), scene.triangles.size());
  for (const auto surface : scene.surfaces) {
    EXPECT_NE(surface, -1);
    EXPECT_LT(surface, std::ssize(truth.faces));
    EXPECT_GT(surface, -2 - std::ssize(scene.objects));
  }
  std::vector<int> positions(truth.rooms.size(), 0);
  for (const auto& p : scene.positions)
    if (p.room >= 0) ++positions[p.room];
  for (const auto n : positions) EXPECT_GE(n, 1);
}

}  // namespace atrium::synth
