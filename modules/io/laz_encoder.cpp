#include "modules/io/laz_encoder.hpp"

#include <bit>

namespace atrium::io {
namespace {

constexpr std::uint32_t shortest_interval = 1U << 24U;
constexpr unsigned bits_with_models = 8;

}  // namespace

void LazEncoder::add(std::uint32_t to_base, std::uint32_t length) {
  const std::uint32_t before = base_;
  base_ += to_base;
  length_ = length;
  if (base_ < before) {  // carry into the bytes that are out already
    std::size_t i = bytes_.size();
    while (i > 0 && bytes_[i - 1] == '\xFF') bytes_[--i] = '\0';
    if (i > 0) bytes_[i - 1] = static_cast<char>(bytes_[i - 1] + 1);
  }
  shift();
}

void LazEncoder::shift() {
  while (length_ < shortest_interval) {
    bytes_ += static_cast<char>(base_ >> 24U);
    base_ <<= 8U;
    length_ <<= 8U;
  }
}

void LazEncoder::symbol(LazModel& model, std::uint32_t symbol) {
  const std::uint32_t unit = length_ >> LazModel::probability_bits;
  const std::uint32_t begin = model.begins(symbol) * unit;
  const std::uint32_t end = symbol == model.last() ? length_ : model.begins(symbol + 1) * unit;
  add(begin, end - begin);
  model.count(symbol);
}

void LazEncoder::bit(LazBit& model, std::uint32_t bit) {
  const std::uint32_t zero = model.zero() * (length_ >> LazBit::probability_bits);
  if (bit == 0)
    add(0, zero);
  else
    add(zero, length_ - zero);
  model.count(bit);
}

void LazEncoder::bits(unsigned count, std::uint32_t value) {
  if (count > 19) {
    bits(16, value & 0xFFFFU);
    bits(count - 16, value >> 16U);
    return;
  }
  const std::uint32_t unit = length_ >> count;
  add(value * unit, unit);
}

const std::string& LazEncoder::finish() {
  // The fewest bytes that lie within the interval, and zeros for the four that a decoder holds ahead.
  const bool one_byte = length_ > 2 * shortest_interval;
  if (one_byte)
    add(shortest_interval, shortest_interval / 2);
  else
    add(shortest_interval / 2, shortest_interval >> 9U);
  bytes_.append(one_byte ? 3 : 2, '\0');
  return bytes_;
}

LazIntegerEncoder::LazIntegerEncoder(unsigned bits, std::uint32_t contexts) : bits_(bits), uppers_(bits + 1) {
  for (std::uint32_t c = 0; c < contexts; ++c) lengths_.emplace_back(bits + 1, false);
}

void LazIntegerEncoder::encode(LazEncoder& encoder, std::int32_t predicted, std::int32_t value, std::uint32_t context) {
  auto correction =
      static_cast<std::int32_t>(static_cast<std::uint32_t>(value) - static_cast<std::uint32_t>(predicted));
  if (bits_ < 32) {  // brought into -2^(bits - 1) … 2^(bits - 1) - 1
    const std::int32_t half = 1 << (bits_ - 1);
    if (correction < -half)
      correction += 2 * half;
    else if (correction >= half)
      correction -= 2 * half;
  }
  const std::uint32_t magnitude =
      correction <= 0 ? 0U - static_cast<std::uint32_t>(correction) : static_cast<std::uint32_t>(correction) - 1;
  k_ = static_cast<std::uint32_t>(std::bit_width(magnitude));
  encoder.symbol(lengths_[context], k_);
  if (k_ == 0) {
    encoder.bit(small_, static_cast<std::uint32_t>(correction));
    return;
  }
  if (k_ == 32) return;
  const std::uint32_t code = correction < 0 ? static_cast<std::uint32_t>(correction) + (1U << k_) - 1
                                            : static_cast<std::uint32_t>(correction) - 1;
  const unsigned rest = k_ > bits_with_models ? k_ - bits_with_models : 0;
  LazModel& upper = uppers_[k_];
  if (upper.empty()) upper = LazModel(1U << (k_ - rest), false);
  encoder.symbol(upper, code >> rest);
  if (rest > 0) encoder.bits(rest, code & ((1U << rest) - 1));
}

}  // namespace atrium::io
