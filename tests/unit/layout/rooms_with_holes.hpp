#pragma once
#include <Eigen/Geometry>

#include "modules/types/building.hpp"
#include "tests/support/rooms.hpp"
#include "tests/unit/layout/chain.hpp"

namespace atrium::layout::openings_test {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using namespace atrium::test;
using Scene = atrium::test::Rooms;

/// What of a rectangle from `corner` is missing: a box in coordinates along its edges.
inline auto without(const Vector3d& corner, const Vector3d& along, const AlignedBox2d& hole) {
  return [=](const Vector3d& p) {
    const Vector2d at(along.normalized().dot(p - corner), p.z() - corner.z());
    return !((at.array() > hole.min().array() + 1e-9).all() && (at.array() < hole.max().array() - 1e-9).all());
  };
}

/// A box room of 4 × 3 × 2.5 m whose wall at y = 0 lacks a rectangle, in x and z.
inline Scene room_with(const AlignedBox2d& hole, double spacing = 0.05) {
  Scene scene;
  scene.spacing = spacing;
  scene.floor(0, 0, 4, 3).ceiling(0, 0, 4, 3).wall(4, 0, 4, 3).wall(4, 3, 0, 3).wall(0, 3, 0, 0);
  scene.add({0, 0, 0}, {4, 0, 0}, {0, 0, 2.5}, {0, 1, 0}, without({0, 0, 0}, {1, 0, 0}, hole));
  return scene;
}

/// Points of a rectangle that belong to no primitive.
inline void scatter(Scene& scene, const Vector3d& corner, const Vector3d& a, const Vector3d& b,
                    double spacing = 0.025) {
  const int na = static_cast<int>(a.norm() / spacing), nb = static_cast<int>(b.norm() / spacing);
  for (int i = 0; i <= na; ++i)
    for (int j = 0; j <= nb; ++j) scene.stray(corner + a * (1.0 * i / na) + b * (1.0 * j / nb));
}

/// The sides of a hole in the wall at y = 0, 25 cm deep; a door's has no sill.
inline void add_reveal(Scene& scene, const AlignedBox2d& hole) {
  const Vector3d low(hole.min().x(), 0, hole.min().y()), across(hole.sizes().x(), 0, 0), up(0, 0, hole.sizes().y());
  const Vector3d depth(0, -0.25, 0);
  scatter(scene, low, up, depth);
  scatter(scene, low + across, up, depth);
  scatter(scene, low + up, across, depth);
  if (low.z() > 0) scatter(scene, low, across, depth);
}

inline AlignedBox2d place_of(const BuildingOpening& opening) {
  AlignedBox2d box;
  for (const auto& p : opening.outline_a) box.extend(Vector2d(p.x(), p.z()));
  return box;
}

}  // namespace atrium::layout::openings_test
