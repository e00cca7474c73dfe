#pragma once
#include <bit>
#include <cstdint>
#include <vector>

#include "modules/io/morton_places.hpp"

namespace atrium::io {

/// Finds places among some that are in the order of their Morton numbers: cubes of 4 × 4 × 4 of them in a hash table,
/// each with a bit for each place. 36 to 72 bytes for each cube that holds any.
class VoxelLookup {
 public:
  /// The numbers ascend, each comes once; at most 2³² - 1.
  VoxelLookup(const MortonPlaces& places, const std::vector<std::uint64_t>& numbers);

  /// Calls work(index) for each place that is there of the 27 around and in the middle of one.
  template <class Work>
  void around(const VoxelPlace& place, const Work& work) const {
    const auto first = [&](std::size_t a) { return place[a] > 0 ? place[a] - 1 : 0; };
    for (std::uint32_t z = first(2); z <= place[2] + 1; ++z)
      for (std::uint32_t y = first(1); y <= place[1] + 1; ++y) {
        const Cube* cube = nullptr;
        for (std::uint32_t x = first(0); x <= place[0] + 1; ++x) {
          if (cube == nullptr || (x & 3U) == 0) cube = &cubes_[slot(key_of({x, y, z}))];
          const std::uint64_t bit = bit_of({x, y, z});
          if ((cube->occupied & bit) != 0)
            work(cube->first + static_cast<std::uint32_t>(std::popcount(cube->occupied & (bit - 1))));
        }
      }
  }

 private:
  struct Cube {
    std::uint64_t key = 0, occupied = 0;  // none: the slot is free
    std::uint32_t first = 0;              // index of its first place
  };

  static std::uint64_t key_of(const VoxelPlace& p) {
    return static_cast<std::uint64_t>(p[0] >> 2U) | static_cast<std::uint64_t>(p[1] >> 2U) << 21U |
           static_cast<std::uint64_t>(p[2] >> 2U) << 42U;
  }
  /// In the order of the Morton numbers.
  static std::uint64_t bit_of(const VoxelPlace& p) {
    const std::uint32_t low = (p[0] & 1U) | (p[1] & 1U) << 1U | (p[2] & 1U) << 2U;
    const std::uint32_t high = (p[0] & 2U) << 2U | (p[1] & 2U) << 3U | (p[2] & 2U) << 4U;
    return std::uint64_t{1} << (low | high);
  }
  /// Of a cube, or where it would be.
  std::size_t slot(std::uint64_t key) const {
    const std::size_t mask = cubes_.size() - 1;
    std::size_t at = static_cast<std::size_t>((key * 0x9e3779b97f4a7c15ULL) >> 30U) & mask;
    while (cubes_[at].occupied != 0 && cubes_[at].key != key) at = (at + 1) & mask;
    return at;
  }

  std::vector<Cube> cubes_;  // a power of two long
};

}  // namespace atrium::io
