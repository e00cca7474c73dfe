#include "modules/layout/rooms.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "tests/unit/layout/cells.hpp"
#include "tests/unit/layout/chain.hpp"

namespace atrium::layout::rooms_test {
namespace {

using namespace atrium::test;

struct Decided {
  CellComplex cells;
  std::shared_ptr<Warnings> warnings = std::make_shared<Warnings>();
};
Decided decided(const std::vector<StoreyCells>& storeys, const Rooms::Params& params = {}) {
  Decided result;
  Context context(1, result.warnings);
  CellComplex cells;
  cells.storeys = storeys;
  result.cells = Rooms::run({input(cells)}, params, context).cells;
  return result;
}

/// Floor, ceiling and walls as a scan of the picture's rooms shows them, which the cells do not know yet.
StoreyCells scanned(const std::vector<std::string>& picture, bool ceiling = true, bool floor = true) {
  StoreyCells storey = grid_cells(picture);
  for (auto& cell : storey.cells) {
    const bool inside = cell.room >= 0;
    cell.floor_cover = inside && floor ? 1 : 0;
    cell.ceiling_cover = inside && ceiling ? 1 : 0;
    cell.any_cover = inside ? 0.3 : 0;
  }
  for (auto& edge : storey.edges) {
    if (edge.left < 0 || edge.right < 0) continue;
    const auto left = storey.cells[static_cast<std::size_t>(edge.left)].room;
    const auto right = storey.cells[static_cast<std::size_t>(edge.right)].room;
    if (left == right) continue;
    edge.wall_left = left >= 0 ? 1 : 0;
    edge.wall_right = right >= 0 ? 1 : 0;
  }
  for (auto& cell : storey.cells) cell.room = -1;
  return storey;
}
/// Two rooms with a wall of 12 cm between them that was seen from the first one only; what the second one shows over it
/// ends there, or goes on.
StoreyCells wall_seen_from_one_side(double cover) {
  using Line = Arrangement::Line;
  StoreyCells storey =
      cells_of({0, 0}, {8.12, 4}, {Line{Eigen::Vector2d::UnitX(), -4}, Line{Eigen::Vector2d::UnitX(), -4.12}});
  for (auto& cell : storey.cells) {
    const double x = middle_of(storey, cell).x();
    cell.floor_cover = cell.ceiling_cover = x > 4 && x < 4.12 ? cover : 1;
  }
  for (auto& edge : storey.edges) {
    const double x = (storey.vertices[edge.from].x() + storey.vertices[edge.to].x()) / 2;
    if (std::abs(x - 4) < 0.01) {
      const bool left = edge.left >= 0 && middle_of(storey, storey.cells[static_cast<std::size_t>(edge.left)]).x() < 4;
      (left ? edge.wall_left : edge.wall_right) = 1;
    } else if (edge.left < 0 || edge.right < 0) {
      (edge.left >= 0 ? edge.wall_left : edge.wall_right) = 1;
    }
  }
  return storey;
}

/// Two rooms with a wall of 12 cm between them, of whose last metre nothing was seen but the share of a ceiling.
StoreyCells half_hidden_wall(double ceiling) {
  using Line = Arrangement::Line;
  StoreyCells storey = cells_of(
      {0, 0}, {8.12, 4},
      {Line{Eigen::Vector2d::UnitX(), -4}, Line{Eigen::Vector2d::UnitX(), -4.12}, Line{Eigen::Vector2d::UnitY(), -3}});
  for (auto& cell : storey.cells) {
    const Eigen::Vector2d p = middle_of(storey, cell);
    const bool wall = p.x() > 4 && p.x() < 4.12;
    cell.ceiling_cover = !wall ? 1 : p.y() > 3 ? ceiling : 0;
    cell.floor_cover = wall ? 0 : 0.8;
    cell.measured = true;
  }
  for (auto& edge : storey.edges) {
    const Eigen::Vector2d p = (storey.vertices[edge.from] + storey.vertices[edge.to]) / 2;
    if (edge.left < 0 || edge.right < 0) {
      (edge.left >= 0 ? edge.wall_left : edge.wall_right) = 1;
    } else if (p.y() < 3 && (p.x() == 4 || p.x() == 4.12)) {
      const bool to_the_right = storey.vertices[edge.to].y() < storey.vertices[edge.from].y();
      const bool looks_right = p.x() > 4.1;
      (to_the_right == looks_right ? edge.wall_left : edge.wall_right) = 1;
    }
  }
  return storey;
}
/// The rooms at the two ends of the hidden piece, and of the piece itself.
std::array<std::int32_t, 3> rooms_around(double ceiling) {
  const CellComplex cells = decided({half_hidden_wall(ceiling)}).cells;
  std::array<std::int32_t, 3> result{};
  for (const auto& cell : cells.storeys[0].cells) {
    const Eigen::Vector2d p = middle_of(cells.storeys[0], cell);
    if (p.y() > 3) result.at(p.x() < 4 ? 0 : p.x() > 4.12 ? 1 : 2) = cell.room;
  }
  return result;
}

/// As a picture with rooms as letters.
std::vector<std::string> picture_of(StoreyCells storey, int columns, int rows) {
  std::vector<std::string> result;
  for (int y = rows - 1; y >= 0; --y) {
    std::string line;
    for (int x = 0; x < columns; ++x) {
      const int room = grid_cell(storey, x, y).room;
      line += room < 0 ? '.' : static_cast<char>('a' + room);
    }
    result.push_back(line);
  }
  return result;
}
using Picture = std::vector<std::string>;

TEST(Rooms, AWallGoesOnBehindWhatHidesIt) {
  const auto hidden = rooms_around(0.2);
  EXPECT_NE(hidden[0], hidden[1]);
  EXPECT_EQ(hidden[2], -1);
  const auto open = rooms_around(0.9);
  EXPECT_EQ(open[0], open[1]);
  EXPECT_EQ(open[2], open[0]);
}

TEST(Rooms, AreWhatWallsFloorsAndCeilingsEnclose) {
  const Picture picture{"......", ".aaa..", ".aaa..", ".a....", "......"};
  const auto result = decided({scanned(picture)});
  EXPECT_EQ(picture_of(result.cells.storeys[0], 6, 5), picture);
  EXPECT_TRUE(result.warnings->texts.empty());
}

TEST(Rooms, AreNumberedByFallingAreaThroughAllStoreys) {
  const Picture low{".......", ".a.bbb.", ".a.bbb.", "......."}, high{".......", ".aaaaa.", ".......", "......."};
  const auto result = decided({scanned(low), scanned(high)});
  EXPECT_EQ(picture_of(result.cells.storeys[0], 7, 4), (Picture{".......", ".c.aaa.", ".c.aaa.", "......."}));
  EXPECT_EQ(picture_of(result.cells.storeys[1], 7, 4), (Picture{".......", ".bbbbb.", ".......", "......."}));
}

TEST(Rooms, WithoutACeilingTheFloorAndWhatStandsOnItCount) {
  const Picture picture{".....", ".aaa.", ".aaa.", "....."};
  EXPECT_EQ(picture_of(decided({scanned(picture, false)}).cells.storeys[0], 5, 4), picture);
}

TEST(Rooms, WithoutAFloorTheCeilingIsEnough) {
  const Picture picture{".....", ".aaa.", ".aaa.", "....."};
  EXPECT_EQ(picture_of(decided({scanned(picture, true, false)}).cells.storeys[0], 5, 4), picture);
}

TEST(Rooms, AWallThatWasNotSeenDoesNotOpenThem) {
  const Picture picture{".....", ".aaa.", ".aaa.", "....."};
  StoreyCells storey = scanned(picture);
  for (auto& edge : storey.edges)
    if (storey.vertices[edge.from].y() == 3 && storey.vertices[edge.to].y() == 3) edge.wall_left = edge.wall_right = 0;
  EXPECT_EQ(picture_of(decided({storey}).cells.storeys[0], 5, 4), picture);
}

TEST(Rooms, AThinWallPartsThem) {
  const Picture picture{".....", ".abb.", ".abb.", "....."};
  EXPECT_EQ(picture_of(decided({scanned(picture)}).cells.storeys[0], 5, 4),
            (Picture{".....", ".baa.", ".baa.", "....."}));
}

TEST(Rooms, AHiddenPieceOfFloorAndCeilingStaysInside) {
  const Picture picture{".....", ".aaa.", ".aaa.", ".aaa.", "....."};
  StoreyCells storey = scanned(picture);
  auto& hidden = grid_cell(storey, 2, 2);
  hidden.floor_cover = hidden.ceiling_cover = hidden.any_cover = 0;
  EXPECT_EQ(picture_of(decided({storey}).cells.storeys[0], 5, 5), picture);
}

TEST(Rooms, SmallOnesAndThoseThatNobodySawAreNone) {
  const Picture picture{".....", ".a.bb", ".....", "....."};
  const auto result = decided({scanned(picture)}, {.min_area = 1.5});
  EXPECT_EQ(picture_of(result.cells.storeys[0], 5, 4)[1], "...aa");
  // Walls all around nothing: inside, but not a room.
  StoreyCells empty = scanned({".....", ".aaa.", ".aaa.", "....."}, false, false);
  for (auto& cell : empty.cells) cell.any_cover = 0;
  const auto unseen = decided({empty}, {.outside_weight = 0});
  for (const auto& cell : unseen.cells.storeys[0].cells) EXPECT_EQ(cell.room, -1);
  EXPECT_TRUE(unseen.warnings->mention("no room"));
}

TEST(Rooms, WithoutEvidenceAllIsOutside) {
  const auto result = decided({grid_cells({"aa", "aa"})});
  for (const auto& cell : result.cells.storeys[0].cells) EXPECT_EQ(cell.room, -1);
  EXPECT_TRUE(result.warnings->mention("no room"));
  EXPECT_TRUE(decided({}).warnings->mention("no room"));
}

// Any coverage: rooms hang together, are large enough, and numbers have no gaps.
RC_GTEST_PROP(Rooms, AreAlwaysConnectedAndNumberedByArea, (std::uint32_t seed)) {
  Random random(seed);
  StoreyCells storey = grid_cells(6, 5);
  for (auto& cell : storey.cells) {
    cell.floor_cover = random.uniform();
    cell.ceiling_cover = random.uniform();
    cell.any_cover = random.uniform();
  }
  for (auto& edge : storey.edges) {
    edge.wall_left = std::max(0.0, random.uniform(-1, 1));
    edge.wall_right = std::max(0.0, random.uniform(-1, 1));
  }
  const auto decision = decided({storey}).cells.storeys[0];
  std::map<std::int32_t, double> area;
  std::map<std::int32_t, std::vector<std::size_t>> members;
  for (std::size_t i = 0; i < decision.cells.size(); ++i) {
    const auto room = decision.cells[i].room;
    if (room < 0) continue;
    area[room] += decision.cells[i].area;
    members[room].push_back(i);
  }
  double last = 1e9;
  std::int32_t expected = 0;
  for (const auto& [room, size] : area) {
    RC_ASSERT(room == expected++);
    RC_ASSERT(size <= last + 1e-9);
    RC_ASSERT(size >= 0.8);
    last = size;
    std::vector<std::size_t> reached{members[room][0]};
    std::vector<bool> known(decision.cells.size(), false);
    known[reached[0]] = true;
    for (std::size_t k = 0; k < reached.size(); ++k)
      for (const auto e : decision.cells[reached[k]].edges)
        for (const auto next : {decision.edges[e].left, decision.edges[e].right})
          if (next >= 0 && !known[static_cast<std::size_t>(next)] &&
              decision.cells[static_cast<std::size_t>(next)].room == room) {
            known[static_cast<std::size_t>(next)] = true;
            reached.push_back(static_cast<std::size_t>(next));
          }
    RC_ASSERT(reached.size() == members[room].size());
  }
}

TEST(Rooms, AWallSeenFromOneSidePartsThem) {
  StoreyCells storey = scanned({"aabb", "aabb"});
  EXPECT_EQ(decided({storey}).cells.storeys[0].cells.size(), storey.cells.size());
  const auto rooms = [&](const StoreyCells& s) {
    std::set<std::int32_t> result;
    const auto decision = decided({s});
    for (const auto& cell : decision.cells.storeys[0].cells) result.insert(cell.room);
    return result.size();
  };
  EXPECT_EQ(rooms(storey), 2U);
  for (auto& edge : storey.edges)
    if (edge.left >= 0 && edge.right >= 0 && edge.wall_left > 0 && edge.wall_right > 0) edge.wall_left = 0;
  EXPECT_EQ(rooms(storey), 2U);
  for (auto& edge : storey.edges)
    if (edge.left >= 0 && edge.right >= 0) edge.wall_left = edge.wall_right = 0;
  EXPECT_EQ(rooms(storey), 1U);
}

TEST(Rooms, NichesTooSmallToBeOnesAreEvened) {
  const StoreyCells storey = scanned({"aaaa", "aaaa", "..a."});  // squares of 1 m2
  const auto inside = [&](const Rooms::Params& params) {
    const auto decision = decided({storey}, params);
    return std::count_if(decision.cells.storeys[0].cells.begin(), decision.cells.storeys[0].cells.end(),
                         [](const LayoutCell& cell) { return cell.room >= 0; });
  };
  EXPECT_EQ(inside({}), 9);
  EXPECT_EQ(inside({.min_detail = 1.5}), 8);
}

TEST(Rooms, ARoomEndsBeforeTheBackOfAnotherOnesWall) {
  for (const double cover : {0.0, 0.2, 0.4}) {
    const CellComplex cells = decided({wall_seen_from_one_side(cover)}, {.wall_weight = 0}).cells;
    const StoreyCells& storey = cells.storeys[0];
    std::array<int, 3> rooms{};
    for (const auto& cell : storey.cells) {
      const double x = middle_of(storey, cell).x();
      rooms.at(x < 4 ? 0 : x < 4.12 ? 1 : 2) = cell.room;
    }
    EXPECT_GE(rooms[0], 0) << cover;
    EXPECT_GE(rooms[2], 0) << cover;
    EXPECT_NE(rooms[0], rooms[2]) << cover;
    EXPECT_EQ(rooms[1], -1) << cover;
  }
}

}  // namespace
}  // namespace atrium::layout::rooms_test
