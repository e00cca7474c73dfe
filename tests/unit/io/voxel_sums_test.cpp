// What thinning is made of: sums of voxels, their places as numbers, what is around them.
#include "modules/io/voxel_sums.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "graph/api/random.hpp"
#include "modules/io/voxel_lookup.hpp"

namespace atrium::io::voxel_sums_test {
namespace {

TEST(KeyTable, NumbersKeysInTheOrderInWhichTheyCome) {
  KeyTable table;
  std::map<std::uint64_t, std::uint32_t> expected;
  Random random(3);
  for (int i = 0; i < 20'000; ++i) {
    const std::uint64_t key = random.index(7000) << 21U;
    const auto next = static_cast<std::uint32_t>(expected.size());
    EXPECT_EQ(table.add(key), expected.try_emplace(key, next).first->second);
  }
  ASSERT_EQ(table.size(), expected.size());
  for (const auto& [key, number] : expected) EXPECT_EQ(table.key(number), key);
}

TEST(VoxelSums, TakesTheMostFrequentLabelAndOfEqualsTheLowest) {
  const auto label_of = [](const std::vector<std::int32_t>& labels) {
    Cloud cloud;
    cloud.points.assign(labels.size(), {1, 2, 3});
    cloud.labels = labels;
    VoxelSums sums;
    sums.add(8, Cloud{.points = {{0, 0, 0}}, .labels = {-5}}, 0);  // another voxel
    for (std::size_t i = 0; i < labels.size(); ++i) sums.add(7, cloud, i);
    sums.close();
    EXPECT_EQ(sums.label(0), -5);
    return sums.label(1);
  };
  EXPECT_EQ(label_of({4}), 4);
  EXPECT_EQ(label_of({4, 2, 2}), 2);
  EXPECT_EQ(label_of({4, 2, 2, 4}), 2);
  EXPECT_EQ(label_of({2, 4, 4, 2}), 2);
  EXPECT_EQ(label_of({0, -1, -1, 0, 3}), -1);
  EXPECT_EQ(label_of({9, 3, -7, 3, -7}), -7);
}

/// 2²⁴ · 1.02 white points: their sum needs more than 32 bits.
TEST(VoxelSums, ColoursOfVoxelsWithVeryManyPointsAreRight) {
  Cloud cloud;
  cloud.points = {{1, 2, 3}, {1, 2, 3}};
  cloud.colours = {{255, 254, 0}, {255, 254, 1}};
  VoxelSums sums;
  for (int i = 0; i < 17'112'760; ++i) sums.add(1, cloud, static_cast<std::size_t>(i % 8 == 0 ? 1 : 0));
  EXPECT_EQ(sums.colour(0), (Colour{255, 254, 0}));
  EXPECT_EQ(sums.points(0), 17'112'760U);
}

TEST(VoxelLookup, FindsWhatIsAroundAPlace) {
  Random random(5);
  // Also axes with less bits than a cube of the table.
  for (const std::array<unsigned, 3> bits : {std::array{5U, 4U, 6U}, std::array{0U, 7U, 3U}, std::array{1U, 1U, 9U}}) {
    const MortonPlaces places(bits);
    std::set<std::uint64_t> some;
    for (int i = 0; i < 900; ++i) {
      const VoxelPlace place{static_cast<std::uint32_t>(random.index(1U << bits[0])),
                             static_cast<std::uint32_t>(random.index(1U << bits[1])),
                             static_cast<std::uint32_t>(random.index(1U << bits[2]))};
      EXPECT_EQ(places.place(places.number(place)), place);
      some.insert(places.number(place));
    }
    const std::vector<std::uint64_t> numbers(some.begin(), some.end());
    const VoxelLookup lookup(places, numbers);
    for (const auto number : numbers) {
      const VoxelPlace middle = places.place(number);
      std::set<std::uint32_t> found, expected;
      lookup.around(middle, [&](std::uint32_t i) { EXPECT_TRUE(found.insert(i).second); });
      for (std::uint32_t i = 0; i < numbers.size(); ++i) {
        const VoxelPlace place = places.place(numbers[i]);
        const auto near = [&](std::size_t a) { return place[a] + 1 >= middle[a] && place[a] <= middle[a] + 1; };
        if (near(0) && near(1) && near(2)) expected.insert(i);
      }
      ASSERT_EQ(found, expected);
    }
  }
}

TEST(MortonPlaces, CubesAreRunsOfNumbers) {
  const MortonPlaces places({3, 1, 4});
  const MortonPlaces cubes = places.cubes(2);
  for (std::uint64_t number = 0; number < 256; ++number) {
    const VoxelPlace place = places.place(number);
    EXPECT_EQ(number >> places.left_out(2), cubes.number({place[0] >> 2U, place[1] >> 2U, place[2] >> 2U}));
  }
}

}  // namespace
}  // namespace atrium::io::voxel_sums_test
