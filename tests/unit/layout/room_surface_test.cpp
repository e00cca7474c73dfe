#include "modules/layout/room_surface.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <set>

#include "modules/geometry/polygon.hpp"
#include "tests/unit/layout/cells.hpp"

namespace atrium::layout::room_surface_test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using namespace atrium::test;

Plane plane_of(const StoreyCells& storey, const FaceKey& key) {
  const auto index = static_cast<std::size_t>(key.index);
  if (key.surface == SurfaceClass::wall) {
    const double side = key.along_normal ? 1 : -1;
    const auto& line = storey.lines.at(index);
    return {side * Vector3d(line.normal.x(), line.normal.y(), 0), side * line.offset};
  }
  const Plane plane = (key.surface == SurfaceClass::floor ? storey.floors : storey.ceilings).at(index).plane;
  if ((plane.normal.z() > 0) == (key.surface == SurfaceClass::floor)) return plane;
  return {-plane.normal, -plane.offset};
}

/// What is wrong with a room's surface; "" if it is closed, 2-manifold but for upright edges, its faces are plane
/// within 2 mm and look inside, and each corner is one.
std::string flaw(const StoreyCells& storey, const RoomSurface& surface) {
  const Sides sides = sides_of(surface);
  if (!sides.closed()) return "open";
  if (!sides.manifold(surface.vertices)) return "an edge of more than two faces";
  std::set<std::uint32_t> used;
  for (const auto& face : surface.faces) {
    const Plane plane = plane_of(storey, face.key);
    Vector3d area = area_vector(surface.vertices, face.outline);
    if (area.dot(plane.normal) <= 0) return "a face that looks outside";
    std::vector<std::vector<std::uint32_t>> rings = face.holes;
    rings.push_back(face.outline);
    for (const auto& ring : rings) {
      if (ring.size() < 3) return "a ring of " + std::to_string(ring.size()) + " corners";
      for (const auto v : ring) {
        used.insert(v);
        const double off = std::abs(plane.signed_distance(surface.vertices.at(v)));
        if (off > 2e-3 + 1e-9) return "a corner " + std::to_string(1000 * off) + " mm off its face";
      }
    }
    for (const auto& hole : face.holes)
      if (area_vector(surface.vertices, hole).dot(plane.normal) >= 0) return "a hole that runs like an outline";
  }
  if (used.size() != surface.vertices.size()) return "vertices that no face uses";
  return "";
}

double prisms(const StoreyCells& storey, std::int32_t room) {
  double sum = 0;
  for (const auto& cell : storey.cells) {
    if (cell.room != room) continue;
    const auto& floor = storey.floors[static_cast<std::size_t>(cell.floor)];
    const auto& ceiling = storey.ceilings[static_cast<std::size_t>(cell.ceiling)];
    const Vector2d& a = storey.vertices[cell.corners[0]];
    for (std::size_t i = 2; i < cell.corners.size(); ++i) {
      const Vector2d &b = storey.vertices[cell.corners[i - 1]], &c = storey.vertices[cell.corners[i]];
      const Vector2d middle = (a + b + c) / 3;
      const double area = ((b - a).x() * (c - a).y() - (b - a).y() * (c - a).x()) / 2;
      sum += area * (ceiling.height_at(middle) - floor.height_at(middle));
    }
  }
  return sum;
}

struct Made {
  StoreyCells storey;
  RoomSurface surface;
};
Made made(StoreyCells storey, std::int32_t room = 0) {
  cut_pinched_cells(storey);
  split_crossing_steps(storey);
  RoomSurface surface = room_surface(storey, room);
  return {std::move(storey), std::move(surface)};
}
double plan_area(const RoomSurface& surface) {
  double twice = 0;
  for (std::size_t i = 0; i < surface.outline.size(); ++i) {
    const Vector2d &p = surface.outline[i], &q = surface.outline[(i + 1) % surface.outline.size()];
    twice += p.x() * q.y() - p.y() * q.x();
  }
  return twice / 2;
}
std::size_t count(const RoomSurface& surface, SurfaceClass c) {
  return static_cast<std::size_t>(
      std::count_if(surface.faces.begin(), surface.faces.end(), [&](const auto& f) { return f.key.surface == c; }));
}

TEST(RoomSurface, ABox) {
  const auto [storey, surface] = made(grid_cells({"....", ".aa.", "...."}));
  EXPECT_EQ(flaw(storey, surface), "");
  EXPECT_EQ(surface.vertices.size(), 8U);
  EXPECT_EQ(surface.faces.size(), 6U);
  EXPECT_EQ(euler(surface), 2);
  EXPECT_NEAR(volume_of(surface), 5, 1e-9);
  EXPECT_EQ(surface.outline.size(), 4U);
  EXPECT_TRUE(surface.holes.empty());
}

