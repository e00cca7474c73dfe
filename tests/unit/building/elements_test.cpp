#include "modules/building/elements.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "houses.hpp"
#include "modules/building/profile.hpp"
#include "modules/floorplan/regions.hpp"

namespace atrium::building::elements_test {
namespace {

using test::BoxBuilding;
using test::House;

PlanPolygon rectangle(double x0, double y0, double x1, double y1) {
  return {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, {}};
}

/// Whether walls and rooms of a storey cover `whole` without gap or overlap.
void expect_tiling(const Building& building, const Elements& elements, std::int32_t storey, const PlanPolygon& whole) {
  floorplan::Region all;
  double sum = 0;
  for (const auto& wall : elements.walls)
    if (wall.storey == storey) all.push_back(wall.footprint);
  for (const auto& column : elements.columns) all.push_back({column.outline, {}});
  for (const auto& room : building.rooms) {
    if (room.storey != storey) continue;
    PlanPolygon polygon;
    for (const auto& p : room.outline) polygon.outline.emplace_back(p.head<2>());
    for (const auto& hole : room.holes) {
      polygon.holes.emplace_back();
      for (const auto& p : hole) polygon.holes.back().emplace_back(p.head<2>());
    }
    all.push_back(polygon);
  }
  for (const auto& polygon : all) sum += polygon.area();
  const auto together = floorplan::joined(all, {});
  EXPECT_NEAR(floorplan::area(together), sum, 1e-4) << "overlaps";
  EXPECT_NEAR(floorplan::area(floorplan::minus({whole}, together)), 0, 1e-4) << "gaps";
  EXPECT_NEAR(floorplan::area(floorplan::minus(together, {whole})), 0, 1e-4) << "reaches out";
}

const Wall& wall_of(const Elements& elements, std::vector<std::int32_t> faces) {
  const auto found =
      std::find_if(elements.walls.begin(), elements.walls.end(), [&](const Wall& w) { return w.faces == faces; });
  if (found == elements.walls.end()) throw std::runtime_error("no such wall");
  return *found;
}

TEST(Elements, TwoRoomsAreTiledByOneWallPerStretch) {
  const Building building = BoxBuilding::two_rooms();
  const Elements elements = elements_of(building, {});
  EXPECT_EQ(elements.walls.size(), 7U);
  expect_tiling(building, elements, 0, rectangle(-0.2, -0.2, 7.2, 3.2));
  const Wall& between = wall_of(elements, {3, 11});
  EXPECT_NEAR(between.thickness, 0.12, 1e-9);
  EXPECT_FALSE(between.assumed);
  EXPECT_EQ(std::min(between.left_room, between.right_room), 0);
  EXPECT_EQ(std::max(between.left_room, between.right_room), 1);
  EXPECT_EQ(std::count_if(elements.walls.begin(), elements.walls.end(), [](const Wall& w) { return w.assumed; }), 6);
}

TEST(Elements, TheOpeningsAreTakenOutOfTheirWalls) {
  const Elements elements = elements_of(BoxBuilding::two_rooms(), {});
  const Wall& between = wall_of(elements, {3, 11});
  ASSERT_EQ(between.holes.size(), 1U);
  EXPECT_TRUE(between.holes[0].main);
  EXPECT_NEAR(between.gross_area() - between.net_area(), 0.9 * 2.1, 1e-6);
  EXPECT_NEAR(between.gross_volume() - between.net_volume(), 0.9 * 2.1 * 0.12, 1e-6);
  EXPECT_NEAR(between.gross_volume(), between.footprint.area() * 2.5, 1e-9);
  const Wall& front = wall_of(elements, {2});
  ASSERT_EQ(front.holes.size(), 1U);
  EXPECT_NEAR(front.gross_volume() - front.net_volume(), 1.5 * 1.2 * 0.2, 1e-6);
  EXPECT_NEAR(front.holes[0].low, 0.9, 1e-9);
}

TEST(Elements, CrossingsAndTeesHaveNeitherGapNorOverlapAtAnyAngle) {
  BoxBuilding b;
  b.room(0, 0, 4, 3);
  b.room(4.12, 0, 7, 3);
  b.room(0, 3.24, 4, 6);
  b.room(4.12, 3.24, 7, 6);  // a crossing of walls of 12 and 24 cm
  b.room(0, 6.1, 7, 9);      // a tee
  for (const double angle : {0.0, 0.4, 1.1}) {
    Transform turn;
    turn.rotation = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    const Building building = transformed(b.building, turn);
    PlanPolygon whole = rectangle(-0.2, -0.2, 7.2, 9.2);
    for (auto& p : whole.outline) p = turn.rotation.topLeftCorner<2, 2>() * p;
    const Elements elements = elements_of(building, {});
    expect_tiling(building, elements, 0, whole);
    EXPECT_EQ(elements.walls.size(), 15U) << angle;
  }
}

TEST(Elements, ObliqueCornersAndManySidesAreTiled) {
  House oblique;
  oblique.room({{{0, 0}, {5, 0}, {6.5, 4}, {0, 3}}, {}, {{0, 1, 2, 3}}, {}, {}}, 0, [](double, double) { return 2.5; });
  House round;
  House::Plan plan;
  for (int i = 0; i < 24; ++i) {
    const double angle = 2 * 3.141592653589793 * i / 24;
    plan.plan.emplace_back(3 * std::cos(angle), 3 * std::sin(angle));
    if (plan.ceilings.empty()) plan.ceilings.emplace_back();
    plan.ceilings[0].push_back(static_cast<std::uint32_t>(i));
  }
  round.room(plan, 0, [](double, double) { return 2.5; });
  for (const auto& building : {oblique.building, round.building}) {
    const Elements elements = elements_of(building, {});
    EXPECT_EQ(elements.walls.size(), building.faces.size() - 2);
    PlanRing outline;
    for (const auto& p : building.rooms[0].outline) outline.emplace_back(p.head<2>());
    floorplan::Region whole = floorplan::grown({{outline, {}}}, 0.2);
    expect_tiling(building, elements, 0, whole.front());
  }
}

TEST(Elements, GablesFollowTheRoof) {
  House house;
  house.room(House::gable(0, 0, 6, 4), 0, [](double x, double) { return 1 + 2 * (1 - std::abs(x - 3) / 3); });
  const Elements elements = elements_of(house.building, {});
  ASSERT_EQ(elements.walls.size(), 4U);
  const Wall& gable = wall_of(elements, {3});
  // Over the knee walls, which are 1 m high, it goes on level.
  EXPECT_NEAR(gable.gross_area(), 6 * 2 + 2 * 0.2 * 1, 1e-6);
  EXPECT_NEAR(gable.gross_volume(), 0.2 * gable.gross_area(), 1e-6);
  EXPECT_NEAR(gable.high(), 3, 1e-9);
  const Wall& knee = wall_of(elements, {4});
  EXPECT_TRUE(knee.level());
  EXPECT_NEAR(knee.gross_volume(), 4 * 0.2 * 1, 1e-6) << "the gables, which are higher, have the corners";
  expect_tiling(house.building, elements, 0, rectangle(-0.2, -0.2, 6.2, 4.2));
  std::vector<double> roofs;
  for (const auto& slab : elements.slabs)
    if (slab.kind == SlabKind::roof) {
      roofs.push_back(slab.footprint.area());
      EXPECT_NEAR(slab.thickness, 0.2 * std::hypot(1, 2.0 / 3), 1e-9);
    }
  ASSERT_EQ(roofs.size(), 2U);
  EXPECT_NEAR(roofs[0] + roofs[1], 6 * 4.4, 0.01) << "over the gables, and up to the knee walls";
}

TEST(Elements, AWallBetweenRoomsOfTwoHeightsHasTheHigherHead) {
  BoxBuilding b;
  b.room(0, 0, 4, 3, 0, 2.5);
  b.room(4.12, 0, 7, 3, -0.3, 4);
  const Wall wall = wall_of(elements_of(b.building, {}), {3, 11});
  EXPECT_NEAR(wall.low(), -0.3, 1e-9);
  EXPECT_NEAR(wall.high(), 4, 1e-9);
}

TEST(Elements, StoreysHaveOneSlabBetweenThem) {
  BoxBuilding b;
  b.building.storeys = {{0, 2.5}, {2.8, 2.5}};
  b.room(0, 0, 4, 3);
  b.room(4.12, 0, 7, 3);
  b.room(0, 0, 4, 3, 2.8, 5.3, 1);
  b.room(4.2, 0, 7, 3, 2.8, 5.3, 1);
  const Elements elements = elements_of(b.building, {});
  ASSERT_EQ(elements.slabs.size(), 3U);
  for (const auto& slab : elements.slabs) {
    EXPECT_NEAR(slab.footprint.area(), 7.4 * 3.4, 1e-3);
    EXPECT_EQ(slab.footprint.holes.size(), 0U);
    EXPECT_EQ(slab.kind == SlabKind::between, !slab.assumed);
    EXPECT_NEAR(slab.thickness, slab.kind == SlabKind::between ? 0.3 : 0.2, 1e-9);
  }
  expect_tiling(b.building, elements, 0, rectangle(-0.2, -0.2, 7.2, 3.2));
  expect_tiling(b.building, elements, 1, rectangle(-0.2, -0.2, 7.2, 3.2));
}

TEST(Elements, AWallBesideAHallEndsBelowTheRoomAboveIt) {
  BoxBuilding b;
  b.building.storeys = {{0, 2.5}, {2.8, 2.5}};
  b.room(0, 0, 4, 3);
  b.room(4.12, 0, 9, 3, 0, 5.3);
  b.room(0, 0, 4, 3, 2.8, 5.3, 1);
  const Elements elements = elements_of(b.building, {});
  for (const auto& below : elements.walls)
    for (const auto& above : elements.walls) {
      if (below.storey != 0 || above.storey != 1) continue;
      const double common = floorplan::area(floorplan::common({below.footprint}, {above.footprint}));
      EXPECT_TRUE(common < 1e-3 || below.high() <= above.low() + 1e-9);
    }
}

TEST(Elements, AStairwellOfTheRoomBelowTakesNoWallsElsewhere) {
  BoxBuilding b;
  b.building.storeys = {{0, 2.5}, {2.8, 2.5}};
  b.room(0, 0, 6, 3, 0, 5.3);
  // Only x > 4 is 5.3 m high; over the rest there is a ceiling at 2.5 m.
  auto& at = b.building.vertices;
  const auto first = static_cast<std::uint32_t>(at.size());
  for (const double z : {2.5, 5.3})
    for (const auto& p : std::vector<Eigen::Vector2d>{{0, 0}, {4, 0}, {4, 3}, {0, 3}}) at.emplace_back(p.x(), p.y(), z);
  BuildingFace low = b.building.faces[1];
  low.outline = {first, first + 3, first + 2, first + 1};
  low.plane.offset = 2.5;
  b.building.faces[1].outline = {5, first + 5, first + 6, 6};
  b.building.faces[2].outline = {0, first, first + 1, first + 5, 5, 1};
  b.building.faces[4].outline = {2, 6, first + 6, first + 2, first + 3, 3};
  b.building.faces[5].outline = {3, first + 3, first, 0};
  b.building.rooms[0].faces.push_back(static_cast<std::int32_t>(b.building.faces.size()));
  b.building.faces.push_back(low);
  b.room(0, 0.1, 3.9, 2.9, 2.8, 5.3, 1);
  const Elements elements = elements_of(b.building, {});
  for (const auto& line : elements.lines) {
    const BuildingFace& face = b.building.faces[static_cast<std::size_t>(line.face)];
    if (face.room != 1) continue;
    double length = 0;
    for (const auto& part : line.backing) length += part.to - part.from;
    EXPECT_NEAR(length, std::abs(face.plane.normal.x()) > 0.5 ? 2.8 : 3.9, 1e-3) << "face " << line.face;
  }
  const auto between = std::find_if(elements.slabs.begin(), elements.slabs.end(),
                                    [](const Slab& slab) { return slab.kind == SlabKind::between; });
  ASSERT_NE(between, elements.slabs.end());
  EXPECT_NEAR(between->thickness, 0.3, 1e-9);
  for (const auto& p : between->footprint.outline) EXPECT_LT(p.x(), 4.001) << "not in the stairwell";
}

TEST(Elements, ColumnsAreColumnsAndShaftsHaveWalls) {
  House house;
  House::Plan plan = House::rectangle(0, 0, 6, 5);
  plan.column = {{2, 2}, {2.4, 2}, {2.4, 2.5}, {2, 2.5}};
  house.room(plan, 0, [](double, double) { return 2.5; });
  const Elements elements = elements_of(house.building, {});
  ASSERT_EQ(elements.columns.size(), 1U);
  EXPECT_NEAR((PlanPolygon{elements.columns[0].outline, {}}.area()), 0.2, 1e-9);
  EXPECT_NEAR(elements.columns[0].high - elements.columns[0].low, 2.5, 1e-9);
  EXPECT_EQ(elements.walls.size(), 4U);
  expect_tiling(house.building, elements, 0, rectangle(-0.2, -0.2, 6.2, 5.2));
  ElementLimits limits;
  limits.max_column_width = 0.3;
  const Elements shaft = elements_of(house.building, limits);
  EXPECT_TRUE(shaft.columns.empty());
  expect_tiling(house.building, shaft, 0, rectangle(-0.2, -0.2, 6.2, 5.2));
}

TEST(Elements, EachStretchOfAFaceHasWhatStandsBehindIt) {
  const Building building = BoxBuilding::two_rooms();
  const Elements elements = elements_of(building, {});
  ASSERT_EQ(elements.lines.size(), 8U);
  for (const auto& line : elements.lines) {
    double length = 0;
    for (const auto& part : line.backing) length += part.to - part.from;
    double low = 1e9, high = -1e9;
    for (const auto v : building.faces[static_cast<std::size_t>(line.face)].outline) {
      low = std::min(low, line.along().dot(building.vertices[v].head<2>()));
      high = std::max(high, line.along().dot(building.vertices[v].head<2>()));
    }
    EXPECT_NEAR(length, high - low, 1e-3) << "face " << line.face;
  }
}

TEST(Elements, OfNoRoomsThereAreNone) {
  const Elements elements = elements_of(Building{}, {});
  EXPECT_TRUE(elements.walls.empty() && elements.slabs.empty() && elements.columns.empty());
}

TEST(Profile, FollowsTheLowerFootAndTheHigherHead) {
  const std::vector<ProfilePart> up{{0, 4, 0, 0, 2, 4}}, down{{0, 4, -1, 0.5, 4, 2}};
  const auto both = joined_profile({up, down}, 5);
  double area = 0;
  for (const auto& part : both)
    area += (part.to - part.from) * 0.5 * (part.high_from + part.high_to - part.low_from - part.low_to);
  // Heads: a V of 4, 3, 4; feet cross at 8/3: −1 to 0, then 0. From 4 to 5 all goes on level.
  EXPECT_NEAR(area, 14 + 0.5 * 8.0 / 3 + 4, 1e-9);
  EXPECT_NEAR(both.back().to, 5, 1e-12);
}

}  // namespace
}  // namespace atrium::building::elements_test
