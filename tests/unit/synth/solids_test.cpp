// Scenes that are no boxes: levels, galleries, boxes, vaults, leaning walls,
// columns, sectors, an old flat, many rooms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <type_traits>

#include "modules/geometry/triangle_tree.hpp"
#include "modules/synth/barrel_vault.hpp"
#include "modules/synth/box_in_hall.hpp"
#include "modules/synth/flat.hpp"
#include "modules/synth/gallery_hall.hpp"
#include "modules/synth/leaning_walls.hpp"
#include "modules/synth/old_flat.hpp"
#include "modules/synth/open_plan.hpp"
#include "modules/synth/plan.hpp"
#include "modules/synth/raised_room.hpp"
#include "modules/synth/scan.hpp"
#include "modules/synth/sector_rooms.hpp"
#include "modules/synth/split_level.hpp"
#include "modules/synth/tall_building.hpp"
#include "scene_checks.hpp"

namespace atrium::synth::solids_test {
namespace {

constexpr double pi = std::numbers::pi;

template <class Scene>
SimulatedScene build(const typename Scene::Params& params = {}, std::uint64_t seed = 1) {
  Context context(seed, std::make_shared<ContextHost>());
  return Scene::run(params, context).scene;
}
template <class Scene>
std::vector<double> volumes(const typename Scene::Params& params = {}) {
  const auto truth = build<Scene>(params).truth;
  std::vector<double> result;
  for (int room = 0; room < std::ssize(truth.rooms); ++room) result.push_back(room_volume(truth, room));
  return result;
}
double floor_area(const GroundTruth& truth, int room) {
  double sum = 0;
  for (const auto& face : truth.faces)
    if (face.room == room && face.surface == SurfaceClass::floor) sum += face.area();
  return sum;
}
int openings_of(const GroundTruth& truth, const std::string& kind) {
  return static_cast<int>(
      std::count_if(truth.openings.begin(), truth.openings.end(), [&](const auto& o) { return o.kind == kind; }));
}
void expect_near(const std::vector<double>& found, const std::vector<double>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-9) << i;
}

template <class Scene>
class SolidScene : public testing::Test {};
using Scenes = testing::Types<SplitLevel, GalleryHall, RaisedRoom, BoxInHall, LeaningWalls, BarrelVault, OpenPlan,
                              SectorRooms, OldFlat, TallBuilding>;
TYPED_TEST_SUITE(SolidScene, Scenes);

TYPED_TEST(SolidScene, IsExactAndClosedWithAnyFurniture) {
  for (const double furniture : {0.0, 1.0}) {
    typename TypeParam::Params params;
    params.furniture = furniture;
    check_scene(build<TypeParam>(params, 2), std::is_same_v<TypeParam, LeaningWalls> ? std::sin(pi / 12) : 0);
  }
}

/// From each position everything around is seen from its front: it stands in a
/// room and in no object.
TYPED_TEST(SolidScene, ScannersStandInRooms) {
  const auto scene = build<TypeParam>();
  const TriangleTree tree(scene.vertices, scene.triangles);
  Random random(4);
  for (const auto& position : scene.positions) {
    int misses = 0, backs = 0;
    for (int i = 0; i < 300; ++i) {
      const auto hit =
          tree.cast(position.place, Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized());
      misses += hit ? 0 : 1;
      backs += hit && !hit.front ? 1 : 0;
    }
    EXPECT_LT(backs, 3) << position.place.transpose();
    EXPECT_LT(misses, 120) << position.place.transpose();
  }
}

TYPED_TEST(SolidScene, FollowsItsSeed) {
  EXPECT_EQ(content_hash(build<TypeParam>({}, 1)), content_hash(build<TypeParam>({}, 1)));
  EXPECT_NE(content_hash(build<TypeParam>({}, 1)), content_hash(build<TypeParam>({}, 2)));
}

/// How many rooms a walk comes into.
std::size_t rooms_walked(const Input<SimulatedScene>& scene) {
  Scan::Params params;
  params.points = 20000;
  params.pattern = Scan::Pattern::hand_held;
  params.sensors = true;
  params.positions = 1;
  Context context;
  const Cloud cloud = Scan::run({scene}, params, context).cloud;
  std::set<std::size_t> rooms;
  for (const auto& sensor : cloud.sensors)
    for (std::size_t room = 0; room < scene->truth.rooms.size(); ++room) {
      const auto& outline = scene->truth.rooms[room].outline;
      Ring2 ring;
      for (const auto& p : outline) ring.emplace_back(p.head<2>());
      const double above = sensor.z() - outline[0].z();
      if (inside(ring, sensor.head<2>().cast<double>()) && above > 1 && above < 2) rooms.insert(room);
    }
  return rooms.size();
}
TYPED_TEST(SolidScene, AWalkComesIntoEveryRoom) {
  const auto scene = input(build<TypeParam>());
  EXPECT_EQ(rooms_walked(scene), scene->truth.rooms.size());
}

TEST(SynthSplitLevel, VolumesAreThoseOfItsPrisms) {
  const double up = 2.8, h = 2.5;
  expect_near(volumes<SplitLevel>(), {2.4 * 4.6 * (up + h), 5 * 4.6 * h, (2.4 + 0.15 + 5) * 2.6 * h, 5 * 4.6 * h});
  const auto truth = build<SplitLevel>().truth;
  EXPECT_NEAR(truth.rooms[2].outline[0].z(), 1.4, 1e-12);
  EXPECT_NEAR(truth.rooms[3].outline[0].z(), 2.8, 1e-12);
}

TEST(SynthGalleryHall, TheHallIsOneVolumeLessItsGallery) {
  const auto found = volumes<GalleryHall>();
  expect_near(found, {7 * 6 * (2 * 2.6 + 0.3) - 2 * 6 * 0.3, 4 * 6 * 2.6, 4 * 6 * 2.6});
  // Two level floors: below all of the hall, and the gallery.
  EXPECT_NEAR(floor_area(build<GalleryHall>().truth, 0), 7 * 6 + 2 * 6, 1e-9);
}

TEST(SynthRaisedRoom, FloorsDifferAndCeilingsDoNot) {
  expect_near(volumes<RaisedRoom>(), {7 * 5 * 3.1, 4 * 3.6 * 2.6});
  // The door's threshold is the higher floor.
  const auto truth = build<RaisedRoom>().truth;
  for (const auto& o : truth.openings) {
    if (o.room_b < 0) continue;
    for (const auto& p : o.outline) EXPECT_GE(p.z(), 0.5 - 1e-12);
  }
}

TEST(SynthBoxInHall, TheHallIsItsPrismLessTheBox) {
  expect_near(volumes<BoxInHall>(), {10 * 8 * 5 - 3 * 3 * 2.4, 2.8 * 2.8 * 2.3, 4 * 0.7 * 8 * 2.6});
  EXPECT_NEAR(floor_area(build<BoxInHall>().truth, 0), 80,
              1e-9);  // the box's top is floor, what it stands on is not
}

TEST(SynthLeaningWalls, VolumeIsThatOfTheTrapezium) {
  const double h = 2.7, in = h * std::tan(12 * pi / 180), out = h * std::tan(6 * pi / 180);
  const double section = h * (5 + 5 - in + out) / 2, xs = 0.58 * 9;
  expect_near(volumes<LeaningWalls>(), {section * xs, section * (9 - xs - 0.12)});
  int leaning = 0;
  for (const auto& face : build<LeaningWalls>().truth.faces)
    if (face.surface == SurfaceClass::wall && std::abs(face.plane.normal.z()) > 1e-6) {
      const double degrees = std::asin(face.plane.normal.z()) * 180 / pi;
      EXPECT_TRUE(std::abs(degrees + 12) < 1e-9 || std::abs(degrees - 6) < 1e-9) << degrees;
      ++leaning;
    }
  EXPECT_EQ(leaning, 4);
}

TEST(SynthBarrelVault, StripsHaveTheirEdgesOnTheCylinder) {
  for (const std::int64_t strips : {4, 20, 50}) {
    BarrelVault::Params params;
    params.strips = strips;
    const auto n = static_cast<double>(strips);
    expect_near(volumes<BarrelVault>(params), {8 * (5 * 1.8 + n / 2 * 2.5 * 2.5 * std::sin(pi / n)), 5 * 3.5 * 2.7});
    const auto truth = build<BarrelVault>(params).truth;
    std::int64_t vault = 0;
    for (const auto& face : truth.faces) {
      if (face.room != 0 || face.surface != SurfaceClass::ceiling) continue;
      ++vault;
      for (const auto& p : face.outline) EXPECT_NEAR(std::hypot(p.x() - 2.5, p.z() - 1.8), 2.5, 1e-12);
    }
    EXPECT_EQ(vault, strips);
  }
}

TEST(SynthOpenPlan, ColumnsAreLeftOutOfFloorCeilingAndVolume) {
  const auto truth = build<OpenPlan>().truth;
  const double square = 0.4 * 0.4, round = 6 * 0.25 * 0.25 * std::sin(pi / 6);
  const double outline = 30 * 18 - 5.12 * 4.12;
  // Four by two columns stand 6 m apart; none in the meeting room.
  const double area = outline - 4 * square - 4 * round;
  EXPECT_NEAR(floor_area(truth, 0), area, 1e-9);
  EXPECT_NEAR(room_volume(truth, 0), area * 3.2, 1e-9);
  EXPECT_NEAR(room_volume(truth, 1), 5 * 4 * 3.2, 1e-9);
  EXPECT_GT(openings_of(truth, "window"), 25);
}

TEST(SynthSectorRooms, HallAndRoomsAreConcentricPolygons) {
  const auto truth = build<SectorRooms>().truth;
  ASSERT_EQ(truth.rooms.size(), 7U);
  EXPECT_NEAR(room_volume(truth, 0), 12 * 16 * std::sin(2 * pi / 24) * 2.9, 1e-9);
  for (int room = 2; room < 7; ++room) EXPECT_NEAR(room_volume(truth, room), room_volume(truth, 1), 1e-9);
  int doors = 0;
  for (const auto& o : truth.openings) {
    if (o.room_b < 0) continue;
    ++doors;
    EXPECT_NEAR(o.thickness, 0.2, 1e-9);
  }
  EXPECT_EQ(doors, 6);
  // Rooms, walls between them and the hall fill the outer polygon.
  const double ring = 12 * (8.5 * 8.5 - 16) * std::sin(2 * pi / 24);
  double rooms = 0;
  for (int room = 1; room < 7; ++room) rooms += floor_area(truth, room);
  EXPECT_LT(rooms, ring);
  EXPECT_GT(rooms, ring - 6 * 0.2 * 4.6 - 0.2 * 2 * pi * 4.2);
}

TEST(SynthOldFlat, HasNoSquareCornerButParallelWallSides) {
  const auto truth = build<OldFlat>().truth;
  ASSERT_EQ(truth.rooms.size(), 6U);
  std::set<double> thicknesses;
  for (const auto& o : truth.openings) thicknesses.insert(std::round(o.thickness * 1e6) / 1e6);
  EXPECT_EQ(thicknesses, (std::set<double>{0.16, 0.38, 0.5}));
  // The kitchen has neither niche nor breast: four corners, none of them
  // square.
  const auto& kitchen = truth.rooms[3].outline;
  ASSERT_EQ(kitchen.size(), 4U);
  int askew = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d a = kitchen[(i + 1) % 4] - kitchen[i], b = kitchen[(i + 3) % 4] - kitchen[i];
    const double degrees = std::acos(a.normalized().dot(b.normalized())) * 180 / pi;
    EXPECT_NEAR(degrees, 90, 8);
    askew += std::abs(degrees - 90) > 0.02 ? 1 : 0;
  }
  EXPECT_GE(askew, 3);
  EXPECT_EQ(truth.rooms[0].outline.size(), 12U);  // bay and chimney breast
  EXPECT_EQ(truth.rooms[1].outline.size(), 8U);   // a niche
  std::set<double> heights;
  for (const auto& face : truth.faces)
    if (face.surface == SurfaceClass::ceiling) heights.insert(face.outline[0].z());
  EXPECT_EQ(heights.size(), 6U);
}

