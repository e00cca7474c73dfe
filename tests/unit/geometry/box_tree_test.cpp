#include "modules/geometry/box_tree.hpp"

#include <gtest/gtest.h>

#include <set>

#include "graph/api/random.hpp"

namespace atrium::box_tree_test {
namespace {

using V = Eigen::Vector3d;

TEST(BoxTree, FindsWhatATestOfEveryBoxFinds) {
  Context context;
  Random random(2);
  for (const int n : {0, 1, 7, 8, 9, 64, 65, 1000}) {
    std::vector<Eigen::AlignedBox3d> boxes;
    for (int i = 0; i < n; ++i) {
      const V low(random.uniform(0, 10), random.uniform(0, 10), i % 4 == 0 ? 3 : random.uniform(0, 10));
      boxes.emplace_back(low, low + V(random.uniform(0, i % 50 == 0 ? 8 : 0.5), 0.2, random.uniform(0, 1)));
    }
    const BoxTree tree(boxes, context);
    for (int i = 0; i < 50; ++i) {
      const V low(random.uniform(-1, 10), random.uniform(-1, 10), random.uniform(-1, 10));
      const Eigen::AlignedBox3d query(low, low + V(1, 1, 0));
      std::multiset<std::uint32_t> found, expected;
      tree.meeting(query, [&](std::uint32_t k) { found.insert(k); });
      for (std::uint32_t k = 0; k < boxes.size(); ++k)
        if (boxes[k].intersects(query)) expected.insert(k);
      ASSERT_EQ(found, expected);
    }
  }
}

TEST(BoxTree, TouchingBoxesMeetAndPlacesMayCoincide) {
  Context context;
  const std::vector<Eigen::AlignedBox3d> boxes(20, Eigen::AlignedBox3d(V(1, 1, 1), V(2, 2, 2)));
  const BoxTree tree(boxes, context);
  int met = 0;
  tree.meeting({V(2, 2, 2), V(3, 3, 3)}, [&](std::uint32_t) { ++met; });
  EXPECT_EQ(met, 20);
}

}  // namespace
}  // namespace atrium::box_tree_test
