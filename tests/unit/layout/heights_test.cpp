#include "modules/layout/heights.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <set>

#include "graph/api/context.hpp"
#include "tests/unit/layout/cells.hpp"

namespace atrium::layout::heights_test {
namespace {

using namespace atrium::test;

StoreyCells settled(const StoreyCells& storey, const Heights::Params& params = {}, double noise = 0) {
  Context context;
  CellComplex cells;
  cells.noise = noise;
  cells.storeys.push_back(storey);
  return Heights::run({input(cells)}, params, context).cells.storeys[0];
}

/// Whether each of sixteen squares under a ceiling at 2.5 m, of which half was seen on the left, gets that one where a
/// lower one was seen over `share` of the right half.
bool is_one_ceiling(double share) {
  StoreyCells storey = grid_cells({"aaaa", "aaaa", "aaaa", "aaaa"});
  storey.ceilings.push_back(level(1.9, false));
  for (auto& cell : storey.cells) {
    const bool left = middle_of(storey, cell).x() < 2;
    cell.ceilings = {{left ? 0 : 1, left ? 0.9 : share}};
  }
  const StoreyCells result = settled(storey);
  return std::all_of(result.cells.begin(), result.cells.end(),
                     [](const LayoutCell& cell) { return cell.ceiling == 0; });
}

TEST(Heights, UndersidesOfBeamsAreNoCeilingBesideOneThatShowsTwiceAsMuch) {
  EXPECT_TRUE(is_one_ceiling(0.35));
  EXPECT_FALSE(is_one_ceiling(0.5));
}

/// What a choice of floors costs: the area over which another one was seen, less where that is near, and steps.
class FloorEnergy {
 public:
  FloorEnergy(const StoreyCells& storey, const Heights::Params& params) : storey_(storey), params_(params) {}

  double data(std::size_t cell, std::size_t floor) const {
    const LayoutCell& c = storey_.cells[cell];
    double sum = 0;
    const Eigen::Vector2d p = storey_.vertices[c.corners[0]];  // level floors only
    for (const auto& cover : c.floors) {
      const auto& seen = storey_.floors[static_cast<std::size_t>(cover.surface)];
      const double off = std::abs(seen.height_at(p) - storey_.floors[floor].height_at(p));
      if (static_cast<std::size_t>(cover.surface) != floor) sum += c.area * cover.share * std::min(1.0, off / 0.5);
    }
    return sum + (storey_.floors[floor].primitive < 0 ? 0.01 * c.area : 0);
  }
  double operator()(const std::vector<std::size_t>& floors) const {
    double sum = 0;
    for (std::size_t i = 0; i < floors.size(); ++i)
      if (storey_.cells[i].room >= 0) sum += data(i, floors[i]);
    for (const auto& edge : storey_.edges) {
      if (edge.left < 0 || edge.right < 0) continue;
      const auto l = static_cast<std::size_t>(edge.left), r = static_cast<std::size_t>(edge.right);
      if (storey_.cells[l].room < 0 || storey_.cells[l].room != storey_.cells[r].room || floors[l] == floors[r])
        continue;
      sum += step(edge, floors[l], floors[r]);
    }
    return sum;
  }

 private:
  /// Level floors only.
  double step(const CellEdge& edge, std::size_t a, std::size_t b) const {
    const auto& p = storey_.vertices[edge.from];
    const double height = std::abs(storey_.floors[a].height_at(p) - storey_.floors[b].height_at(p));
    const bool wall = edge.line >= 0 && !storey_.lines[static_cast<std::size_t>(edge.line)].primitives.empty();
    return (storey_.vertices[edge.to] - p).norm() *
           (params_.step_weight * (wall ? 0.5 : 1) * height + params_.border_weight);
  }