// Each of the two corners is off the other's chord by 1.45 mm.
TEST(RoomSurface, OfTwoCornersAMillimetreApartOneStays) {
  StoreyCells storey = cells_of({0, 0}, {4, 3}, {{Vector2d(1, 1).normalized(), -(7 - 0.00145) / std::sqrt(2.0)}});
  ASSERT_EQ(storey.cells.size(), 2U);
  for (auto& cell : storey.cells) cell.room = cell.area > 1 ? 0 : -1;
  const auto [cells, surface] = made(storey);
  EXPECT_EQ(flaw(cells, surface), "");
  EXPECT_NEAR(plan_area(surface), 12, 0.01);
  EXPECT_EQ(surface.outline.size(), 4U);
  EXPECT_NEAR(volume_of(surface), 30, 0.03);
}

TEST(RoomSurface, AnL) {
  const auto [storey, surface] = made(grid_cells({".....", ".a...", ".a...", ".aaa.", "....."}));
  EXPECT_EQ(flaw(storey, surface), "");
  EXPECT_EQ(surface.vertices.size(), 12U);
  EXPECT_EQ(surface.faces.size(), 8U);
  EXPECT_NEAR(volume_of(surface), 5 * 2.5, 1e-9);
}

TEST(RoomSurface, AColumnMakesARing) {
  const auto [storey, surface] = made(grid_cells({".....", ".aaa.", ".a.a.", ".aaa.", "....."}));
  EXPECT_EQ(flaw(storey, surface), "");
  EXPECT_TRUE(sides_of(surface).manifold(surface.vertices, true));
  EXPECT_EQ(euler(surface), 0);  // genus 1
  EXPECT_NEAR(volume_of(surface), 8 * 2.5, 1e-9);
  ASSERT_EQ(surface.holes.size(), 1U);
  EXPECT_EQ(surface.holes[0].size(), 4U);
  EXPECT_EQ(surface.faces.size(), 10U);
  for (const auto& face : surface.faces) EXPECT_EQ(face.holes.size(), face.key.surface == SurfaceClass::wall ? 0U : 1U);
}

TEST(RoomSurface, TwoColumnsThatTouchInACorner) {
  const auto [storey, surface] = made(grid_cells({"......", ".aaaa.", ".a.aa.", ".aa.a.", ".aaaa.", "......"}));
  EXPECT_EQ(flaw(storey, surface), "");
  EXPECT_NEAR(volume_of(surface), 14 * 2.5, 1e-9);
}

TEST(RoomSurface, ARoomThatTouchesItselfInACorner) {
  const auto [storey, surface] = made(grid_cells({"......", ".aaa..", ".a.aa.", ".aa.a.", "..aaa.", "......"}));
  EXPECT_EQ(flaw(storey, surface), "");
  EXPECT_NEAR(volume_of(surface), 12 * 2.5, 1e-9);
}

TEST(RoomSurface, AColumnInTheCornerOfTheRoom) {
  // Its corner is one of the outline's: no hole, or one that touches.
  const auto [storey, surface] = made(grid_cells({"......", ".aaa..", ".a.aa.", ".aaaa.", "......"}));
  EXPECT_EQ(flaw(storey, surface), "");
  EXPECT_NEAR(volume_of(surface), 10 * 2.5, 1e-9);
}

TEST(RoomSurface, RoomsThatTouchInACorner) {
  const StoreyCells cells = grid_cells({"....", ".ab.", ".ba.", "...."});
  for (const int room : {0, 1}) {
    const auto [storey, surface] = made(cells, room);
    EXPECT_EQ(flaw(storey, surface), "") << room;
    EXPECT_NEAR(volume_of(surface), 5, 1e-9);
    EXPECT_EQ(count(surface, SurfaceClass::floor), 2U);
  }
}

TEST(RoomSurface, AStepInTheFloorAndOneInTheCeiling) {
  StoreyCells cells = grid_cells({".....", ".aaa.", ".aaa.", "....."});
  cells.floors.push_back(level(0.3, true));
  cells.ceilings.push_back(level(2.2, false));
  for (int y = 1; y < 3; ++y) {
    grid_cell(cells, 2, y).floor = 1;
    grid_cell(cells, 3, y).floor = 1;
    grid_cell(cells, 3, y).ceiling = 1;
  }
  const auto [storey, surface] = made(cells);
  EXPECT_EQ(flaw(storey, surface), "");
  EXPECT_EQ(euler(surface), 2);
  EXPECT_NEAR(volume_of(surface), 2 * (2.5 + 2.2 + 1.9), 1e-9);
  EXPECT_EQ(count(surface, SurfaceClass::floor), 2U);
  EXPECT_EQ(count(surface, SurfaceClass::ceiling), 2U);
  EXPECT_EQ(count(surface, SurfaceClass::wall), 6U);
}

