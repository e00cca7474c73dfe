#include "modules/plane/plane_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <set>

#include "modules/plane/point_octree.hpp"

namespace atrium::plane::plane_cells_test {
namespace {

/// Clumps of points near the plane z = 0, on both sides of the origin.
std::vector<Eigen::Vector3f> clumps(std::size_t count, float extent) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform(-1, 1);
  std::vector<Eigen::Vector3f> points;
  while (points.size() < count) {
    const Eigen::Vector3f middle(extent * uniform(random), extent * uniform(random), 0);
    for (int i = 0; i < 40; ++i) points.push_back(middle + Eigen::Vector3f(uniform(random), uniform(random), 0));
  }
  return points;
}

/// For each point the first one that it is connected to through steps of at most `reach`.
std::vector<std::size_t> all_pairs(const std::vector<Eigen::Vector3f>& points, float reach) {
  std::vector<std::size_t> label(points.size());
  std::iota(label.begin(), label.end(), std::size_t{0});
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        if ((points[i] - points[j]).norm() > reach || label[i] == label[j]) continue;
        label[i] = label[j] = std::min(label[i], label[j]);
        changed = true;
      }
  }
  return label;
}

TEST(PlaneCells, ComponentsAreThoseOfAllPairsOfPoints) {
  constexpr float reach = 0.3F;
  const std::vector<Eigen::Vector3f> points = clumps(3000, 12);
  PlaneCells cells(Eigen::Vector3d::UnitZ(), reach);
  std::vector<std::uint32_t> cell_of;
  cell_of.reserve(points.size());
  for (const auto& p : points) cell_of.push_back(cells.add(p));
  const std::vector<std::uint32_t> component = cells.components(Context());
  // One sample stands for the points of an eighth of a cell: two of them may be off by a quarter of the reach.
  const std::vector<std::size_t> surely = all_pairs(points, 0.74F * reach);
  const std::vector<std::size_t> at_most = all_pairs(points, 1.001F * reach);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::uint32_t c = component[cell_of[i]];
    EXPECT_EQ(c, component[cell_of[surely[i]]]);
    EXPECT_EQ(component[c], c);
    const auto first = static_cast<std::size_t>(std::find(cell_of.begin(), cell_of.end(), c) - cell_of.begin());
    EXPECT_EQ(at_most[first], at_most[i]);
  }
  EXPECT_GT(std::set<std::uint32_t>(component.begin(), component.end()).size(), 10U);
}

TEST(PlaneCells, DilatedCellsAreTheChosenOnesAndThoseThatTouchThem) {
  PlaneCells cells(Eigen::Vector3d::UnitZ(), std::sqrt(2.0));
  const std::vector<Eigen::Vector3f> points = clumps(400, 40);
  for (const auto& p : points) cells.add(p);
  std::vector<bool> chosen(cells.size());
  for (std::size_t i = 0; i < chosen.size(); ++i) chosen[i] = i % 3 == 0;
  const CellSet set = cells.dilated(chosen);
  for (std::int32_t u = -45; u <= 45; ++u)
    for (std::int32_t v = -45; v <= 45; ++v) {
      bool near = false;
      for (std::uint32_t i = 0; i < chosen.size(); ++i)
        near |= chosen[i] && std::abs(cells.index(i).u - u) <= 1 && std::abs(cells.index(i).v - v) <= 1;
      ASSERT_EQ(set.contains(CellFrame::Index{u, v}), near) << u << ' ' << v;
    }
}

TEST(MortonOrder, IsTheSameOrderWithAFarPointAsWithout) {
  // The far point leaves no room to pack code and index into one number.
  Cloud cloud;
  cloud.points = clumps(6000, 5);
  const MortonOrder near(cloud, 0.01, Context());
  EXPECT_TRUE(std::is_sorted(near.codes.begin(), near.codes.end()));
  for (std::size_t i = 1; i < near.codes.size(); ++i)
    EXPECT_TRUE(near.codes[i - 1] < near.codes[i] || near.index[i - 1] < near.index[i]);
  const auto far_place = static_cast<std::uint32_t>(cloud.points.size());
  cloud.points.emplace_back(9000, 9000, 9000);
  MortonOrder far(cloud, 0.01, Context());
  ASSERT_EQ(far.index.back(), far_place);
  far.index.pop_back();
  far.codes.pop_back();
  ASSERT_EQ((near.centre - far.centre).norm(), 0);
  EXPECT_EQ(near.index, far.index);
  EXPECT_EQ(near.codes, far.codes);
}

}  // namespace
}  // namespace atrium::plane::plane_cells_test