  const StoreyCells& storey_;
  const Heights::Params& params_;
};

std::vector<std::size_t> floors_of(const StoreyCells& storey) {
  std::vector<std::size_t> result;
  for (const auto& cell : storey.cells) result.push_back(static_cast<std::size_t>(std::max(0, cell.floor)));
  return result;
}
double least_energy(const StoreyCells& storey, const FloorEnergy& energy) {
  double best = 1e300;
  std::vector<std::size_t> floors(storey.cells.size(), 0);
  for (bool more = true; more;) {
    best = std::min(best, energy(floors));
    more = false;
    for (std::size_t i = 0; i < floors.size() && !more; ++i) {
      more = ++floors[i] < storey.floors.size();
      if (!more) floors[i] = 0;
    }
  }
  return best;
}

/// Eight cells of a room, each of which saw a little of each of the floors.
StoreyCells random_floors(Random& random, std::size_t floors) {
  StoreyCells storey = grid_cells({"aaaa", "aaaa"});
  storey.floors.clear();
  for (std::size_t f = 0; f < floors; ++f) storey.floors.push_back(level(random.uniform(0, 0.5), true));
  if (random.uniform() < 0.3) storey.floors.back().primitive = -1;
  for (auto& line : storey.lines)
    if (random.uniform() < 0.3) line.primitives.push_back(0);
  for (auto& cell : storey.cells)
    for (std::size_t f = 0; f < floors; ++f)
      if (random.uniform() < 0.6)
        cell.floors.push_back(
            {static_cast<std::int32_t>(f), random.uniform(0, random.uniform()) / static_cast<double>(floors)});
  return storey;
}

RC_GTEST_PROP(Heights, TwoFloorsAreTheBestChoice, (std::uint32_t seed)) {
  Random random(seed);
  const Heights::Params params{
      .step_weight = random.uniform(0, 2), .border_weight = random.uniform(0, 0.2), .min_patch = 0};
  const StoreyCells storey = random_floors(random, 2);
  const FloorEnergy energy(storey, params);
  RC_ASSERT(energy(floors_of(settled(storey, params))) <= least_energy(storey, energy) + 1e-9);
}

// Of more labels α-expansion finds a choice that no expansion betters, at most twice as dear as the best where steps
// are a metric (Boykov, Veksler and Zabih 2001), and none dearer than what it begins with.
RC_GTEST_PROP(Heights, MoreFloorsAreNearlyTheBestChoice, (std::uint32_t seed)) {
  Random random(seed);
  const Heights::Params params{
      .step_weight = random.uniform(0, 2), .border_weight = random.uniform(0, 0.2), .min_patch = 0};
  const StoreyCells storey = random_floors(random, 3);
  const FloorEnergy energy(storey, params);
  const auto found = floors_of(settled(storey, params));
  const double cost = energy(found);
  RC_ASSERT(cost <= 2 * least_energy(storey, energy) + 1e-9);
  std::vector<std::size_t> begin;
  for (std::size_t i = 0; i < storey.cells.size(); ++i) {
    std::size_t best = 0;
    for (std::size_t f = 1; f < 3; ++f)
      if (energy.data(i, f) < energy.data(i, best)) best = f;
    begin.push_back(best);
  }
  RC_ASSERT(cost <= energy(begin) + 1e-9);
  for (std::size_t alpha = 0; alpha < 3; ++alpha)
    for (std::size_t bits = 0; bits < (std::size_t{1} << storey.cells.size()); ++bits) {
      auto other = found;
      for (std::size_t i = 0; i < other.size(); ++i)
        if (((bits >> i) & 1U) != 0) other[i] = alpha;
      RC_ASSERT(energy(other) >= cost - 1e-9);
    }
}

TEST(Heights, WhatWasNotSeenTakesItsNeighboursFloor) {
  StoreyCells storey = grid_cells({"aaaa"});
  storey.floors.push_back(level(0.3, true));
  grid_cell(storey, 0, 0).floors = {{1, 1}};
  grid_cell(storey, 1, 0).floors = {{1, 0.9}};
  const auto result = settled(storey);
  for (const auto& cell : result.cells) {
    EXPECT_EQ(cell.floor, 1);
    EXPECT_EQ(cell.ceiling, 0);
  }
}

TEST(Heights, AStepStaysWhereItWasSeen) {
  StoreyCells storey = grid_cells({"aaaa", "aaaa"});
  storey.floors.push_back(level(0.3, true));
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 2; ++y) grid_cell(storey, x, y).floors = {{x < 2 ? 0 : 1, 1}};
  auto result = settled(storey);
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 2; ++y) EXPECT_EQ(grid_cell(result, x, y).floor, x < 2 ? 0 : 1);
}

