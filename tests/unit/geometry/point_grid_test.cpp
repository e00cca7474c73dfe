#include "modules/geometry/point_grid.hpp"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <set>

#include "graph/api/error.hpp"
#include "graph/api/random.hpp"

namespace atrium::point_grid_test {
namespace {

std::vector<Eigen::Vector3f> random_points(std::size_t count, double width) {
  Random random(5);
  std::vector<Eigen::Vector3f> points(count);
  for (auto& p : points)
    p = Eigen::Vector3d(random.uniform(-width, width), random.uniform(-width, width), random.uniform(0, 3))
            .cast<float>();
  return points;
}

TEST(PointGrid, EveryPointStandsInItsCellAndCellsByAscendingIndex) {
  const auto points = random_points(20000, 4);
  const PointGrid grid(points, 0.1, Context());
  EXPECT_EQ(grid.inside(), points.size());
  std::vector<bool> seen(points.size(), false);
  std::uint32_t next = 0;
  for (std::size_t c = 0; c < grid.cells().size(); ++c) {
    const auto& cell = grid.cells()[c];
    ASSERT_EQ(cell.begin, next);
    ASSERT_GT(cell.end, cell.begin);
    next = cell.end;
    ASSERT_EQ(grid.find(cell.x, cell.y, cell.z), c);
    ASSERT_EQ(grid.neighbourhood(cell)[13], c);
    for (std::uint32_t i = cell.begin; i < cell.end; ++i) {
      const auto index = grid.order()[i];
      ASSERT_FALSE(seen[index]);
      seen[index] = true;
      ASSERT_EQ(grid.points()[i], points[index]);
      ASSERT_LE((points[index].cast<double>() - grid.centre(cell)).cwiseAbs().maxCoeff(), 0.05 + 1e-6);
      if (i > cell.begin) {
        ASSERT_GT(index, grid.order()[i - 1]);
      }
    }
  }
  EXPECT_EQ(next, points.size());
}

TEST(PointGrid, NeighbourhoodsHoldEveryPointWithinOneCellSize) {
  const auto points = random_points(3000, 1);
  const PointGrid grid(points, 0.2, Context());
  for (std::size_t c = 0; c < grid.cells().size(); c += 7) {
    const auto& cell = grid.cells()[c];
    std::set<std::uint32_t> near;
    for (const auto n : grid.neighbourhood(cell))
      if (n != PointGrid::none)
        for (std::uint32_t i = grid.cells()[n].begin; i < grid.cells()[n].end; ++i) near.insert(grid.order()[i]);
    const Eigen::Vector3f p = grid.points()[cell.begin];
    for (std::uint32_t i = 0; i < points.size(); ++i)
      if ((points[i] - p).norm() <= 0.2F) {
        EXPECT_TRUE(near.contains(i));
      }
  }
}

TEST(PointGrid, CellsNeitherMoveNorMixWhenAWildPointIsAdded) {
  auto points = random_points(5000, 4);
  const PointGrid before(points, 0.1, Context());
  points.emplace_back(1e6F, -1e6F, 1e6F);
  const PointGrid after(points, 0.1, Context());
  EXPECT_EQ(after.inside(), points.size() - 1);
  EXPECT_EQ(after.order().back(), points.size() - 1);
  ASSERT_EQ(before.cells().size(), after.cells().size());
  std::set<std::vector<std::uint32_t>> a, b;
  for (const auto& c : before.cells()) a.emplace(before.order().begin() + c.begin, before.order().begin() + c.end);
  for (const auto& c : after.cells()) b.emplace(after.order().begin() + c.begin, after.order().begin() + c.end);
  EXPECT_EQ(a, b);
}

TEST(PointGrid, FineCellsOverAWideSceneUseLongKeys) {
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 5000; ++i)
    points.emplace_back(static_cast<float>(i), static_cast<float>(-i), static_cast<float>(i));
  const PointGrid grid(points, 0.01, Context());
  EXPECT_EQ(grid.cells().size(), points.size());
  EXPECT_EQ(grid.inside(), points.size());
}

TEST(PointGrid, OnePointDuplicatesAndNone) {
  EXPECT_TRUE(PointGrid({}, 0.1, Context()).cells().empty());
  EXPECT_EQ(PointGrid({}, 0.1, Context()).find(0, 0, 0), PointGrid::none);
  EXPECT_EQ(PointGrid({{5, 5, 5}}, 0.1, Context()).cells().size(), 1U);
  const PointGrid duplicates(std::vector<Eigen::Vector3f>(10000, {1, 2, 3}), 0.1, Context());
  ASSERT_EQ(duplicates.cells().size(), 1U);
  EXPECT_EQ(duplicates.cells()[0].size(), 10000U);
  EXPECT_THROW(PointGrid({{0, 0, 0}}, 0, Context()), Error);
  EXPECT_THROW(PointGrid({{0, 0, 0}}, -1, Context()), Error);
}

TEST(PointGrid, TheOrderDoesNotDependOnThreads) {
  const auto points = random_points(300000, 4);
  std::vector<std::uint32_t> one;
  tbb::task_arena(1).execute([&] { one = PointGrid(points, 0.05, Context()).order(); });
  for (const int threads : {2, 4})
    tbb::task_arena(threads).execute([&] { EXPECT_EQ(PointGrid(points, 0.05, Context()).order(), one); });
}

}  // namespace
}  // namespace atrium::point_grid_test