TEST(RoomSurface, AStepInTheMiddleOfTheFloor) {
  StoreyCells cells = grid_cells({".....", ".aaa.", ".aaa.", ".aaa.", "....."});
  cells.floors.push_back(level(0.2, true));
  grid_cell(cells, 2, 2).floor = 1;
  const auto [storey, surface] = made(cells);
  EXPECT_EQ(flaw(storey, surface), "");
  EXPECT_EQ(euler(surface), 2);
  EXPECT_NEAR(volume_of(surface), 9 * 2.5 - 0.2, 1e-9);
  EXPECT_EQ(surface.faces.size(), 6U + 5U);
}

TEST(RoomSurface, ASlantedCeilingOverASteppedFloorCrossesIt) {
  // The two ceilings cross in the middle of the edges between the cells.
  StoreyCells cells = grid_cells({"....", ".aa.", ".aa.", "...."});
  cells.ceilings.push_back(slanted(1.5, {0, 0.5}, false));  // 2.5 at y = 2
  for (int y = 1; y < 3; ++y) grid_cell(cells, 2, y).ceiling = 1;
  // Cut so that the crossing lies within edges: shift the slanted one.
  cells.ceilings[1] = slanted(1.7, {0, 0.5}, false);  // 2.5 at y = 1.6
  const auto [storey, surface] = made(cells);
  EXPECT_EQ(flaw(storey, surface), "");
  EXPECT_EQ(euler(surface), 2);
  EXPECT_NEAR(volume_of(surface), prisms(cells, 0), 1e-9);
  EXPECT_EQ(storey.vertices.size(), cells.vertices.size() + 1);
}

TEST(RoomSurface, ACeilingThatSlantsDownToTheFloor) {
  // Its line with the floor is the room's end: the wall there has no height.
  StoreyCells cells = grid_cells({"....", ".aa.", "...."});
  cells.ceilings[0] = slanted(-1.25, {1.25, 0}, false);  // 0 at x = 1, 2.5 at x = 3
  const auto [storey, surface] = made(cells);
  EXPECT_EQ(flaw(storey, surface), "");
  EXPECT_EQ(surface.faces.size(), 5U);
  EXPECT_EQ(surface.vertices.size(), 6U);
  EXPECT_NEAR(volume_of(surface), 2.5, 1e-9);
}

TEST(RoomSurface, ACeilingBelowTheFloorInTheMiddleOfACell) {
  // Nothing cut the cell where they meet, at x = 1.4: there the room ends.
  StoreyCells cells = grid_cells({"....", ".aa.", "...."});
  cells.ceilings[0] = slanted(-1.4, {1, 0}, false);
  const auto [storey, surface] = made(cells);
  EXPECT_EQ(flaw(storey, surface), "");
  EXPECT_EQ(surface.faces.size(), 5U);
  EXPECT_NEAR(volume_of(surface), 0.5 * 1.6 * 1.6, 1e-9);
}

TEST(RoomSurface, ACeilingBelowTheFloorEverywhereIsNoRoom) {
  StoreyCells cells = grid_cells({"....", ".aa.", "...."});
  cells.ceilings[0] = level(-0.5, false);
  EXPECT_TRUE(made(cells).surface.faces.empty());
}

TEST(RoomSurface, ARoomThatReachesTheBorderOfTheComplex) {
  const auto [storey, surface] = made(grid_cells({"aa", "aa"}));
  EXPECT_TRUE(sides_of(surface).manifold(surface.vertices, true));
  EXPECT_EQ(surface.faces.size(), 6U);
  EXPECT_EQ(euler(surface), 2);
  EXPECT_NEAR(volume_of(surface), 10, 1e-9);
}

TEST(RoomSurface, ARoomThatIsNotThereHasNoFaces) {
  const auto [storey, surface] = made(grid_cells({"...", ".a.", "..."}), 7);
  EXPECT_TRUE(surface.faces.empty());
  EXPECT_TRUE(surface.vertices.empty());
  EXPECT_TRUE(surface.outline.empty());
}

bool at_border(const StoreyCells& storey, const LayoutCell& cell) {
  return std::any_of(cell.edges.begin(), cell.edges.end(),
                     [&](std::uint32_t e) { return storey.edges[e].left < 0 || storey.edges[e].right < 0; });
}