TEST(Heights, RoomsDoNotTellEachOtherTheirHeights) {
  StoreyCells storey = grid_cells({"aab."});
  storey.floors.push_back(level(0.3, true));
  grid_cell(storey, 0, 0).floors = {{1, 1}};
  auto result = settled(storey);
  EXPECT_EQ(grid_cell(result, 1, 0).floor, 1);
  EXPECT_EQ(grid_cell(result, 2, 0).floor, 0);
  EXPECT_EQ(grid_cell(result, 3, 0).floor, -1);  // outside
  EXPECT_EQ(grid_cell(result, 3, 0).ceiling, -1);
}

TEST(Heights, ACeilingIsAboveTheFloorWhereThereIsAChoice) {
  StoreyCells storey = grid_cells({"aa"});
  storey.ceilings.push_back(level(0.2, false));  // a lowered one that belongs to another room
  grid_cell(storey, 0, 0).ceilings = {{1, 0.4}};
  for (const auto& cell : settled(storey).cells) EXPECT_EQ(cell.ceiling, 0);
  // Without a choice it stays.
  storey.ceilings = {level(0.2, false)};
  grid_cell(storey, 0, 0).ceilings.clear();
  for (const auto& cell : settled(storey).cells) EXPECT_EQ(cell.ceiling, 0);
}

TEST(Heights, WhatTheNoisePartsIsOne) {
  StoreyCells storey = grid_cells({"aaaa", "aaaa"});
  storey.floors.push_back(level(0.12, true));
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 2; ++y) grid_cell(storey, x, y).floors = {{x < 2 ? 0 : 1, 1}};
  const auto count = [](const StoreyCells& result) {
    std::set<std::int32_t> floors;
    for (const auto& cell : result.cells) floors.insert(cell.floor);
    return floors.size();
  };
  EXPECT_EQ(count(settled(storey)), 2U);
  EXPECT_EQ(count(settled(storey, {}, 0.05)), 1U);
}

TEST(Heights, APartThatHardlyShowsItsSurfaceTakesTheOneBesideIt) {
  StoreyCells storey = grid_cells({"aaaa"});
  storey.ceilings.push_back(level(1.5, false));
  for (int x = 0; x < 3; ++x) grid_cell(storey, x, 0).ceilings = {{0, 1}};
  grid_cell(storey, 3, 0).ceilings = {{1, 0.4}};
  const Heights::Params free{.step_weight = 0, .border_weight = 0};
  auto kept = settled(storey, {.step_weight = 0, .border_weight = 0, .min_patch = 0});
  EXPECT_EQ(grid_cell(kept, 3, 0).ceiling, 1);
  auto result = settled(storey, free);
  EXPECT_EQ(grid_cell(result, 3, 0).ceiling, 0);
  grid_cell(storey, 3, 0).ceilings = {{1, 0.6}};
  result = settled(storey, free);
  EXPECT_EQ(grid_cell(result, 3, 0).ceiling, 1);
}

TEST(Heights, WithoutRoomsNothingIsDecided) {
  StoreyCells storey = grid_cells({"..", ".."});
  for (const auto& cell : settled(storey).cells) EXPECT_EQ(cell.floor, -1);
  Context context;
  EXPECT_TRUE(Heights::run({input(CellComplex{})}, {}, context).cells.storeys.empty());
}

}  // namespace
}  // namespace atrium::layout::heights_test
