#include "modules/geometry/upright_view.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace atrium::upright_view_test {
namespace {

using Eigen::Vector3f;
using Kind = UprightView::Kind;

/// Pieces of 5 cm on rectangles.
struct Scan {
  SurfacePieces pieces{{}, 0.05};
  Scan& add(const Vector3f& corner, const Vector3f& a, const Vector3f& b, const Vector3f& normal) {
    const int na = static_cast<int>(a.norm() / 0.05F), nb = static_cast<int>(b.norm() / 0.05F);
    for (int i = 0; i < na; ++i)
      for (int j = 0; j < nb; ++j)
        pieces.pieces.push_back({corner + a * ((static_cast<float>(i) + 0.5F) / static_cast<float>(na)) +
                                     b * ((static_cast<float>(j) + 0.5F) / static_cast<float>(nb)),
                                 normal});
    return *this;
  }
  Scan& level(float x, float y, float wide, float deep, float z) {
    return add({x, y, z}, {wide, 0, 0}, {0, deep, 0}, Vector3f::UnitZ());
  }
  /// Four walls of 3.4 × 3.2 m, 2.4 m high, and their ceiling.
  Scan& room() {
    add({0, 0, 0}, {3.4F, 0, 0}, {0, 0, 2.4F}, Vector3f::UnitY());
    add({0, 3.2F, 0}, {3.4F, 0, 0}, {0, 0, 2.4F}, Vector3f::UnitY());
    add({0, 0, 0}, {0, 3.2F, 0}, {0, 0, 2.4F}, Vector3f::UnitX());
    add({3.4F, 0, 0}, {0, 3.2F, 0}, {0, 0, 2.4F}, Vector3f::UnitX());
    return level(0, 0, 3.4F, 3.2F, 2.4F);
  }
};

std::vector<double> heights(const UprightView& view) {
  std::vector<double> result;
  for (const auto& level : view.levels()) result.push_back(std::round(level.height * 100) / 100);
  return result;
}

TEST(UprightView, AFloorThatFurnitureHidesIsOne) {
  Scan scan;
  scan.room().level(1.5F, 0, 0.5F, 2, 0);
  const UprightView view(scan.pieces, Eigen::Vector3d::UnitZ(), 1);
  EXPECT_EQ(heights(view), (std::vector<double>{0, 2.4}));
  EXPECT_TRUE(view.levels()[0].hidden);
  EXPECT_FALSE(view.levels()[1].hidden);
  // The walls say where it goes on.
  for (const auto& item : view.items())
    if (item.kind == Kind::wall && item.height > 1 && item.height < 2) {
      const auto* below = view.below(item.block, item.height);
      ASSERT_NE(below, nullptr);
      EXPECT_NEAR(below->height, 0, 0.01);
    }
}

TEST(UprightView, WhereWallsEndWithoutAFloorThereIsNone) {
  Scan scan;
  scan.room();
  const UprightView view(scan.pieces, Eigen::Vector3d::UnitZ(), 1);
  EXPECT_EQ(heights(view), (std::vector<double>{2.4}));
}

TEST(UprightView, ABedIsNoFloorHoweverSmallTheRoom) {
  Scan scan;
  scan.room().level(0, 0, 1.4F, 3.2F, 0).level(1.4F, 0, 2, 2.1F, 0.5F).level(1.4F, 2.1F, 2, 1.1F, 0);
  const UprightView view(scan.pieces, Eigen::Vector3d::UnitZ(), 1);
  for (const auto& item : view.items()) {
    if (item.kind != Kind::level) continue;
    EXPECT_TRUE(item.large) << item.height;  // it is a level of much area
    EXPECT_EQ(item.main, item.height < 0.1F || item.height > 2.3F) << item.height;
  }
}

TEST(UprightView, PiecesOnNoPlaneAreRough) {
  Scan scan;
  scan.room().add({1, 1, 1}, {1, 0, 0}, {0, 0.7F, 0.7F}, Vector3f(0, -1, 1).normalized());
  scan.pieces.pieces.push_back({{1, 1, 0.5F}, Vector3f::Zero()});
  const UprightView view(scan.pieces, Eigen::Vector3d::UnitZ(), 1);
  std::size_t rough = 0, slope = 0;
  for (const auto& item : view.items()) {
    rough += item.kind == Kind::rough ? 1 : 0;
    slope += item.kind == Kind::other ? 1 : 0;
  }
  EXPECT_EQ(rough, 1U);
  EXPECT_EQ(slope, 20U * 19U);
}

}  // namespace
}  // namespace atrium::upright_view_test
