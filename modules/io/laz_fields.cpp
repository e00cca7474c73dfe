#include "modules/io/laz_fields.hpp"

#include <algorithm>

namespace atrium::io {
namespace {

// Rows: number of returns; columns: return. Combinations that make no sense have contexts as well.
constexpr std::uint8_t return_map[8][8] = {{15, 14, 13, 12, 11, 10, 9, 8},  {14, 0, 1, 3, 6, 10, 10, 9},
                                           {13, 1, 2, 4, 7, 11, 11, 10},    {12, 3, 4, 5, 8, 12, 12, 11},
                                           {11, 6, 7, 8, 9, 13, 13, 12},    {10, 10, 11, 12, 13, 14, 14, 13},
                                           {9, 10, 11, 12, 13, 14, 15, 14}, {8, 9, 10, 11, 12, 13, 14, 15}};

constexpr std::uint8_t return_map_6[16][16] = {
    {0, 1, 2, 3, 4, 5, 3, 4, 4, 5, 5, 5, 5, 5, 5, 5}, {1, 0, 1, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3},
    {2, 1, 2, 4, 4, 4, 4, 4, 4, 4, 4, 3, 3, 3, 3, 3}, {3, 3, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4},
    {4, 3, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4}, {5, 3, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4},
    {3, 3, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4}, {4, 3, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4},
    {4, 3, 4, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4}, {5, 3, 4, 4, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4},
    {5, 3, 4, 4, 4, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4}, {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 4, 4, 4},
    {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5, 4, 4}, {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5, 4},
    {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5}, {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5}};

int byte_of(std::uint16_t value, unsigned half) { return (value >> (8 * half)) & 0xFF; }

}  // namespace

void LazMedian::add(std::int32_t v) {
  // The middle one leaves the place for v on its side; the outermost there is dropped.
  auto& s = sorted_;
  if (high_) {
    if (v < s[2]) {
      s[4] = s[3];
      s[3] = s[2];
      if (v < s[0]) {
        s[2] = s[1];
        s[1] = s[0];
        s[0] = v;
      } else if (v < s[1]) {
        s[2] = s[1];
        s[1] = v;
      } else {
        s[2] = v;
      }
    } else {
      s[4] = v < s[3] ? s[3] : v;
      if (v < s[3]) s[3] = v;
      high_ = false;
    }
  } else if (s[2] < v) {
    s[0] = s[1];
    s[1] = s[2];
    if (s[4] < v) {
      s[2] = s[3];
      s[3] = s[4];
      s[4] = v;
    } else if (s[3] < v) {
      s[2] = s[3];
      s[3] = v;
    } else {
      s[2] = v;
    }
  } else {
    s[0] = s[1] < v ? s[1] : v;
    if (s[1] < v) s[1] = v;
    high_ = true;
  }
}

std::uint8_t laz_return_map(unsigned n, unsigned r) { return return_map[n & 7U][r & 7U]; }
std::uint8_t laz_return_map_6(unsigned n, unsigned r) { return return_map_6[n & 15U][r & 15U]; }

void LazColours::decode(LazDecoder& decoder, std::array<std::uint16_t, 3>& last) {
  const std::uint32_t changes = decoder.symbol(changes_);
  const std::array<std::uint16_t, 3> before = last;
  int bytes[3][2] = {};
  const auto corrected = [&](std::size_t channel, unsigned half, int predicted) {
    const std::size_t which = 2 * channel + half;
    if ((changes >> which & 1U) == 0) return byte_of(before[channel], half);
    return static_cast<int>((static_cast<std::uint32_t>(predicted) + decoder.symbol(bytes_[which])) & 0xFFU);
  };
  for (unsigned half = 0; half < 2; ++half) bytes[0][half] = corrected(0, half, byte_of(before[0], half));
  if ((changes & 64U) == 0) {  // grey
    for (unsigned half = 0; half < 2; ++half) bytes[1][half] = bytes[2][half] = bytes[0][half];
  } else {
    for (unsigned half = 0; half < 2; ++half) {
      int more = bytes[0][half] - byte_of(before[0], half);
      bytes[1][half] = corrected(1, half, std::clamp(more + byte_of(before[1], half), 0, 255));
      more = (more + bytes[1][half] - byte_of(before[1], half)) / 2;
      bytes[2][half] = corrected(2, half, std::clamp(more + byte_of(before[2], half), 0, 255));
    }
  }
  for (std::size_t c = 0; c < 3; ++c) last[c] = static_cast<std::uint16_t>(bytes[c][0] | bytes[c][1] << 8);
}

}  // namespace atrium::io
