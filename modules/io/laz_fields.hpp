#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "modules/io/laz_decoder.hpp"

namespace atrium::io {

// What the pointwise (2) and the layered (3) compressor of LASzip have in common.

/// Models that are made when they are first used: few of the possible ones are.
class LazModels {
 public:
  LazModels(std::size_t models, std::uint32_t symbols) : symbols_(symbols), models_(models) {}
  LazModel& operator[](std::size_t i) {
    if (models_[i].empty()) models_[i] = LazModel(symbols_, true);
    return models_[i];
  }

 private:
  std::uint32_t symbols_;
  std::vector<LazModel> models_;
};

/// Nearly the median of the latest five numbers: sorted, a new one replaces the largest and the smallest by turns.
class LazMedian {
 public:
  std::int32_t get() const { return sorted_[2]; }
  void add(std::int32_t v);

 private:
  std::array<std::int32_t, 5> sorted_{};
  bool high_ = true;
};

/// Context of the median of dx and dy (0 … 15) by the number of returns n and the return r, 0 … 7 each.
std::uint8_t laz_return_map(unsigned n, unsigned r);
/// The same for 15 returns, 0 … 5.
std::uint8_t laz_return_map_6(unsigned n, unsigned r);

/// The context by the bits of other corrections: even numbers up to `most`, plus one for single returns.
inline std::uint32_t laz_context(std::uint32_t bits, std::uint32_t most, bool single) {
  return (bits < most ? bits & ~1U : most) + (single ? 1 : 0);
}

/// Decodes colours: which of the six bytes differ from the last colour, and by how much more than red does.
class LazColours {
 public:
  void decode(LazDecoder& decoder, std::array<std::uint16_t, 3>& last);

 private:
  LazModel changes_{128, true};
  LazModels bytes_{6, 256};
};

}  // namespace atrium::io
