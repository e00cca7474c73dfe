#include "modules/layout/objects.hpp"

#include <gtest/gtest.h>

#include "tests/support/box_building.hpp"

namespace atrium::layout::objects_test {
namespace {

using P = Eigen::Vector3f;

/// The places of those points that belong to objects.
std::vector<P> objects(const std::vector<P>& points, const Objects::Params& params = {},
                       const Building& building = test::BoxBuilding::two_rooms(),
                       const Eigen::Vector3d& origin = Eigen::Vector3d::Zero()) {
  Cloud cloud;
  cloud.origin = origin;
  cloud.points = points;
  for (std::size_t i = 0; i < points.size(); ++i) cloud.labels.push_back(static_cast<std::int32_t>(i));
  PlanePrimitives planes;
  planes.cloud = std::make_shared<const Cloud>(cloud);
  Structure structure;
  structure.primitives = std::make_shared<const PlanePrimitives>(planes);
  Context context;
  const Cloud result = Objects::run({input(building), input(structure)}, params, context).cloud;
  EXPECT_EQ(result.labels.size(), result.points.size()) << "columns are kept";
  EXPECT_EQ(result.origin, origin);
  return result.points;
}
bool is_object(const P& point, const Objects::Params& params = {}) { return !objects({point}, params).empty(); }

TEST(Objects, FacesTakeWhatIsNearThem) {
  EXPECT_TRUE(is_object({2, 1.5, 0.75F}));
  EXPECT_FALSE(is_object({2, 1.5, 0.03F})) << "floor";
  EXPECT_TRUE(is_object({2, 1.5, 0.05F}));
  EXPECT_FALSE(is_object({2, 2.97F, 1})) << "wall";
  EXPECT_FALSE(is_object({2, 1.5, 2.47F})) << "ceiling";
  Objects::Params params;
  params.distance = 0.1;
  EXPECT_FALSE(is_object({2, 1.5, 0.05F}, params));
}

TEST(Objects, WhatIsOutsideOfTheRoomsIsNone) {
  EXPECT_FALSE(is_object({2, 3.3F, 1}));
  EXPECT_FALSE(is_object({2, 1, 2.8F}));
  EXPECT_FALSE(is_object({4.06F, 2.5F, 1})) << "in the wall";
  Objects::Params params;
  params.reach = 0.5;
  EXPECT_TRUE(is_object({2, 3.3F, 1}, params));
  EXPECT_TRUE(is_object({2, 1, 2.8F}, params));
  EXPECT_FALSE(is_object({2, 3.6F, 1}, params));
}

TEST(Objects, RevealsBelongToTheBuilding) {
  Objects::Params params;
  params.reach = 0.5;
  EXPECT_FALSE(is_object({4.06F, 1, 1}, params)) << "in the door";
  EXPECT_FALSE(is_object({4.06F, 0.48F, 1}, params)) << "its jamb";
  EXPECT_FALSE(is_object({1.5F, -0.3F, 1.5F}, params)) << "the window's reveal, whose depth is not known";
  EXPECT_TRUE(is_object({3, -0.3F, 1.5F}, params)) << "beside the window";
  params.reveal_depth = 0.1;
  EXPECT_TRUE(is_object({1.5F, -0.3F, 1.5F}, params));
}

TEST(Objects, TheWayUpLeavesSlantedRooms) {
  test::BoxBuilding b;
  b.room(0, 0, 4, 3);
  // The ceiling falls to 1 m at x = 4.
  for (const std::size_t v : {5U, 6U}) b.building.vertices[v].z() = 1;
  b.building.faces[1].plane.normal = Eigen::Vector3d(-1.5, 0, -4).normalized();
  EXPECT_EQ(objects({{3.5F, 1, 0.8F}}, {}, b.building).size(), 1U);
  EXPECT_TRUE(objects({{3.5F, 1, 1.8F}}, {}, b.building).empty()) << "above the slant, within the room's box";
}

TEST(Objects, OriginsOfPointsAndBuildingMayDiffer) {
  EXPECT_EQ(objects({{-98, 1.5F, 0.75F}}, {}, test::BoxBuilding::two_rooms(), {100, 0, 0}).size(), 1U);
  EXPECT_TRUE(objects({{2, 1.5F, 0.75F}}, {}, test::BoxBuilding::two_rooms(), {100, 0, 0}).empty());
}

TEST(Objects, NothingComesOfNothing) {
  EXPECT_TRUE(objects({}).empty());
  EXPECT_TRUE(objects({{1, 1, 1}}, {}, Building{}).empty());
  Building broken = test::BoxBuilding::two_rooms();
  broken.faces[0].outline[0] = 99;
  EXPECT_THROW(objects({{1, 1, 1}}, {}, broken), Error);
}

}  // namespace
}  // namespace atrium::layout::objects_test