TEST(SynthTallBuilding, HasFiftyOneRooms) {
  const auto truth = build<TallBuilding>().truth;
  ASSERT_EQ(truth.rooms.size(), 51U);
  const double width = (27 - 7 * 0.12) / 8;
  int rooms = 0;
  for (int room = 0; room < 51; ++room) {
    if (truth.rooms[static_cast<std::size_t>(room)].name.rfind("corridor", 0) == 0) continue;
    ++rooms;
    EXPECT_NEAR(room_volume(truth, room), width * 4.5 * 2.6, 1e-9);
  }
  EXPECT_EQ(rooms, 48);
  EXPECT_EQ(openings_of(truth, "slab"), 2);
  EXPECT_EQ(openings_of(truth, "door"), 48 + 1);
  EXPECT_EQ(openings_of(truth, "window"), 48 + 3);
}

TEST(SynthFlat, FittingsHideTheTruthAndKeepIt) {
  Flat::Params params;
  const auto plain = build<Flat>(params);
  params.shelves = 0.7;
  params.curtains = params.door_leaves = params.mirror = true;
  const auto fitted = build<Flat>(params);
  EXPECT_EQ(content_hash(plain.truth), content_hash(fitted.truth));
  const auto objects = [&](const std::string& name) {
    return std::count(fitted.objects.begin(), fitted.objects.end(), name);
  };
  EXPECT_EQ(objects("curtain"), 2 * openings_of(fitted.truth, "window"));
  EXPECT_EQ(objects("door leaf"), 1 + 3);  // the entrance's
  EXPECT_EQ(objects("mirror"), 1);
  EXPECT_GT(objects("shelf") + objects("cupboard"), 15);
  check_scene(fitted);
}

}  // namespace
}  // namespace atrium::synth::solids_test
