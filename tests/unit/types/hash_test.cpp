#include <gtest/gtest.h>

#include "graph/api/plugin.hpp"
#include "modules/types/adjacency.hpp"
#include "modules/types/ground_truth.hpp"
#include "modules/types/metrics.hpp"
#include "modules/types/plane_meshes.hpp"

namespace atrium::hash_test {
namespace {

TEST(ContentHash, DependsOnEveryColumnAndOnNothingElse) {
  Cloud a;
  a.points = {{1, 2, 3}, {4, 5, 6}};
  Cloud b = a;
  EXPECT_EQ(content_hash(a), content_hash(b));
  b.labels = {1, 2};
  EXPECT_NE(content_hash(a), content_hash(b));
  b = a;
  b.origin.x() = 1e-9;
  EXPECT_NE(content_hash(a), content_hash(b));
}

TEST(ContentHash, FollowsSharedPointersButDoesNotCountTheirBytes) {
  Cloud cloud;
  cloud.points.resize(1000, Eigen::Vector3f::Zero());
  PlanePrimitives empty;
  PlanePrimitives full;
  full.cloud = std::make_shared<const Cloud>(cloud);
  EXPECT_NE(content_hash(empty), content_hash(full));
  EXPECT_EQ(byte_size(empty), byte_size(full));
  EXPECT_GE(byte_size(cloud), 12000U);
}

TEST(ContentHash, OfAnAdjacencyDoesNotDependOnTheOrderOfInsertion) {
  Adjacency a(3);
  Adjacency b(3);
  a.connect(0, 1, 0.1);
  a.connect(1, 2, 0.2);
  b.connect(2, 1, 0.2);
  b.connect(0, 1, 0.1);
  EXPECT_EQ(content_hash(a), content_hash(b));
  EXPECT_EQ(a.neighbours(1), (std::vector<std::size_t>{0, 2}));
}

TEST(ContentHash, EveryPortTypeIsHashable) {
  EXPECT_EQ(content_hash(GroundTruth{}).size(), 32U);
  EXPECT_EQ(content_hash(PlaneMeshes{}).size(), 32U);
  EXPECT_EQ(content_hash(Metrics{}).size(), 32U);
  EXPECT_EQ(content_hash(Structure{}).size(), 32U);
  EXPECT_EQ(content_hash(Transform{}).size(), 32U);
}

}  // namespace
}  // namespace atrium::hash_test
