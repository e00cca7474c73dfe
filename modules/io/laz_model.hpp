#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace atrium::io {

// The adaptive models of LASzip's entropy coder (A. Said, "Introduction to Arithmetic Coding", HPL-2004-76): 32-bit
// intervals, probabilities in 1/2¹⁵ (symbols) and 1/2¹³ (bits), renewed after a number of symbols that grows.

/// How often each of up to 2048 symbols came. Decoders have a table that brings them near the symbol at once.
class LazModel {
 public:
  static constexpr unsigned probability_bits = 15;

  LazModel() = default;
  LazModel(std::uint32_t symbols, bool decodes);
  bool empty() const { return numbers_.empty(); }

  std::uint32_t last() const { return symbols_ - 1; }
  std::uint32_t begins(std::uint32_t symbol) const { return numbers_[symbol]; }  ///< its share of 2¹⁵ begins there
  void count(std::uint32_t symbol) {
    ++numbers_[symbols_ + symbol];
    if (--left_ == 0) renew();
  }
  /// The symbol whose share holds `place`, which may be a little above 2¹⁵.
  std::uint32_t find(std::uint32_t place) const;

 private:
  void renew();

  std::uint32_t symbols_ = 0, total_ = 0, cycle_ = 0, left_ = 0, table_size_ = 0, shift_ = 0;
  std::vector<std::uint32_t> numbers_;  // begins of shares, then counts, then the table
};

/// The same for one bit.
class LazBit {
 public:
  static constexpr unsigned probability_bits = 13;
  std::uint32_t zero() const { return zero_; }  ///< share of 2¹³ of the bit 0
  void count(std::uint32_t bit) {
    zeros_ += bit == 0 ? 1 : 0;
    if (--left_ == 0) renew();
  }

 private:
  void renew();
  std::uint32_t zeros_ = 1, total_ = 2, zero_ = 1U << (probability_bits - 1), left_ = 4, cycle_ = 4;
};

inline std::uint32_t LazModel::find(std::uint32_t place) const {
  std::uint32_t low = 0, high = symbols_;
  if (table_size_ > 0) {
    const std::uint32_t* table = numbers_.data() + std::size_t{2} * symbols_;
    const std::uint32_t t = place >> shift_ < table_size_ ? place >> shift_ : table_size_;
    low = table[t];
    high = table[t + 1] + 1;
  }
  while (high > low + 1) {
    const std::uint32_t middle = (low + high) / 2;
    if (numbers_[middle] > place)
      high = middle;
    else
      low = middle;
  }
  return low;
}

}  // namespace atrium::io
