#include "modules/metric/rooms.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Geometry>

#include "graph/api/random.hpp"
#include "meshes.hpp"
#include "modules/synth/attic.hpp"
#include "modules/synth/flat.hpp"
#include "modules/synth/room.hpp"
#include "modules/synth/two_storeys.hpp"

namespace atrium::metric::rooms_test {
namespace {

using P = Eigen::Vector2d;

PlanRing rectangle(double x, double y, double width, double depth) {
  return {{x, y}, {x + width, y}, {x + width, y + depth}, {x, y + depth}};
}
FloorPlan plan(const std::vector<PlanRing>& rooms) {
  FloorPlan result;
  result.storeys.emplace_back();
  for (const auto& ring : rooms) result.storeys[0].rooms.push_back({"room", {ring, {}}, 0});
  return result;
}
Metrics compare(const FloorPlan& found, const FloorPlan& truth, const Rooms::Params& params = {}) {
  Context context;
  return Rooms::run({input(found), {}, OptionalInput<FloorPlan>(input(truth))}, params, context).metrics;
}
double of(const Metrics& m, const std::string& name) { return value(m, "rooms." + name); }
void expect_perfect(const Metrics& m) {
  for (const char* group : {"", "corners.", "angles."})
    for (const char* key : {"precision", "recall", "f1"}) EXPECT_EQ(of(m, std::string(group) + key), 1) << group << key;
}

const FloorPlan two = plan({rectangle(0, 0, 4, 5), rectangle(4.1, 0, 3, 5)});

TEST(MetricRooms, IdenticalIsPerfect) {
  const auto m = compare(two, two);
  expect_perfect(m);
  EXPECT_EQ(of(m, "area.true"), 35);
  EXPECT_NEAR(of(m, "iou"), 1, 1e-12);
  EXPECT_EQ(of(m, "corners.error"), 0);
  EXPECT_EQ(of(m, "corners.true"), 8);
  // A ring the other way round, begun elsewhere, with corners on its sides, is the same room.
  expect_perfect(compare(plan({{{0, 5}, {4, 5}, {4, 2}, {4, 0}, {2, 0}, {0, 0}}, rectangle(4.1, 0, 3, 5)}), two));
}

TEST(MetricRooms, PlansOfTurnedFramesAreComparedInOne) {
  // The same two rooms of one scan, drawn by two programs that turned and moved the scan each in its own way.
  const auto turned = [](double angle, const Eigen::Vector3d& shift) {
    FloorPlan result = two;
    result.origin = {3, -2, 1};
    result.to_plan.rotation = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    result.to_plan.translation = shift;
    result.storeys[0].elevation = shift.z() - result.origin.z();
    for (auto& room : result.storeys[0].rooms)
      for (auto& p : room.polygon.outline) {
        const Eigen::Vector3d place =
            result.to_plan.rotation * Eigen::Vector3d(p.x(), p.y(), 0) + shift - result.origin;
        p = place.head<2>();
      }
    return result;
  };
  const FloorPlan one = turned(0.7, {10, 20, 4}), other = turned(-1.9, {-5, 1, -8});
  for (const auto& [found, truth] : {std::pair{one, two}, {two, one}, {one, other}, {other, one}, {one, one}}) {
    const auto m = compare(found, truth);
    expect_perfect(m);
    EXPECT_NEAR(of(m, "iou"), 1, 1e-9);
    EXPECT_NEAR(of(m, "corners.error"), 0, 1e-9);
  }
  // Told nothing of the turn, they do not match.
  FloorPlan silent = one;
  silent.to_plan = {};
  EXPECT_EQ(of(compare(silent, two), "matched"), 0);
}

TEST(MetricRooms, OneRoomLacks) {
  const auto m = compare(plan({rectangle(0, 0, 4, 5)}), two);
  EXPECT_EQ(of(m, "precision"), 1);
  EXPECT_EQ(of(m, "recall"), 0.5);
  EXPECT_NEAR(of(m, "f1"), 2.0 / 3, 1e-12);
  EXPECT_EQ(of(m, "corners.recall"), 0.5);
  EXPECT_EQ(of(m, "corners.precision"), 1);
}

TEST(MetricRooms, RoomsRunTogetherAndTornApart) {
  // Both as one: the larger has 20 of 35.5 m², more than half.
  auto m = compare(plan({rectangle(0, 0, 7.1, 5)}), two);
  EXPECT_EQ(of(m, "matched"), 1);
  EXPECT_NEAR(of(m, "iou"), 20 / 35.5, 1e-12);
  EXPECT_EQ(of(m, "corners.matched"), 2);  // the western ones
  EXPECT_EQ(of(m, "corners.precision"), 0.5);
  EXPECT_EQ(of(m, "corners.recall"), 0.25);
  // One torn into halves: exactly one half does not match.
  m = compare(plan({rectangle(0, 0, 4, 2.5), rectangle(0, 2.5, 4, 2.5)}), plan({rectangle(0, 0, 4, 5)}));
  EXPECT_EQ(of(m, "matched"), 0);
  EXPECT_EQ(of(m, "f1"), 0);
  EXPECT_FALSE(has(m, "rooms.iou"));
  // Two copies of a room: one matches.
  m = compare(plan({rectangle(0, 0, 4, 5), rectangle(0, 0, 4, 5)}), plan({rectangle(0, 0, 4, 5)}));
  EXPECT_EQ(of(m, "precision"), 0.5);
  EXPECT_EQ(of(m, "recall"), 1);
}

TEST(MetricRooms, CornersWithinTenCentimetres) {
  // A wall moved by 8 cm: its corners match, 4 cm off on average; by 12 cm: two of four do not.
  auto m = compare(plan({rectangle(0, 0, 4.08, 5)}), plan({rectangle(0, 0, 4, 5)}));
  EXPECT_EQ(of(m, "corners.f1"), 1);
  EXPECT_NEAR(of(m, "corners.error"), 0.04, 1e-12);
  m = compare(plan({rectangle(0, 0, 4.12, 5)}), plan({rectangle(0, 0, 4, 5)}));
  EXPECT_EQ(of(m, "corners.f1"), 0.5);
  EXPECT_EQ(of(m, "f1"), 1);
  // A niche that was not seen: four corners of eight.
  const PlanRing niche{{0, 0}, {4, 0}, {4, 5}, {3, 5}, {3, 4.5}, {1, 4.5}, {1, 5}, {0, 5}};
  m = compare(plan({rectangle(0, 0, 4, 5)}), plan({niche}));
  EXPECT_EQ(of(m, "corners.precision"), 1);
  EXPECT_EQ(of(m, "corners.recall"), 0.5);
}

TEST(MetricRooms, AnglesWithinFiveDegrees) {
  // The corner at (4, 5) moved by 8 cm in x: it matches; its angle and the neighbour's change by atan(0.08 / 5) = 0.9°.
  const auto truth = plan({rectangle(0, 0, 4, 5)});
  auto m = compare(plan({{{0, 0}, {4, 0}, {4.08, 5}, {0, 5}}}), truth);
  EXPECT_EQ(of(m, "angles.f1"), 1);
  EXPECT_NEAR(of(m, "angles.error"), 2 * std::atan(0.08 / 5) * 180 / M_PI / 4, 1e-9);
  // On a side of 0.5 m the same 8 cm are 9.1°: both corners of that side lose their angle.
  m = compare(plan({{{0, 0}, {4, 0}, {4.08, 0.5}, {0, 0.5}}}), plan({rectangle(0, 0, 4, 0.5)}));
  EXPECT_EQ(of(m, "corners.f1"), 1);
  EXPECT_EQ(of(m, "angles.f1"), 0.5);
  // A reflex corner is not a right one: inner angles, not turns.
  const PlanRing l{{0, 0}, {4, 0}, {4, 5}, {2, 5}, {2, 3}, {0, 3}};
  expect_perfect(compare(plan({l}), plan({l})));
}

TEST(MetricRooms, StoreysAndOriginsAreTakenIntoAccount) {
  FloorPlan upper = plan({rectangle(0, 0, 4, 5)});
  upper.storeys[0].elevation = 2.8;
  EXPECT_EQ(of(compare(upper, plan({rectangle(0, 0, 4, 5)})), "matched"), 0);
  upper.origin = {0, 0, -2.8};
  EXPECT_EQ(of(compare(upper, plan({rectangle(0, 0, 4, 5)})), "matched"), 1);
  FloorPlan far = plan({rectangle(-1, -2, 4, 5)});
  far.origin = {500001, 5400002, 100};
  FloorPlan truth = plan({rectangle(0, 0, 4, 5)});
  truth.origin = {500000, 5400000, 100};
  expect_perfect(compare(far, truth));
}

FloorPlan plan_of(const GroundTruth& truth) {
  FloorPlan result;
  result.origin = truth.origin;
  for (const auto& room : truth.rooms) {
    PlanStorey storey;
    storey.elevation = room.outline.front().z();
    PlanRing ring;
    for (const auto& p : room.outline) ring.emplace_back(p.head<2>());
    storey.rooms.push_back({room.name, {ring, {}}, 0});
    result.storeys.push_back(storey);
  }
  return result;
}

TEST(MetricRooms, TruthOfScenesAgreesWithItselfInAnyFrame) {
  Context context;
  for (const auto& truth :
       {synth::Room::run({}, context).scene.truth, synth::Flat::run({}, context).scene.truth,
        synth::TwoStoreys::run({}, context).scene.truth, synth::Attic::run({}, context).scene.truth}) {
    // The truth stands tilted and far away; the plan knows the way from there to its own, upright frame.
    Transform away;
    away.rotation =
        (Eigen::AngleAxisd(0.05, Eigen::Vector3d::UnitX()) * Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitZ()))
            .toRotationMatrix();
    away.translation = {500000, 5400000, 300};
    FloorPlan own = plan_of(truth);
    own.to_plan = inverse(away);
    const auto m =
        Rooms::run({input(own), OptionalInput<GroundTruth>(input(transformed(truth, away))), {}}, {}, context).metrics;
    expect_perfect(m);
    EXPECT_NEAR(of(m, "iou"), 1, 1e-6);
    EXPECT_NEAR(of(m, "corners.error"), 0, 1e-6);
  }
}

TEST(MetricRooms, BadInput) {
  Context context;
  EXPECT_THROW(Rooms::run({input(two), {}, {}}, {}, context), Error);
  EXPECT_THROW(
      Rooms::run({input(two), OptionalInput<GroundTruth>(input(GroundTruth{})), OptionalInput<FloorPlan>(input(two))},
                 {}, context),
      Error);
  EXPECT_THROW(compare(two, {}), Error);
  EXPECT_THROW(compare(plan({{{0, 0}, {1, 0}, {std::nan(""), 1}}}), two), Error);
  EXPECT_THROW(compare(two, plan({{{0, 0}, {1, 0}, {std::nan(""), 1}}})), Error);
  GroundTruth endless;
  endless.rooms.push_back({"room", 0, {{0, 0, 0}, {1, 0, 0}, {1, std::nan(""), 0}}});
  EXPECT_THROW(Rooms::run({input(two), OptionalInput<GroundTruth>(input(endless)), {}}, {}, context), Error);
  EXPECT_THROW(Rooms::run({input(two), OptionalInput<GroundTruth>(input(GroundTruth{})), {}}, {}, context), Error);
  // A plan of nothing is a result.
  const auto m = compare({}, two);
  EXPECT_EQ(of(m, "recall"), 0);
  EXPECT_EQ(of(m, "f1"), 0);
  EXPECT_FALSE(has(m, "rooms.precision"));
  // A bow tie, a line and a ring of two corners are found rooms that match nothing.
  const auto broken = compare(
      plan({rectangle(0, 0, 4, 5), {{0, 0}, {4, 5}, {4, 0}, {0, 5}}, {{0, 0}, {1, 1}, {2, 2}}, {{0, 0}, {1, 1}}}), two);
  EXPECT_EQ(of(broken, "found"), 4);
  EXPECT_EQ(of(broken, "matched"), 1);
}

RC_GTEST_PROP(MetricRooms, RigidMotionsOfBothSidesChangeNothing, (std::uint32_t seed)) {
  Random random(seed);
  FloorPlan a = plan({}), b = plan({});
  for (int i = 0; i < 4; ++i) {
    const auto wobble = [&] { return random.uniform(-0.2, 0.2); };
    PlanRing ring = rectangle(i * 4.0, 0, random.uniform(2, 3.5), random.uniform(2, 5)), found = ring;
    for (auto& p : found) p += P(wobble(), wobble());
    a.storeys[0].rooms.push_back({"a", {found, {}}, 0});
    b.storeys[0].rooms.push_back({"b", {ring, {}}, 0});
  }
  const Eigen::Rotation2Dd turn(random.uniform(-3, 3));
  const P shift(random.uniform(-9, 9), random.uniform(-9, 9));
  FloorPlan moved_a = a, moved_b = b;
  for (auto* moved : {&moved_a, &moved_b})
    for (auto& room : moved->storeys[0].rooms)
      for (auto& p : room.polygon.outline) p = turn * p + shift;
  const auto before = compare(a, b), after = compare(moved_a, moved_b);
  RC_ASSERT(before.values.size() == after.values.size());
  for (std::size_t i = 0; i < before.values.size(); ++i)
    RC_ASSERT(std::abs(before.values[i].value - after.values[i].value) < 1e-6);
}

}  // namespace
}  // namespace atrium::metric::rooms_test
