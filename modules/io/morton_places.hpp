#pragma once
#include <algorithm>
#include <array>
#include <cstdint>

namespace atrium::io {

/// A place along each axis, counted from the lowest.
using VoxelPlace = std::array<std::uint32_t, 3>;

/// Places as numbers that interleave the bits of the axes, as PointGrid does: bits that no place has are left out. What
/// is together in a cube of 2ⁿ places is together in the numbers' order.
class MortonPlaces {
 public:
  /// `bits`: how many each axis has, at most 21.
  explicit MortonPlaces(const std::array<unsigned, 3>& bits) : bits_(bits) {}

  std::uint64_t number(const VoxelPlace& place) const {
    std::uint64_t number = 0;
    unsigned next = 0;
    for (unsigned bit = 0; bit < most_bits(); ++bit)
      for (unsigned a = 0; a < 3; ++a)
        if (bit < bits_[a]) number |= static_cast<std::uint64_t>(place[a] >> bit & 1U) << next++;
    return number;
  }
  VoxelPlace place(std::uint64_t number) const {
    VoxelPlace place{};
    for (unsigned bit = 0; bit < most_bits(); ++bit)
      for (unsigned a = 0; a < 3; ++a) {
        if (bit >= bits_[a]) continue;
        place[a] |= static_cast<std::uint32_t>(number & 1U) << bit;
        number >>= 1U;
      }
    return place;
  }
  /// Of cubes of 2ⁿ places: their numbers are those of their places without the lowest left_out(n) bits.
  MortonPlaces cubes(unsigned n) const {
    auto bits = bits_;
    for (unsigned& b : bits) b -= std::min(b, n);
    return MortonPlaces(bits);
  }
  unsigned left_out(unsigned n) const { return std::min(bits_[0], n) + std::min(bits_[1], n) + std::min(bits_[2], n); }

 private:
  unsigned most_bits() const { return std::max({bits_[0], bits_[1], bits_[2]}); }

  std::array<unsigned, 3> bits_;
};

}  // namespace atrium::io
