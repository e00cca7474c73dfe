#include "modules/io/laz_model.hpp"

#include <algorithm>

namespace atrium::io {

LazModel::LazModel(std::uint32_t symbols, bool decodes) : symbols_(symbols) {
  constexpr std::uint32_t few = 16;
  if (decodes && symbols > few) {
    std::uint32_t bits = 3;
    while (symbols > 1U << (bits + 2)) ++bits;
    table_size_ = 1U << bits;
    shift_ = probability_bits - bits;
  }
  numbers_.resize(2 * symbols + (table_size_ > 0 ? table_size_ + 2 : 0), 1);
  cycle_ = symbols;
  renew();
  cycle_ = left_ = (symbols + 6) / 2;
}

void LazModel::renew() {
  constexpr std::uint32_t most = 1U << probability_bits;
  std::uint32_t* const begins = numbers_.data();
  std::uint32_t* const counts = begins + symbols_;
  total_ += cycle_;
  if (total_ > most) {
    total_ = 0;
    for (std::uint32_t s = 0; s < symbols_; ++s) total_ += counts[s] = (counts[s] + 1) / 2;
  }
  const std::uint32_t scale = 0x80000000U / total_;
  std::uint32_t sum = 0;
  for (std::uint32_t s = 0; s < symbols_; ++s) {
    begins[s] = (scale * sum) >> (31 - probability_bits);
    sum += counts[s];
  }
  if (table_size_ > 0) {
    std::uint32_t* const table = counts + symbols_;
    std::uint32_t entry = 0;
    table[0] = 0;
    for (std::uint32_t s = 1; s < symbols_; ++s)
      while (entry < begins[s] >> shift_) table[++entry] = s - 1;
    while (entry <= table_size_) table[++entry] = symbols_ - 1;
  }
  cycle_ = std::min(5 * cycle_ / 4, (symbols_ + 6) * 8);
  left_ = cycle_;
}

void LazBit::renew() {
  constexpr std::uint32_t most = 1U << probability_bits, longest = 64;
  total_ += cycle_;
  if (total_ > most) {
    total_ = (total_ + 1) / 2;
    zeros_ = (zeros_ + 1) / 2;
    if (zeros_ == total_) ++total_;
  }
  const std::uint32_t scale = 0x80000000U / total_;
  zero_ = (zeros_ * scale) >> (31 - probability_bits);
  cycle_ = std::min(5 * cycle_ / 4, longest);
  left_ = cycle_;
}

}  // namespace atrium::io
