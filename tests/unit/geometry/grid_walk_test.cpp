#include "modules/geometry/grid_walk.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "graph/api/random.hpp"

namespace atrium::grid_walk_test {
namespace {

std::vector<Eigen::Vector3f> scattered(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Eigen::Vector3f> points;
  for (std::size_t i = 0; i < count; ++i)
    points.emplace_back(random.uniform(-3, 5), random.uniform(-2, 2), random.uniform(0, 3));
  return points;
}

/// The occupied cells along a ray by steps of a thousandth of a cell; those it only grazes may be missing.
std::vector<std::uint32_t> by_steps(const PointGrid& grid, const Eigen::Vector3d& from,
                                    const Eigen::Vector3d& direction, double range) {
  std::vector<std::uint32_t> cells;
  const auto start = grid.place(from);
  const double step = grid.cell_size() / 1000;
  for (double t = 0; t < range; t += step) {
    const auto at = grid.place(from + t * direction);
    if (at == start) continue;
    const auto cell =
        grid.find(static_cast<std::int32_t>(at[0]), static_cast<std::int32_t>(at[1]), static_cast<std::int32_t>(at[2]));
    if (cell != PointGrid::none && (cells.empty() || cells.back() != cell)) cells.push_back(cell);
  }
  return cells;
}

TEST(GridWalk, VisitsTheCellsAlongARayInTheirOrder) {
  const Context context;
  for (const std::size_t count : {300U, 3000U}) {
    const PointGrid grid(scattered(count, count), 0.1, context);
    Random random(7);
    std::size_t met = 0;
    for (int ray = 0; ray < 200; ++ray) {
      const Eigen::Vector3d from(random.uniform(-4, 6), random.uniform(-3, 3), random.uniform(-1, 4));
      const Eigen::Vector3d direction =
          Eigen::Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)).normalized();
      std::vector<std::uint32_t> visited;
      double before = 0;
      EXPECT_FALSE(walk(grid, from, direction, 6, [&](std::uint32_t cell, double length) {
        EXPECT_GE(length, before);
        EXPECT_LT((grid.centre(grid.cells()[cell]) - from - length * direction).cwiseAbs().maxCoeff(), 0.0501);
        before = length;
        visited.push_back(cell);
        return false;
      }));
      const auto expected = by_steps(grid, from, direction, 6);
      EXPECT_TRUE(std::includes(visited.begin(), visited.end(), expected.begin(), expected.end(),
                                [&](auto a, auto b) {
                                  return std::find(visited.begin(), visited.end(), a) <
                                         std::find(visited.begin(), visited.end(), b);
                                }))
          << "ray " << ray;
      EXPECT_LE(visited.size(), expected.size() + 1);
      met += visited.size();
    }
    EXPECT_GT(met, 5U);
  }
}

TEST(GridWalk, EndsWhereTheVisitorSaysSo) {
  const PointGrid grid({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, 0.1, Context{});
  int visits = 0;
  EXPECT_TRUE(walk(grid, {0.05, 0.05, 0.05}, {1, 0, 0}, 10, [&](std::uint32_t, double length) {
    EXPECT_NEAR(length, 0.95, 1e-6);
    ++visits;
    return true;
  }));
  EXPECT_EQ(visits, 1);
  EXPECT_FALSE(walk(grid, {0.05, 0.05, 0.05}, {1, 0, 0}, 0.9, [](std::uint32_t, double) { return true; }));
  EXPECT_FALSE(walk(grid, {0.05, 0.05, 0.05}, {0, 1, 0}, 10, [](std::uint32_t, double) { return true; }));
}

TEST(GridWalk, GridForRaysGrowsItsCellsInSparseScans) {
  const Context context;
  EXPECT_DOUBLE_EQ(grid_for_rays(scattered(200, 1), 0.05, context)->cell_size(), 0.4);
  std::vector<Eigen::Vector3f> dense;
  for (int i = 0; i < 1000; ++i) dense.emplace_back(0.01F * static_cast<float>(i), 0.0F, 0.0F);
  EXPECT_DOUBLE_EQ(grid_for_rays(dense, 0.05, context)->cell_size(), 0.05);
}

}  // namespace
}  // namespace atrium::grid_walk_test
