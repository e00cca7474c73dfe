#include "modules/io/voxel_lookup.hpp"

namespace atrium::io {

VoxelLookup::VoxelLookup(const MortonPlaces& places, const std::vector<std::uint64_t>& numbers) {
  const unsigned within = places.left_out(2);  // bits
  std::size_t cubes = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    cubes += i == 0 || numbers[i] >> within != numbers[i - 1] >> within ? 1 : 0;
  cubes_.resize(std::bit_ceil(cubes + cubes / 2 + 1));
  for (std::size_t i = 0; i < numbers.size();) {
    const std::uint64_t number = numbers[i] >> within;
    Cube cube{key_of(places.place(numbers[i])), 0, static_cast<std::uint32_t>(i)};
    for (; i < numbers.size() && numbers[i] >> within == number; ++i) cube.occupied |= bit_of(places.place(numbers[i]));
    cubes_[slot(cube.key)] = cube;
  }
}

}  // namespace atrium::io
