// What the scenes of particular shapes and contents promise: the office floor, polygons, the round wall, wardrobes.
#include <gtest/gtest.h>

#include <numbers>
#include <set>

#include "modules/synth/flat.hpp"
#include "modules/synth/office.hpp"
#include "modules/synth/plan.hpp"
#include "modules/synth/polygon_room.hpp"
#include "modules/synth/room.hpp"
#include "modules/synth/round_room.hpp"
#include "scene_checks.hpp"

namespace atrium::synth::shapes_test {
namespace {

template <class Scene>
SimulatedScene build(const typename Scene::Params& params = {}, std::uint64_t seed = 1) {
  Context context(seed, std::make_shared<ContextHost>());
  return Scene::run(params, context).scene;
}
double floor_area(const GroundTruth& truth, std::size_t room) { return area_vector(truth.rooms[room].outline).norm(); }

TEST(SynthOffice, HasACorridorAndSevenRooms) {
  const auto truth = build<Office>().truth;
  ASSERT_EQ(truth.rooms.size(), 8U);
  EXPECT_EQ(truth.rooms[0].name, "corridor");
  EXPECT_NEAR(floor_area(truth, 0), 24 * 2, 1e-9);
  // The whole is 24 m × 13 m; walls between rooms take 0.12 m each: two beside the corridor, three and two across.
  const double inner = 13 - 2 - 2 * 0.12, south = 0.52 * inner, north = 0.48 * inner;
  double sum = 0;
  for (std::size_t room = 1; room < 8; ++room) sum += floor_area(truth, room);
  EXPECT_NEAR(sum, south * (24 - 3 * 0.12) + north * (24 - 2 * 0.12), 1e-9);
  EXPECT_NEAR(room_volume(truth, 0), 24 * 2 * (2.8 - 0.3), 1e-9);
  EXPECT_NEAR(room_volume(truth, 3), floor_area(truth, 3) * 2.8, 1e-9);
}

TEST(SynthOffice, EveryRoomHasADoorToTheCorridor) {
  const auto truth = build<Office>().truth;
  std::map<std::pair<int, int>, int> doors;
  int windows = 0, entrances = 0;
  for (const auto& o : truth.openings) {
    if (o.kind == "window") {
      ++windows;
      EXPECT_EQ(o.room_b, -1);
      EXPECT_NEAR(o.thickness, 0.3, 1e-12);
    } else if (o.room_b < 0) {
      ++entrances;
    } else {
      ++doors[std::minmax(o.room_a, o.room_b)];
      EXPECT_NEAR(o.thickness, 0.12, 1e-9);
      // It pierces both faces at the same place.
      const auto &a = truth.faces[o.face_a], &b = truth.faces[o.face_b];
      EXPECT_LT((a.plane.normal + b.plane.normal).norm(), 1e-12);
      for (const auto& p : o.outline) {
        EXPECT_NEAR(a.plane.signed_distance(p), 0, 1e-9);
        EXPECT_NEAR(b.plane.signed_distance(p - 0.12 * a.plane.normal), 0, 1e-9);
      }
    }
  }
  for (int room = 1; room < 8; ++room) EXPECT_EQ((doors[{0, room}]), 1) << room;
  EXPECT_EQ((doors[{1, 2}]), 1);
  EXPECT_EQ(doors.size(), 8U);
  EXPECT_EQ(entrances, 1);
  EXPECT_GE(windows, 12);
}

TEST(SynthOffice, AnySizeWithinItsBoundsCanBeBuilt) {
  for (const double width : {18.0, 80.0})
    for (const double depth : {9.0, 40.0})
      for (const double corridor : {1.2, 3.0})
        for (const double inner_wall : {0.02, 0.5}) {
          Office::Params params;
          params.width = width;
          params.depth = depth;
          params.corridor = corridor;
          params.inner_wall = inner_wall;
          params.ceiling_height = 2.6;
          params.corridor_drop = 0.4;
          params.furniture = 0.2;
          check_scene(build<Office>(params));
        }
}

TEST(SynthPolygonRoom, HasWallsAtItsAngles) {
  for (const int n : {3, 5, 6, 8}) {
    PolygonRoom::Params params;
    params.corners = n;
    const auto truth = build<PolygonRoom>(params).truth;
    ASSERT_EQ(truth.faces.size(), static_cast<std::size_t>(n) + 2);
    EXPECT_NEAR(floor_area(truth, 0), n / 2.0 * 3.2 * 3.2 * std::sin(2 * M_PI / n), 1e-9);
    for (std::size_t i = 3; i < truth.faces.size(); ++i)
      EXPECT_NEAR(truth.faces[i].plane.normal.dot(truth.faces[i - 1].plane.normal), std::cos(2 * M_PI / n), 1e-12);
    EXPECT_EQ(truth.openings.size(), 2U);
    params.door = params.window = false;
    EXPECT_TRUE(build<PolygonRoom>(params).truth.openings.empty());
  }
  PolygonRoom::Params narrow;
  narrow.corners = 24;  // walls of 0.84 m: too narrow for the door
  EXPECT_THROW(build<PolygonRoom>(narrow), Error);
}

TEST(SynthRoundRoom, LeavesItsCircleByTheSagittaAtMost) {
  for (const double sagitta : {0.05, 0.0005, 1e-5}) {
    RoundRoom::Params params;
    params.sagitta = sagitta;
    params.furniture = 0;
    const auto truth = build<RoundRoom>(params).truth;
    const Eigen::Vector3d centre(3.6, 2.3, 0);
    const auto& ring = truth.rooms[0].outline;
    double most = 0;
    for (std::size_t i = 1; i + 3 < ring.size(); ++i) {
      EXPECT_NEAR((ring[i] - centre).norm(), 2.3, 1e-12);
      most = std::max(most, 2.3 - ((ring[i] + ring[i + 1]) / 2 - centre).norm());
    }
    EXPECT_LE(most, sagitta);
    EXPECT_GT(most, 0.75 * sagitta);  // and no more strips than it takes: one fewer would be too coarse
    const double strips = static_cast<double>(ring.size() - 3), step = std::numbers::pi / (strips - 1);
    EXPECT_GT(2.3 * (1 - std::cos(step / 2)), sagitta);
    EXPECT_NEAR(floor_area(truth, 0), 3.6 * 4.6 + strips / 2 * 2.3 * 2.3 * std::sin(std::numbers::pi / strips), 1e-9);
  }
  EXPECT_EQ(build<RoundRoom>().truth.faces.size(), 81U);
}

/// The horizontal extent and the height of the object of this name.
Eigen::AlignedBox3d box_of(const SimulatedScene& scene, const std::string& name, std::size_t which = 0) {
  Eigen::AlignedBox3d box;
  std::size_t object = 0;
  for (std::size_t seen = 0; object < scene.objects.size(); ++object)
    if (scene.objects[object] == name && seen++ == which) break;
  for (std::size_t t = 0; t < scene.triangles.size(); ++t)
    if (scene.surfaces[t] == SimulatedScene::object_id(object))
      for (const auto v : scene.triangles[t]) box.extend(scene.vertices[v]);
  return box;
}

TEST(SynthWardrobe, StandsInItsCornerAndHidesNothingTrue) {
  Flat::Params flat;
  flat.built_in = 2;
  flat.furniture = 0;
  const auto scene = build<Flat>(flat);
  check_scene(scene);
  // The bedroom's north-eastern corner, up to its ceiling.
  const auto box = box_of(scene, "wardrobe");
  EXPECT_LT((box.max() - Eigen::Vector3d(10.2, 0.47 * 8, 2.5)).norm(), 1e-9);
  EXPECT_LT((box.min() - Eigen::Vector3d(8.2, 0.47 * 8 - 0.6, 0)).norm(), 1e-9);
  flat.built_in = 0;
  EXPECT_EQ(content_hash(build<Flat>(flat).truth), content_hash(scene.truth));

  Room::Params room;
  room.wardrobe = 2.4;
  room.furniture = 0;
  const auto l = box_of(build<Room>(room), "wardrobe");
  EXPECT_LT((l.max() - Eigen::Vector3d(3.6, 5, 2.2)).norm(), 1e-9);
  EXPECT_LT((l.min() - Eigen::Vector3d(1.2, 4.4, 0)).norm(), 1e-9);
}

TEST(SynthWardrobe, ThatDoesNotFitIsAnError) {
  Flat::Params flat;
  flat.built_in = 5;  // the wall is 4.4 m long
  EXPECT_THROW(build<Flat>(flat), Error);
  Room::Params room;
  room.depth = 3.2;
  room.notch_depth = 1;
  room.wardrobe = 3.5;  // before the door in the west wall
  EXPECT_THROW(build<Room>(room), Error);
}

TEST(SynthWardrobe, FurnitureKeepsOutOfIt) {
  Room::Params params;
  params.wardrobe = 2.4;
  params.furniture = 2;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const auto scene = build<Room>(params, seed);
    check_scene(scene);
    const auto wardrobe = box_of(scene, "wardrobe");
    for (const char* name : {"sofa", "table", "shelf"}) {
      const auto other = box_of(scene, name);
      EXPECT_FALSE(other.isEmpty()) << name;
      EXPECT_LT(wardrobe.intersection(other).sizes().minCoeff(), 0) << name;
    }
  }
}

TEST(SynthPlan, ScannersSeeTheWholeOutlineBetweenThem) {
  // An L with long arms: the place with most room sees one of them, so the second must see the other.
  const Ring2 l{{0, 0}, {9, 0}, {9, 2}, {3, 2}, {3, 9}, {0, 9}};
  for (const auto& furniture : {std::vector<Footprint>{}, {{{1.5, 5}, {1, 2}, 0, 1}}}) {
    const auto places = scanner_places(l, furniture, 2);
    ASSERT_EQ(places.size(), 2U);
    const auto in_both = [&](bool (*see)(const Eigen::Vector2d&)) { return see(places[0]) || see(places[1]); };
    EXPECT_TRUE(in_both([](const Eigen::Vector2d& p) { return p.x() < 3; }));  // the wall x = 3
    EXPECT_TRUE(in_both([](const Eigen::Vector2d& p) { return p.y() < 2; }));  // the wall y = 2
    for (const auto& p : places) EXPECT_GE(distance_to_border(l, p), 0.25);
  }
}

TEST(SynthPlan, ACrowdedRoomStillHasASecondPlace) {
  // Two lanes of 0.6 m beside a table: nowhere are 0.45 m free but in the first place's corner.
  const Ring2 room{{0, 0}, {3, 0}, {3, 3}, {0, 3}};
  const std::vector<Footprint> table{{{1.8, 1.5}, {0.6, 1.5}, 0, 0.7}};
  const auto places = scanner_places(room, table, 4);
  EXPECT_GE(places.size(), 2U);
  for (const auto& p : places) EXPECT_GE(table[0].distance(p), 0.25);
}

}  // namespace
}  // namespace atrium::synth::shapes_test
