#include "modules/metric/openings.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "meshes.hpp"
#include "modules/synth/flat.hpp"
#include "modules/synth/office.hpp"
#include "modules/synth/two_storeys.hpp"

namespace atrium::metric::openings_test {
namespace {

using V = Eigen::Vector3d;

template <class Scene>
GroundTruth truth_of() {
  Context context;
  return Scene::run({}, context).scene.truth;
}

/// A building whose openings are the true ones.
Building building_of(const GroundTruth& truth) {
  Building building;
  building.origin = truth.origin;
  for (const auto& room : truth.rooms)
    building.rooms.push_back({room.name, room.storey, {}, room.outline, 0, 0, 0, {}});
  for (const auto& o : truth.openings) {
    BuildingOpening opening{o.kind, o.room_a, o.room_b, o.face_a, o.face_b, o.thickness, o.outline, {}};
    const V depth = -o.thickness * area_vector(o.outline).normalized();
    if (o.room_b >= 0)
      for (auto p = o.outline.rbegin(); p != o.outline.rend(); ++p) opening.outline_b.push_back(*p + depth);
    building.openings.push_back(opening);
  }
  return building;
}
Metrics compare(const Building& building, const GroundTruth& truth, const Transform& transform = {},
                const Openings::Params& params = {}) {
  Context context;
  return Openings::run(
             {OptionalInput<Building>(input(building)), input(truth), OptionalInput<Transform>(input(transform))},
             params, context)
      .metrics;
}
double of(const Metrics& m, const std::string& name) { return value(m, "openings." + name); }
void expect_perfect(const Metrics& m) {
  for (const char* key : {"precision", "recall", "f1", "joined", "any_kind.f1"}) EXPECT_EQ(of(m, key), 1) << key;
  EXPECT_NEAR(of(m, "iou"), 1, 1e-6);
}

/// Two rooms beside each other and a door of 1 m × 2 m in the wall between them, which is 0.1 m thick: y from 1 to 2.
GroundTruth two_rooms() {
  GroundTruth truth;
  truth.rooms = {{"west", 0, {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}},
                 {"east", 0, {{4.1, 0, 0}, {8, 0, 0}, {8, 4, 0}, {4.1, 4, 0}}}};
  truth.openings = {{"door", 0, 1, 0, 1, 0.1, {{4, 2, 0}, {4, 1, 0}, {4, 1, 2}, {4, 2, 2}}}};
  return truth;
}
template <class Change>
Metrics changed(Change change, const Openings::Params& params = {}) {
  Building building = building_of(two_rooms());
  change(building.openings[0]);
  return compare(building, two_rooms(), {}, params);
}
void move(BuildingOpening& opening, const V& by) {
  for (auto* outline : {&opening.outline_a, &opening.outline_b})
    for (auto& p : *outline) p += by;
}

TEST(MetricOpenings, TheTruthIsPerfect) {
  for (const auto& truth : {truth_of<synth::Flat>(), truth_of<synth::Office>(), truth_of<synth::TwoStoreys>()})
    expect_perfect(compare(building_of(truth), truth));
  const auto m = compare(building_of(truth_of<synth::Flat>()), truth_of<synth::Flat>());
  EXPECT_EQ(of(m, "door.true"), 4);
  EXPECT_EQ(of(m, "door.f1"), 1);
  EXPECT_EQ(of(m, "window.found"), 5);
  EXPECT_FALSE(has(m, "openings.slab.true"));
  EXPECT_EQ(of(compare(building_of(truth_of<synth::TwoStoreys>()), truth_of<synth::TwoStoreys>()), "slab.f1"), 1);
}

TEST(MetricOpenings, EitherSideOfAWallWillDo) {
  expect_perfect(changed([](BuildingOpening& o) {
    std::swap(o.outline_a, o.outline_b);
    std::swap(o.room_a, o.room_b);
  }));
  expect_perfect(changed([](BuildingOpening& o) { o.outline_b.clear(); }));
  expect_perfect(changed([](BuildingOpening& o) { o.outline_a.clear(); }));
}

TEST(MetricOpenings, OneFoundFromEachRoomIsOneTooMany) {
  Building building = building_of(two_rooms());
  building.openings.push_back(building.openings[0]);
  building.openings[0].outline_b.clear();
  building.openings[1].outline_a.clear();
  const auto m = compare(building, two_rooms());
  EXPECT_EQ(of(m, "recall"), 1);
  EXPECT_EQ(of(m, "precision"), 0.5);
}

TEST(MetricOpenings, MatchesAboveTheShareThatIsAsked) {
  // Moved by s of its width the share is (1 - s) / (1 + s): one half at a third.
  const auto along = [](double s) { return [s](BuildingOpening& o) { move(o, {0, s, 0}); }; };
  EXPECT_NEAR(of(changed(along(0.25)), "iou"), 0.75 / 1.25, 1e-9);
  EXPECT_EQ(of(changed(along(0.33)), "matched"), 1);
  EXPECT_EQ(of(changed(along(0.34)), "matched"), 0);
  Openings::Params strict;
  strict.min_iou = 0.8;
  EXPECT_EQ(of(changed(along(0.25), strict), "matched"), 0);
}

TEST(MetricOpenings, LiesInItsWall) {
  const auto across = [](double x) {
    return [x](BuildingOpening& o) {
      move(o, {x, 0, 0});
      o.outline_b.clear();
    };
  };
  for (const double x : {-0.19, 0.05, 0.29}) EXPECT_EQ(of(changed(across(x)), "matched"), 1) << x;
  for (const double x : {-0.21, 0.31}) EXPECT_EQ(of(changed(across(x)), "matched"), 0) << x;
  const auto turned = [](double degrees) {
    return [degrees](BuildingOpening& o) {
      o.outline_b.clear();
      const Eigen::AngleAxisd turn(degrees * M_PI / 180, V::UnitZ());
      for (auto& p : o.outline_a) p = V(4, 1.5, 0) + turn * (p - V(4, 1.5, 0));
    };
  };
  EXPECT_EQ(of(changed(turned(29)), "matched"), 1);
  EXPECT_NEAR(of(changed(turned(29)), "iou"), std::cos(29 * M_PI / 180), 1e-9);
  EXPECT_EQ(of(changed(turned(31)), "matched"), 0);
}

TEST(MetricOpenings, KindAndRoomsMatter) {
  const auto window = changed([](BuildingOpening& o) { o.kind = "window"; });
  EXPECT_EQ(of(window, "f1"), 0);
  EXPECT_EQ(of(window, "any_kind.f1"), 1);
  EXPECT_EQ(of(window, "window.precision"), 0);
  EXPECT_EQ(of(window, "door.recall"), 0);
  EXPECT_FALSE(has(window, "openings.door.precision"));
  const auto outside = changed([](BuildingOpening& o) { o.room_b = -1; });
  EXPECT_EQ(of(outside, "f1"), 1);
  EXPECT_EQ(of(outside, "joined"), 0);
}

TEST(MetricOpenings, ARoomThatIsNoneIsNotTheOutside) {
  GroundTruth truth = two_rooms();
  truth.rooms.pop_back();
  truth.openings[0].room_b = -1;
  Building building = building_of(two_rooms());  // with a second room, where the truth is outside
  EXPECT_EQ(of(compare(building, truth), "joined"), 0);
  building.openings[0].room_b = -1;
  EXPECT_EQ(of(compare(building, truth), "joined"), 1);
  // Of two rooms that share more than half of the true one, the better is that room.
  building = building_of(two_rooms());
  building.rooms.push_back(building.rooms[0]);
  for (auto& p : building.rooms.back().outline) p.y() *= 0.75;
  EXPECT_EQ(of(compare(building, two_rooms()), "joined"), 1);
  building.openings[0].room_a = 2;
  EXPECT_EQ(of(compare(building, two_rooms()), "joined"), 0);
}

TEST(MetricOpenings, TiltedAndGeoreferencedIsTheSame) {
  const GroundTruth upright = truth_of<synth::Office>();
  Transform away;
  away.rotation = (Eigen::AngleAxisd(0.05, V::UnitX()) * Eigen::AngleAxisd(0.4, V::UnitZ())).toRotationMatrix();
  away.translation = V(500000.123, 5400000.456, 312.789);
  // The building stands in the upright frame, about an origin of its own.
  Building building = building_of(upright);
  building.origin = V(10, 20, 30);
  for (auto& opening : building.openings) move(opening, V(-10, -20, -30));
  for (auto& room : building.rooms)
    for (auto& p : room.outline) p -= V(10, 20, 30);
  const GroundTruth seen = transformed(upright, away);
  expect_perfect(compare(building, seen, inverse(away)));
  EXPECT_EQ(of(compare(building, seen), "matched"), 0);
}

TEST(MetricOpenings, BadInput) {
  Context context;
  const auto m = Openings::run({{}, input(two_rooms()), {}}, {}, context).metrics;
  EXPECT_EQ(of(m, "recall"), 0);
  EXPECT_EQ(of(m, "f1"), 0);
  EXPECT_FALSE(has(m, "openings.precision"));
  EXPECT_THROW(changed([](BuildingOpening& o) { o.outline_a[1].y() = std::nan(""); }), Error);
  const auto broken = changed([](BuildingOpening& o) {
    std::swap(o.outline_a[0], o.outline_a[1]);  // a bow tie
    o.outline_b.resize(2);
  });
  EXPECT_EQ(of(broken, "found"), 1);
  EXPECT_EQ(of(broken, "matched"), 0);
  GroundTruth bow_tie = two_rooms();
  std::swap(bow_tie.openings[0].outline[0], bow_tie.openings[0].outline[1]);
  EXPECT_THROW(compare({}, bow_tie), Error);
  // Nothing to find and nothing found is no score.
  EXPECT_FALSE(has(compare({}, GroundTruth{}), "openings.f1"));
}

TEST(MetricOpenings, APassageIsADoor) {
  const Metrics m = changed([](BuildingOpening& opening) { opening.kind = "passage"; });
  expect_perfect(m);
  EXPECT_EQ(of(m, "door.f1"), 1);
}

}  // namespace
}  // namespace atrium::metric::openings_test
