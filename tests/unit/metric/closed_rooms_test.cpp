#include "modules/metric/closed_rooms.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>

#include "meshes.hpp"
#include "modules/synth/attic.hpp"
#include "modules/synth/flat.hpp"
#include "modules/synth/office.hpp"
#include "modules/synth/round_room.hpp"
#include "modules/synth/two_storeys.hpp"

namespace atrium::metric::closed_rooms_test {
namespace {

using V = Eigen::Vector3d;

Metrics compare(const Mesh& mesh, const GroundTruth& truth) {
  Context context;
  return ClosedRooms::run({input(mesh), input(truth)}, {}, context).metrics;
}
double of(const Metrics& m, const std::string& name) { return value(m, "closed_rooms." + name); }

template <class Scene>
GroundTruth empty_scene() {
  Context context;
  typename Scene::Params params;
  params.furniture = 0;
  return Scene::run(params, context).scene.truth;
}

/// A box seen from inside, as the truth of a room and as a mesh.
void add_box(Mesh& mesh, const V& low, const V& high) {
  const V d = high - low, x(d.x(), 0, 0), y(0, d.y(), 0), z(0, 0, d.z());
  const auto add = [&](const V& corner, const V& a, const V& b) {
    add_rectangle(mesh, corner, a, b, SurfaceClass::wall, static_cast<int>(mesh.triangles.size() / 2));
  };
  add(low, x, y);
  add(low, y, z);
  add(low, z, x);
  add(high, -y, -x);
  add(high, -z, -y);
  add(high, -x, -z);
}
GroundTruth truth_of(const Mesh& mesh, int rooms) {
  GroundTruth truth;
  truth.mesh = mesh;
  truth.rooms.resize(static_cast<std::size_t>(rooms));
  for (std::int32_t i = 0; i < 6 * rooms; ++i) {
    truth.faces.emplace_back();
    truth.faces.back().room = i / 6;
  }
  return truth;
}
Mesh two_boxes() {
  Mesh mesh;
  add_box(mesh, V(0, 0, 0), V(4, 5, 2.5));
  add_box(mesh, V(4.1, 0, 0), V(8, 5, 2.5));
  return mesh;
}

TEST(MetricClosedRooms, ClosedRoomsMatchThemselvesEitherWayRound) {
  const GroundTruth truth = truth_of(two_boxes(), 2);
  Mesh outwards = two_boxes();
  for (auto& t : outwards.triangles) std::swap(t[0], t[1]);
  for (const auto& mesh : {two_boxes(), outwards}) {
    const auto m = compare(mesh, truth);
    EXPECT_EQ(of(m, "true"), 2);
    EXPECT_EQ(of(m, "shells"), 2);
    EXPECT_EQ(of(m, "matched"), 2);
    EXPECT_EQ(of(m, "recall"), 1);
    EXPECT_NEAR(of(m, "iou"), 1, 1e-9);
  }
}

TEST(MetricClosedRooms, WhatIsOpenOrAroundAllRoomsIsNoRoom) {
  const GroundTruth truth = truth_of(two_boxes(), 2);
  Mesh open = two_boxes();
  open.triangles.pop_back();
  for (auto* column : {&open.storeys, &open.primitives}) column->pop_back();
  open.classes.pop_back();
  EXPECT_EQ(of(compare(open, truth), "matched"), 1);
  EXPECT_EQ(of(compare(open, truth), "shells"), 1);
  Mesh turned = two_boxes();
  std::swap(turned.triangles[0][0], turned.triangles[0][1]);
  EXPECT_EQ(of(compare(turned, truth), "matched"), 1);
  Mesh around;
  add_box(around, V(0, 0, 0), V(8.4, 5, 2.5));
  EXPECT_EQ(of(compare(around, truth), "shells"), 1);
  // 50 of its 105 m3 at most are in one room.
  EXPECT_EQ(of(compare(around, truth), "matched"), 0);
  EXPECT_FALSE(has(compare(around, truth), "closed_rooms.iou"));
  EXPECT_EQ(of(compare({}, truth), "recall"), 0);
}

TEST(MetricClosedRooms, WhatPassesThroughItselfIsNoRoom) {
  Mesh box;
  add_box(box, V(0, 0, 0), V(4, 5, 2.5));
  const GroundTruth truth = truth_of(box, 1);
  Mesh twisted = box;  // its ceiling turned by half a turn: as closed, manifold and oriented as before
  for (auto& v : twisted.vertices)
    if (v.z() > 1) v = V(4 - v.x(), 5 - v.y(), v.z());
  EXPECT_EQ(of(compare(box, truth), "shells"), 1);
  EXPECT_EQ(of(compare(twisted, truth), "shells"), 0);
  EXPECT_EQ(of(compare(twisted, truth), "left_out"), 0);
}

TEST(MetricClosedRooms, ShareIsThatOfTheVolumes) {
  Mesh box;
  add_box(box, V(0, 0, 0), V(4, 5, 2.5));
  const GroundTruth truth = truth_of(box, 1);
  for (const double width : {2.2, 3.0, 6.0}) {
    Mesh other;
    add_box(other, V(0, 0, 0), V(width, 5, 2.5));
    EXPECT_NEAR(of(compare(other, truth), "iou"), std::min(width, 4.0) / std::max(width, 4.0), 0.005) << width;
  }
  Mesh less;
  add_box(less, V(0, 0, 0), V(1.9, 5, 2.5));
  EXPECT_EQ(of(compare(less, truth), "matched"), 0);
}

TEST(MetricClosedRooms, TrueRoomsOfScenesAreClosedByTheirOpenings) {
  // Against itself the truth is open at every door and window; its rooms are known nevertheless.
  const auto check = [](const GroundTruth& truth) {
    const auto m = compare(truth.mesh, truth);
    EXPECT_EQ(of(m, "true"), static_cast<double>(truth.rooms.size()));
    EXPECT_EQ(of(m, "matched"), 0);
  };
  check(empty_scene<synth::Flat>());
  check(empty_scene<synth::Office>());
  check(empty_scene<synth::TwoStoreys>());
  check(empty_scene<synth::Attic>());
  check(empty_scene<synth::RoundRoom>());
  // The living room, 5.712 m × 4.64 m × 2.6 m, as a box.
  Mesh living;
  add_box(living, V(0, 0, 0), V(0.56 * 10.2, 0.58 * 8, 2.6));
  GroundTruth flat = empty_scene<synth::Flat>();
  EXPECT_EQ(of(compare(living, flat), "matched"), 1);
  EXPECT_NEAR(of(compare(living, flat), "iou"), 1, 1e-9);
  // The same in a tilted, georeferenced frame.
  Transform away;
  away.rotation = (Eigen::AngleAxisd(0.05, V::UnitX()) * Eigen::AngleAxisd(0.4, V::UnitZ())).toRotationMatrix();
  away.translation = V(500000.123, 5400000.456, 312.789);
  Mesh moved = transformed(living, away);
  const V shift(100, -50, 3);
  moved.origin += shift;
  for (auto& v : moved.vertices) v -= shift;
  EXPECT_NEAR(of(compare(moved, transformed(flat, away)), "iou"), 1, 1e-3);
}

TEST(MetricClosedRooms, BadInput) {
  EXPECT_THROW(compare(two_boxes(), {}), Error);
  GroundTruth open = truth_of(two_boxes(), 2);
  open.mesh.triangles.pop_back();
  EXPECT_EQ(of(compare(two_boxes(), open), "true"), 1);
  EXPECT_EQ(of(compare(two_boxes(), open), "left_out"), 1);
  Mesh bad = two_boxes();
  bad.vertices[3].z() = std::numeric_limits<double>::infinity();
  EXPECT_THROW(compare(bad, truth_of(two_boxes(), 2)), Error);
}

}  // namespace
}  // namespace atrium::metric::closed_rooms_test
