#include "modules/layout/face_mask.hpp"

#include <gtest/gtest.h>

#include "modules/layout/free_space.hpp"

namespace atrium::layout::face_mask_test {
namespace {

using Eigen::AlignedBox2d;
using Eigen::AlignedBox2i;
using Eigen::Vector2d;
using Eigen::Vector2i;
using Eigen::Vector3d;

FaceMask hidden_mask(int width, int height) {
  FaceMask mask({Vector2d(0, 0), Vector2d(0.1 * width, 0.1 * height)}, 0.1);
  mask.fill({Vector2i(0, 0), Vector2i(width - 1, height - 1)}, Square::hidden);
  return mask;
}
AlignedBox2i all(const FaceMask& mask) { return {Vector2i(0, 0), Vector2i(mask.width() - 1, mask.height() - 1)}; }
/// A grid of points over 3 × 3 m, but for a square of 1 m in the middle.
std::vector<Vector2d> frame(double spacing) {
  std::vector<Vector2d> points;
  for (double x = spacing / 2; x < 3; x += spacing)
    for (double y = spacing / 2; y < 3; y += spacing)
      if (x < 1 || x > 2 || y < 1 || y > 2) points.emplace_back(x, y);
  return points;
}

TEST(FaceMask, DensePointsKeepTheEdgesOfAHole) {
  FaceMask mask = hidden_mask(30, 30);
  EXPECT_EQ(mask.cover(frame(0.02), 0.3), 0);
  EXPECT_EQ(mask.count({Vector2i(10, 10), Vector2i(19, 19)}, Square::hidden), 100U);
  EXPECT_EQ(mask.count(all(mask), Square::hidden), 100U);
}

TEST(FaceMask, SparsePointsCloseTheSurfaceAndLeaveTheHole) {
  FaceMask mask = hidden_mask(30, 30);
  const double reach = mask.cover(frame(0.15), 0.3);
  EXPECT_GT(reach, 0.1);
  EXPECT_LE(reach, 0.3);
  const std::size_t left = mask.count(all(mask), Square::hidden);
  EXPECT_EQ(left, mask.count({Vector2i(10, 10), Vector2i(19, 19)}, Square::hidden));
  EXPECT_GE(left, 16U);
}

TEST(FaceMask, ASinglePointCoversItsOwnSquare) {
  FaceMask mask = hidden_mask(30, 30);
  auto points = frame(0.15);
  points.emplace_back(1.55, 1.55);
  FaceMask without = hidden_mask(30, 30);
  without.cover(frame(0.15), 0.3);
  mask.cover(points, 0.3);
  EXPECT_EQ(without.count(all(mask), Square::hidden), mask.count(all(mask), Square::hidden) + 1);
}

TEST(FaceMask, StraysInAHoleCoverTheirOwnSquaresOnly) {
  const auto hidden = [](const std::vector<Vector2d>& strays) {
    FaceMask mask = hidden_mask(30, 30);
    auto points = frame(0.07);  // most points reach one square far
    points.insert(points.end(), strays.begin(), strays.end());
    EXPECT_NEAR(mask.cover(points, 0.4), 0.1, 1e-9);
    return mask.count({Vector2i(10, 10), Vector2i(19, 19)}, Square::hidden);
  };
  // As many in the hole as would be a handful within 0.4 m, but not within 0.1 m.
  const std::vector<Vector2d> strays = {{1.25, 1.25}, {1.55, 1.25}, {1.75, 1.35},
                                        {1.25, 1.65}, {1.55, 1.65}, {1.75, 1.75}};
  EXPECT_EQ(hidden(strays), hidden({}) - strays.size());
}

TEST(FaceMask, TheBestRectangleLeavesOutWhatHangsOnToIt) {
  FaceMask mask = hidden_mask(30, 20);
  mask.fill(all(mask), Square::solid);
  const AlignedBox2i hole(Vector2i(10, 4), Vector2i(19, 15));
  mask.fill(hole, Square::hole);
  mask.fill({Vector2i(4, 4), Vector2i(9, 6)}, Square::hole);
  mask.at(14, 9) = Square::solid;
  ASSERT_EQ(mask.parts().size(), 1U);
  const auto best = mask.best_rectangle(mask.parts()[0], 0);
  ASSERT_TRUE(best);
  EXPECT_EQ(best->min(), hole.min());
  EXPECT_EQ(best->max(), hole.max());
  EXPECT_FALSE(mask.best_rectangle(mask.parts()[0], 120));
}

TEST(FaceMask, NarrowHiddenStripsAreSolid) {
  FaceMask mask = hidden_mask(30, 30);
  mask.fill(all(mask), Square::solid);
  mask.fill({Vector2i(2, 2), Vector2i(3, 27)}, Square::hidden);
  mask.fill({Vector2i(10, 10), Vector2i(19, 19)}, Square::hidden);
  mask.drop_narrow(8);
  EXPECT_EQ(mask.count(all(mask), Square::hidden), 100U);
}

TEST(FaceMask, ErosionTakesWhatIsNearHolesOnly) {
  FaceMask mask = hidden_mask(30, 30);
  mask.fill(all(mask), Square::solid);
  mask.at(15, 15) = Square::hole;
  const FaceMask inner = mask.eroded(0.2);
  EXPECT_EQ(inner.count(all(mask), Square::solid), 900U - 25U);
  EXPECT_EQ(inner.at(0, 0), Square::solid);
}

TEST(FaceMask, PlacesOutsideAreOutside) {
  const FaceMask mask = hidden_mask(5, 5);
  EXPECT_EQ(mask.at(Vector2d(-0.01, 0.2)), Square::outside);
  EXPECT_EQ(mask.at(Vector2d(0.2, 0.51)), Square::outside);
  EXPECT_EQ(mask.at(Vector2d(0.2, 0.2)), Square::hidden);
  const AlignedBox2i squares = mask.squares_in({Vector2d(-1, 0.1), Vector2d(0.3, 9)});
  EXPECT_EQ(squares.min(), Vector2i(0, 1));
  EXPECT_EQ(squares.max(), Vector2i(2, 4));
}

Cloud sheet(double spacing) {
  Cloud cloud;
  for (double y = 0; y <= 2; y += spacing)
    for (double z = 0; z <= 2; z += spacing)
      for (const double x : {0.0, 3.0}) cloud.points.emplace_back(Vector3d(x, y, z).cast<float>());
  return cloud;
}

const Eigen::AlignedBox3d everywhere(Eigen::Vector3d::Constant(-1e6), Eigen::Vector3d::Constant(1e6));

TEST(FreeSpace, SurfacesAreClosedHoweverSparse) {
  for (const double spacing : {0.02, 0.05, 0.1, 0.15}) {
    const Cloud cloud = sheet(spacing);
    const FreeSpace space(cloud, 0.05, everywhere);
    for (double y = 0.3; y < 1.7; y += 0.037) {
      EXPECT_FALSE(space.is_free({-0.5, y, 1}, {0.5, y + 0.1, 1.2})) << spacing << " at " << y;
      EXPECT_TRUE(space.is_free({0.5, y, 1}, {2.5, y + 0.1, 1.2})) << spacing << " at " << y;
    }
  }
}

TEST(FreeSpace, PointsThatAreAloneStopNothing) {
  Cloud cloud = sheet(0.02);
  cloud.points.emplace_back(1.5F, 1.0F, 1.0F);
  const FreeSpace space(cloud, 0.05, everywhere);
  EXPECT_FALSE(space.is_occupied({1.5, 1, 1}));
  EXPECT_TRUE(space.is_free({0.5, 1, 1}, {2.5, 1, 1}));
}

}  // namespace
}  // namespace atrium::layout::face_mask_test
