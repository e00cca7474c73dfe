// What is drawn of a plan.
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "modules/floorplan/door_leaf.hpp"
#include "modules/floorplan/svg_canvas.hpp"
#include "tests/unit/floorplan/svg.hpp"

namespace atrium::floorplan::write_svg_test {
namespace {

void expect_no_overlap(const PlanStorey& storey, double mm, Units units = Units::metres) {
  struct Box {
    Eigen::Vector2d low, high;
  };
  std::vector<Box> boxes;
  for (const auto& chain : dimensions_of(storey, mm, units))
    for (const auto& label : chain.labels) {
      const double half = 0.5 * text_width(label.text, label.height);
      const Eigen::Vector2d reach =
          label.upwards ? Eigen::Vector2d(0.5 * label.height, half) : Eigen::Vector2d(half, 0.5 * label.height);
      boxes.push_back({label.middle - reach, label.middle + reach});
    }
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = i + 1; j < boxes.size(); ++j)
      EXPECT_TRUE((boxes[i].low.array() >= boxes[j].high.array()).any() ||
                  (boxes[j].low.array() >= boxes[i].high.array()).any())
          << i << " and " << j << " at " << mm;
}

TEST_F(Svg, LengthsAreInTheUnitThatIsAskedFor) {
  WriteSvg::Params params;
  params.units = Units::feet;
  std::string svg = write(with_openings(), params);
  for (const char* text : {"22\u2032 11\u00BD\u2033", "129.2 sq ft", "h 8\u2032 2\u00BD\u2033", "5 ft",
                           "on A4, dimensions in feet and inches"})
    EXPECT_TRUE(has_text(svg, text)) << text;
  EXPECT_EQ(svg.find("m\u00B2"), std::string::npos);
  params.units = Units::millimetres;
  svg = write(with_openings(), params);
  for (const char* text : {"7000", "12.00 m\u00B2", "h 2500 mm", "on A4, dimensions in millimetres"})
    EXPECT_TRUE(has_text(svg, text)) << text;
  for (const double mm : {0.05, 0.1, 0.2, 0.5}) {
    expect_no_overlap(with_openings().storeys[0], mm, Units::feet);
    expect_no_overlap(with_openings().storeys[0], mm, Units::millimetres);
  }
}

TEST_F(Svg, IsTrueToScaleOnPaper) {
  const std::string svg = write(plan_of(two_rooms()));
  const ptree root = parsed(svg);
  EXPECT_EQ(root.get<std::string>("<xmlattr>.width"), "297mm");
  EXPECT_EQ(root.get<std::string>("<xmlattr>.height"), "210mm");
  EXPECT_EQ(root.get<std::string>("<xmlattr>.viewBox"), "0 0 297 210");
  EXPECT_TRUE(has_text(svg, "1:50"));
  const Sheet sheet = arranged(plan_of(two_rooms()).storeys, 0, Paper::automatic, 0);
  EXPECT_NEAR((sheet.on_paper(0, {1, 0}) - sheet.on_paper(0, {0, 0})).x(), 20, 1e-9);
  // The filled wall, 12 cm by 3 m, is 2.4 mm by 60 mm.
  Eigen::Vector2d size = Eigen::Vector2d::Zero();
  each(root, "g", [&](const ptree& group) {
    if (group.get<std::string>("<xmlattr>.fill", "") != "#33363b") return;
    std::string path = group.get<std::string>("path.<xmlattr>.d");
    for (auto& c : path)
      if (std::string_view("MLZ,").find(c) != std::string_view::npos) c = ' ';
    std::istringstream in(path);
    Bounds2 box;
    for (Eigen::Vector2d p; in >> p.x() >> p.y();) box.add(p);
    size = box.size();
  });
  EXPECT_NEAR(size.x(), 2.4, 0.02);
  EXPECT_NEAR(size.y(), 60, 0.02);
}

TEST_F(Svg, DrawsDoorsWindowsAndHolesInSlabs) {
  std::size_t arcs = 0, polygons = 0, lines = 0;
  each(parsed(write(with_openings())), "g", [&](const ptree& group) {
    if (group.get<std::string>("<xmlattr>.class", "") != "openings") return;
    each(group, "path", [&](const ptree& path) {
      const std::string d = path.get<std::string>("<xmlattr>.d");
      const bool arc = d.find('A') != std::string::npos, closed = d.back() == 'Z';
      EXPECT_EQ(d.find("A18.000,18.000 0 0") != std::string::npos, arc) << "0.9 m at 1:50";
      ++(arc ? arcs : closed ? polygons : lines);
    });
  });
  EXPECT_EQ(arcs, 1U);
  EXPECT_EQ(polygons, 4U);
  // Two panes; two thresholds, two jambs and a leaf; the diagonals of the hole in the floor.
  EXPECT_EQ(lines, 2U + 5U + 2U);
}

TEST_F(Svg, DoorsTurnIntoRoomsAndWideOnesHaveTwoLeavesOrNone) {
  PlanStorey storey;
  storey.rooms.push_back({"a", {{{0, 0}, {4, 0}, {4, 3}, {0, 3}}, {}}, 2.5});
  PlanOpening door{"door", {3, 3}, {2.1, 3}, {}, 0, -1, 0, 2, 0};  // the room on its left
  const auto single = door_leaves(door, storey);
  ASSERT_EQ(single.size(), 1U);
  EXPECT_TRUE(single[0].hinge.isApprox(Eigen::Vector2d(3, 3))) << "near the corner";
  EXPECT_TRUE(single[0].open.isApprox(Eigen::Vector2d(3, 2.1))) << "into the room";
  EXPECT_TRUE(single[0].left());
  door.to = {1.2, 3};
  const auto pair = door_leaves(door, storey);
  ASSERT_EQ(pair.size(), 2U);
  EXPECT_TRUE(pair[0].closed.isApprox(pair[1].closed));
  door.to = {0.2, 3};
  EXPECT_TRUE(door_leaves(door, storey).empty());
  door.kind = "window";
  door.to = {2.1, 3};
  EXPECT_TRUE(door_leaves(door, storey).empty());
}

TEST_F(Svg, NamesRoomsWithAreaAndHeight) {
  const std::string svg = write(plan_of(two_rooms()));
  for (const auto* text : {"Room 1", "Room 2", "h 2.50 m", "4.00", "0.12", "2.88", "3.00", "7.00", "y", "Floor plan"})
    EXPECT_TRUE(has_text(svg, text)) << text;
  EXPECT_TRUE(has_text(svg, "12.00 m\u00B2"));
  EXPECT_TRUE(has_text(svg, "8.64 m\u00B2"));
}

TEST_F(Svg, TextIsEscaped) {
  WriteSvg::Params params;
  params.title = "<b> & \"quoted\" \x01 \xC3\xBC \xFF";
  const std::string svg = write(plan_of(two_rooms()), params);
  EXPECT_TRUE(has_text(svg, "<b> & \"quoted\" \xEF\xBF\xBD \xC3\xBC \xEF\xBF\xBD"));
  EXPECT_EQ(escaped("\xED\xA0\x80"), "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD");  // a surrogate
  EXPECT_EQ(escaped("\xE2\x82"), "\xEF\xBF\xBD\xEF\xBF\xBD");                  // cut off
}

TEST_F(Svg, DimensionTextsDoNotOverlap) {
  for (const double width : {0.4, 0.9, 3.0})
    for (const double mm : {0.05, 0.1, 0.2, 1.0})
      expect_no_overlap(plan_of(row_of_rooms(width, 3, 8)).storeys.at(0), mm);
}

TEST_F(Svg, DimensionChainsAddUp) {
  for (const auto& chain : dimensions_of(plan_of(two_rooms()).storeys.at(0), 0.05)) {
    ASSERT_EQ(chain.labels.size() + 1, chain.stops.size());
    double sum = 0;
    for (const auto& label : chain.labels) sum += std::stod(label.text);
    EXPECT_NEAR(sum, chain.stops.back() - chain.stops.front(), 0.005 * static_cast<double>(chain.labels.size()));
  }
}

TEST_F(Svg, IsTurnedSoThatWallsAreParallelToTheSheet) {
  for (const double degrees : {30.0, -40.0, 100.0}) {
    Mesh mesh = two_rooms();
    const double angle = degrees * std::numbers::pi / 180;
    for (auto& v : mesh.vertices) v.head<2>() = Eigen::Rotation2Dd(angle) * v.head<2>();
    const FloorPlan plan = plan_of(mesh);
    const double turn = wall_turn(plan);
    EXPECT_NEAR(turn * 180 / std::numbers::pi, degrees > 45 ? degrees - 90 : degrees, 1e-6);
    for (const auto& wall : turned(plan.storeys.at(0), turn).walls)
      EXPECT_NEAR(((wall.to - wall.from).cwiseAbs().minCoeff()), 0, 1e-6);
  }
}

TEST_F(Svg, TheSamePlanGivesTheSameBytes) {
  const FloorPlan plan = plan_of(row_of_rooms(3, 4, 3));
  EXPECT_EQ(write(plan), write(plan));
}

TEST_F(Svg, WhatIsNotKnownIsSaidToBeUnknown) {
  MeshBuilder only_ceiling, upside_down;
  only_ceiling.ceiling(0, 0, 5, 4, 2.6);
  upside_down.room(0, 0, 5, 4, 0, -2.6);
  std::string svg = write(plan_of(only_ceiling.mesh));
  EXPECT_NE(svg.find("elevation unknown \u00B7 height unknown"), std::string::npos);
  EXPECT_EQ(svg.find("2.60 m<"), std::string::npos);
  EXPECT_TRUE(has_text(svg, "h unknown"));
  svg = write(plan_of(upside_down.mesh));
  EXPECT_NE(svg.find("floor at 0.00 m \u00B7 height unknown"), std::string::npos);
}

TEST_F(Svg, AnEmptyPlanSaysSo) {
  const std::string svg = write({});
  EXPECT_TRUE(has_text(svg, "The plan is empty: no walls, floors or ceilings."));
  EXPECT_EQ(host->warnings.size(), 1U);
  EXPECT_EQ(host->written.size(), 1U);
}

TEST_F(Svg, PlansOfOneKindOfThingOnlyAreDrawn) {
  MeshBuilder wall, floor, upright;
  wall.wall(0, 0, 4, 0);
  floor.floor(0, 0, 4, 3);
  upright.wall(0, 0, 0, 4);
  for (const auto& mesh : {wall.mesh, floor.mesh, upright.mesh})
    EXPECT_TRUE(has_text(write(plan_of(mesh)), "Storey 0"));
}

TEST_F(Svg, AFolderThatCannotBeWrittenIsAnError) {
  test::write_text(host->folder / "file", "");
  WriteSvg::Params params;
  params.path.path = "file/plan.svg";
  EXPECT_THROW(write(plan_of(two_rooms()), params), Error);
}

TEST_F(Svg, WhatIsDoubtfulIsMarked) {
  PlanStorey storey;
  storey.rooms = {{"room 1", {{{0, 0}, {6, 0}, {6, 5}, {0, 5}}, {}}, 2.5, 0.37},
                  {"room 2", {{{7, 0}, {13, 0}, {13, 5}, {7, 5}}, {}}, 2.5, 0.9}};
  PlanWall wall;
  wall.from = {0, 0};
  wall.to = {6, 0};
  storey.walls = {wall};
  FloorPlan plan;
  plan.storeys = {storey};
  EXPECT_EQ(write(plan).find("class=\"inferred\""), std::string::npos);
  plan.storeys[0].walls[0].inferred = true;
  const std::string svg = write(plan);
  EXPECT_NE(svg.find("class=\"inferred\""), std::string::npos);
  const auto all = texts(svg);
  EXPECT_EQ(std::count(all.begin(), all.end(), "confidence 0.37"), 1);
  EXPECT_EQ(std::count(all.begin(), all.end(), "confidence 0.90"), 0);
}

TEST_F(Svg, WhatWasCorrectedHasAMarkAndALegend) {
  PlanStorey storey;
  storey.rooms = {{"room 1", {{{0, 0}, {6, 0}, {6, 5}, {0, 5}}, {}}, 2.5, 0.9}};
  PlanWall wall;
  wall.to = {6, 0};
  storey.walls = {wall};
  PlanOpening window;
  window.kind = "window";
  window.from = {2, 5};
  window.to = {1, 5};
  storey.openings = {window};
  FloorPlan plan;
  plan.storeys = {storey};
  EXPECT_EQ(write(plan).find("corrected"), std::string::npos);
  plan.storeys[0].walls[0].corrected = plan.storeys[0].openings[0].corrected = plan.storeys[0].rooms[0].corrected =
      true;
  const std::string svg = write(plan);
  const auto marks = [](const std::string& text) {
    int count = 0;
    for (auto at = text.find("#d6006c"); at != std::string::npos; at = text.find("#d6006c", at + 1)) ++count;
    return count;
  };
  EXPECT_EQ(marks(svg), 4) << "a wall, an opening, a room, the legend";
  const auto all = texts(svg);
  EXPECT_EQ(std::count(all.begin(), all.end(), "corrected by hand"), 1);
}

}  // namespace
}  // namespace atrium::floorplan::write_svg_test
