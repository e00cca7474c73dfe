// Which voxels of a dense scan hold noise.
#include "modules/io/voxel_noise.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace atrium::io::voxel_noise_test {
namespace {

constexpr double share = 0.05;

struct VoxelCount {
  VoxelPlace place{};
  std::uint32_t points = 0;
};

/// In the order of the voxels as they are given.
std::vector<std::uint8_t> noise_of(const std::vector<VoxelCount>& voxels) {
  VoxelCounts counts{MortonPlaces({9, 7, 8}), {}, {}};
  std::map<std::uint64_t, std::size_t> order;
  for (std::size_t i = 0; i < voxels.size(); ++i) order[counts.places.number(voxels[i].place)] = i;
  EXPECT_EQ(order.size(), voxels.size());
  for (const auto& [number, i] : order) {
    counts.numbers.push_back(number);
    counts.points.push_back(voxels[i].points);
  }
  const std::vector<std::uint8_t> sorted = noise_voxels(counts, share, Context());
  EXPECT_EQ(sorted.size(), voxels.size());
  std::vector<std::uint8_t> noise(voxels.size());
  auto next = sorted.begin();
  for (const auto& [number, i] : order) noise[i] = *next++;
  return noise;
}

/// A floor of 60 x 60 voxels at height 10, each with so many points.
std::vector<VoxelCount> floor_of(std::uint32_t points) {
  std::vector<VoxelCount> voxels;
  for (std::uint32_t x = 0; x < 60; ++x)
    for (std::uint32_t y = 0; y < 60; ++y) voxels.push_back({{x, y, 10}, points});
  return voxels;
}

/// Whether this voxel, put beside the others, is noise; none of the others may be.
bool is_noise(std::vector<VoxelCount> voxels, const VoxelCount& last) {
  voxels.push_back(last);
  const std::vector<std::uint8_t> noise = noise_of(voxels);
  EXPECT_EQ(std::count(noise.begin(), noise.end() - 1, 1), 0);
  return noise.back() != 0;
}

TEST(VoxelNoise, WhatTheNoisePutsBesideASurfaceIsLeftOut) {
  EXPECT_TRUE(is_noise(floor_of(100), {{30, 30, 11}, 4}));
  EXPECT_FALSE(is_noise(floor_of(100), {{30, 30, 11}, 5}));
  EXPECT_FALSE(is_noise(floor_of(19), {{30, 30, 11}, 1})) << "of a sparse scan everything counts";
}

TEST(VoxelNoise, StraysInFreeSpaceAreLeftOutAndSparseSurfacesAreNot) {
  EXPECT_TRUE(is_noise(floor_of(20), {{30, 30, 50}, 1}));
  EXPECT_FALSE(is_noise(floor_of(2), {{30, 30, 50}, 1}));
  EXPECT_FALSE(is_noise(floor_of(20), {{30, 30, 200}, 1})) << "far from all else: nothing says how dense it should be";
  auto voxels = floor_of(20);
  for (std::uint32_t x = 20; x < 40; ++x)
    for (std::uint32_t y = 20; y < 40; ++y) voxels.push_back({{x, y, 50}, 3});  // a table that was seen from afar
  EXPECT_FALSE(is_noise(voxels, {{40, 30, 50}, 3}));
}

TEST(VoxelNoise, NothingIsNoNoise) {
  EXPECT_TRUE(noise_of({}).empty());
  EXPECT_EQ(noise_of({{{0, 0, 0}, 1}}), std::vector<std::uint8_t>{0});
}

}  // namespace
}  // namespace atrium::io::voxel_noise_test
