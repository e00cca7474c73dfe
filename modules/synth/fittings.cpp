#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "modules/synth/furniture.hpp"

namespace atrium::synth {
namespace {

using V = Eigen::Vector3d;
constexpr Colour curtain_cloth{188, 176, 158}, leaf_paint{214, 206, 190};

/// An opening in an upright wall, seen from its first room: u to the right
/// along the wall.
struct OpeningFrame {
  V along, normal,
      foot;     // foot: the middle of the opening on the wall, at the room's floor
  double half;  // half of its width
  double top;   // its upper edge
};
OpeningFrame frame_of(const Building& building, const TrueOpening& opening) {
  OpeningFrame f;
  f.normal = building.truth().faces[static_cast<std::size_t>(opening.face_a)].plane.normal;
  f.along = V::UnitZ().cross(f.normal).normalized();
  double left = std::numeric_limits<double>::infinity(), right = -left;
  f.top = -left;
  for (const auto& p : opening.outline) {
    left = std::min(left, f.along.dot(p));
    right = std::max(right, f.along.dot(p));
    f.top = std::max(f.top, p.z());
  }
  f.half = (right - left) / 2;
  const V& corner = opening.outline.front();
  f.foot = corner + f.along * ((left + right) / 2 - f.along.dot(corner));
  f.foot.z() = building.room(opening.room_a).floor_height;
  return f;
}

bool upright(const Building& building, const TrueOpening& opening) {
  return std::abs(building.truth().faces[static_cast<std::size_t>(opening.face_a)].plane.normal.z()) < 1e-9;
}

// Folds of 12 cm, 4 cm deep, 10 cm before the wall.
void add_curtain(Building& building, const OpeningFrame& f, double from, double to) {
  constexpr double fold = 0.06, depth = 0.04, before = 0.1;
  const auto id = SimulatedScene::object_id(static_cast<std::size_t>(building.add_object("curtain")));
  const auto at = [&](int i, double z) {
    const double u = std::min(from + fold * i, to);
    V p = f.foot + u * f.along + (before + (i % 2 == 0 ? 0 : depth)) * f.normal;
    p.z() = z;
    return p;
  };
  const double low = f.foot.z() + 0.05, high = f.top + 0.15;
  for (int i = 0; from + fold * i < to - 1e-9; ++i)
    building.add_polygon(id, {at(i, low), at(i + 1, low), at(i + 1, high), at(i, high)}, curtain_cloth);
}

}  // namespace

void add_curtains(Building& building) {
  const auto openings = building.truth().openings;
  for (const auto& opening : openings) {
    if (opening.kind != "window" || !upright(building, opening)) continue;
    const OpeningFrame f = frame_of(building, opening);
    add_curtain(building, f, -f.half - 0.2, -f.half / 3);
    add_curtain(building, f, f.half / 3, f.half + 0.2);
  }
}

void add_door_leaves(Building& building, Random& random) {
  constexpr double thick = 0.04, gap = 0.02;
  const auto openings = building.truth().openings;
  for (const auto& opening : openings) {
    if (opening.kind != "door" || opening.room_b < 0 || !upright(building, opening)) continue;
    const OpeningFrame f = frame_of(building, opening);
    const double open = random.uniform(70, 88) * std::numbers::pi / 180;
    const V hinge = f.foot - (f.half - gap) * f.along + gap * f.normal;
    // From closed (along the wall) the leaf turns towards the room.
    const V leaf = std::cos(open) * f.along + std::sin(open) * f.normal;
    building.add_box(building.add_object("door leaf"), hinge.head<2>(), std::atan2(leaf.y(), leaf.x()),
                     {0, 0, f.foot.z() + 0.01}, {2 * f.half - 2 * gap, thick, f.top - 0.02}, leaf_paint);
  }
}

}  // namespace atrium::synth
