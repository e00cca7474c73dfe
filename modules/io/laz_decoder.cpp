#include "modules/io/laz_decoder.hpp"

namespace atrium::io {
namespace {

constexpr unsigned modelled_bits = 8;

}  // namespace

LazInteger::LazInteger(unsigned bits, std::uint32_t contexts) : bits_(bits), uppers_(bits + 1) {
  lengths_.reserve(contexts);
  for (std::uint32_t c = 0; c < contexts; ++c) lengths_.emplace_back(bits + 1, true);
}

std::int32_t LazInteger::decode(LazDecoder& decoder, std::int32_t predicted, std::uint32_t context) {
  k_ = decoder.symbol(lengths_[context]);
  std::uint32_t correction = 0;
  if (k_ == 0) {
    correction = decoder.bit(small_);
  } else if (k_ == 32) {
    correction = 0x80000000U;
  } else {
    LazModel& upper = uppers_[k_];
    if (upper.empty()) upper = LazModel(1U << (k_ < modelled_bits ? k_ : modelled_bits), true);
    correction = decoder.symbol(upper);
    if (k_ > modelled_bits) correction = correction << (k_ - modelled_bits) | decoder.bits(k_ - modelled_bits);
    // The lower half stands for -(2^k - 1) … -2^(k-1), the upper one for 2^(k-1) + 1 … 2^k.
    if (correction >= 1U << (k_ - 1))
      correction += 1;
    else
      correction -= (1U << k_) - 1;
  }
  const std::uint32_t value = static_cast<std::uint32_t>(predicted) + correction;
  return static_cast<std::int32_t>(bits_ < 32 ? value & ((1U << bits_) - 1) : value);
}

}  // namespace atrium::io