/// Lines at random, two rooms of random cells.
StoreyCells random_cells(Random& random) {
  std::vector<Arrangement::Line> lines;
  for (const double x : {0.5, 9.5}) {
    lines.push_back(line_through({x, 0}, 0));
    lines.push_back(line_through({0, x}, M_PI / 2));
  }
  for (std::uint64_t i = 0; i < 2 + random.index(7); ++i)
    lines.push_back(line_through(
        {random.uniform(1, 9), random.uniform(1, 9)},
        random.uniform() < 0.5 ? 0.5 * M_PI * static_cast<double>(random.index(2)) : random.uniform(-3.2, 3.2)));
  StoreyCells storey = cells_of({0, 0}, {10, 10}, lines);
  for (auto& cell : storey.cells)
    if (!at_border(storey, cell)) cell.room = static_cast<std::int32_t>(random.index(3)) - 1;
  return storey;
}
void expect_sound(const StoreyCells& cells, double tolerance) {
  for (const int room : {0, 1}) {
    const auto [storey, surface] = made(cells, room);
    const auto found = flaw(storey, surface);
    if (!found.empty()) RC_FAIL(found);
    double area = 0;
    for (const auto& cell : cells.cells) area += cell.room == room ? cell.area : 0;
    RC_ASSERT(std::abs(volume_of(surface) - prisms(cells, room)) <= tolerance * (1 + area));
  }
}

RC_GTEST_PROP(RoomSurface, IsSoundForAnyUnionOfCells, (std::uint32_t seed)) {
  Random random(seed);
  expect_sound(random_cells(random), 2e-3);
}

RC_GTEST_PROP(RoomSurface, IsSoundForStepsAnywhere, (std::uint32_t seed)) {
  Random random(seed);
  StoreyCells cells = random_cells(random);
  cells.floors.push_back(level(0.17, true));
  cells.floors.push_back(level(0.34, true));
  cells.ceilings.push_back(level(2.2, false));
  for (auto& cell : cells.cells) {
    cell.floor = static_cast<std::int32_t>(random.index(cells.floors.size()));
    cell.ceiling = static_cast<std::int32_t>(random.index(cells.ceilings.size()));
  }
  expect_sound(cells, 2e-3);
}

RC_GTEST_PROP(RoomSurface, IsSoundForSlantedFloorsAndCeilings, (std::uint32_t seed)) {
  Random random(seed);
  StoreyCells cells = random_cells(random);
  const auto slope = [&](double most) { return Vector2d(random.uniform(-most, most), random.uniform(-most, most)); };
  for (int i = 0; i < 3; ++i) {
    const Vector2d floor = slope(0.05), ceiling = slope(0.4);
    cells.floors.push_back(slanted(random.uniform(-0.2, 0.2) - floor.sum() * 5, floor, true));
    cells.ceilings.push_back(slanted(random.uniform(6, 6.5) - ceiling.sum() * 5, ceiling, false));
  }
  cells.ceilings[0] = level(6, false);
  for (auto& cell : cells.cells) {
    cell.floor = static_cast<std::int32_t>(random.index(cells.floors.size()));
    cell.ceiling = static_cast<std::int32_t>(random.index(cells.ceilings.size()));
  }
  expect_sound(cells, 8e-3);
}

double clear_height(const StoreyCells& cells, const Vector2d& p) {
  return cells.ceilings[0].height_at(p) - cells.floors[0].height_at(p);
}
/// Positive where the first ceiling is above the first floor.
Line2 difference(const StoreyCells& cells) {
  const double zero = clear_height(cells, {0, 0});
  return {{clear_height(cells, {1, 0}) - zero, clear_height(cells, {0, 1}) - zero}, zero};
}
double volume_over(const Polygon2& polygon, const StoreyCells& cells) {
  double sum = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const Polygon2 triangle{polygon[0], polygon[i - 1], polygon[i]};
    sum += area(triangle) * clear_height(cells, (triangle[0] + triangle[1] + triangle[2]) / 3);
  }
  return sum;
}

// Ceilings that cut through floors anywhere: the room is what is between them.
RC_GTEST_PROP(RoomSurface, IsSoundWhereCeilingsMeetFloors, (std::uint32_t seed)) {
  Random random(seed);
  StoreyCells cells = random_cells(random);
  const auto slope = [&](double most) { return Vector2d(random.uniform(-most, most), random.uniform(-most, most)); };
  const Vector2d floor = slope(0.05), ceiling = slope(0.6);
  cells.floors[0] = slanted(-floor.sum() * 5, floor, true);
  cells.ceilings[0] = slanted(random.uniform(-1, 2) - ceiling.sum() * 5, ceiling, false);
  for (const int room : {0, 1}) {
    const auto [storey, surface] = made(cells, room);
    const auto found = flaw(storey, surface);
    if (!found.empty()) RC_FAIL(found);
    double expected = 0;
    for (const auto& cell : cells.cells) {
      if (cell.room != room) continue;
      Polygon2 polygon;
      for (const auto c : cell.corners) polygon.push_back(cells.vertices[c]);
      const CutPolygon parts = cut(polygon, difference(cells), 0);
      if (parts.positive.size() > 2) expected += volume_over(parts.positive, cells);
    }
    RC_ASSERT(std::abs(volume_of(surface) - expected) <= 1e-2 * (1 + expected));
  }
}

}  // namespace
}  // namespace atrium::layout::room_surface_test
