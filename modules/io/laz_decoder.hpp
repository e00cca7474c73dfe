#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "modules/io/laz_model.hpp"

namespace atrium::io {

/// Decodes symbols from some bytes. Behind their end come zeros, and exhausted() says so: what was decoded then is
/// nothing.
class LazDecoder {
 public:
  LazDecoder() = default;
  LazDecoder(const std::byte* data, std::size_t size) : place_(data), end_(data + size) {
    for (int i = 0; i < 4; ++i) value_ = value_ << 8U | next();
    if (value_ == whole) --value_;  // no encoder writes it
  }
  bool exhausted() const { return exhausted_; }

  std::uint32_t symbol(LazModel& model) {
    std::uint32_t end = length_;
    length_ >>= LazModel::probability_bits;
    const std::uint32_t symbol = model.find(value_ / length_);
    const std::uint32_t begin = model.begins(symbol) * length_;
    if (symbol != model.last()) end = model.begins(symbol + 1) * length_;
    take(begin, end - begin);
    model.count(symbol);
    return symbol;
  }
  std::uint32_t bit(LazBit& model) {
    const std::uint32_t zero = model.zero() * (length_ >> LazBit::probability_bits);
    const bool one = value_ >= zero;
    if (one)
      take(zero, length_ - zero);
    else
      take(0, zero);
    model.count(one ? 1 : 0);
    return one ? 1 : 0;
  }
  /// 1 … 32 bits that no model foretells.
  std::uint32_t bits(unsigned count) {
    if (count > 19) {
      const std::uint32_t low = bits(16);
      return bits(count - 16) << 16U | low;
    }
    length_ >>= count;
    const std::uint32_t value = value_ / length_;
    take(value * length_, length_);
    return value;
  }

 private:
  static constexpr std::uint32_t whole = 0xFFFFFFFFU, shortest = 1U << 24U;

  std::uint32_t next() {
    if (place_ < end_) return std::to_integer<std::uint32_t>(*place_++);
    exhausted_ = true;
    return 0;
  }
  void take(std::uint32_t begin, std::uint32_t length) {
    value_ -= begin;
    length_ = length;
    while (length_ < shortest) {
      if (length_ == 0) {  // only of damaged data
        exhausted_ = true;
        length_ = whole;
        value_ = 0;
        return;
      }
      value_ = value_ << 8U | next();
      length_ <<= 8U;
    }
  }

  const std::byte* place_ = nullptr;
  const std::byte* end_ = nullptr;
  std::uint32_t value_ = 0, length_ = whole;
  bool exhausted_ = false;
};

/// Decodes integers as corrections of a prediction: first how many bits the correction has (by context), then its upper
/// 8 bits by models, then the rest as they are.
class LazInteger {
 public:
  LazInteger() = default;
  LazInteger(unsigned bits, std::uint32_t contexts);

  std::int32_t decode(LazDecoder& decoder, std::int32_t predicted, std::uint32_t context = 0);
  /// Of the last correction.
  std::uint32_t bits() const { return k_; }

 private:
  unsigned bits_ = 0;
  std::uint32_t k_ = 0;
  std::vector<LazModel> lengths_, uppers_;
  LazBit small_;
};

}  // namespace atrium::io
