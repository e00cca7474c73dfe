#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "modules/io/laz_model.hpp"

namespace atrium::io {

/// Encodes symbols into bytes: what LazDecoder decodes.
class LazEncoder {
 public:
  void symbol(LazModel& model, std::uint32_t symbol);
  void bit(LazBit& model, std::uint32_t bit);
  void bits(unsigned count, std::uint32_t value);
  /// Ends the code, and gives its bytes. Nothing can be encoded after it.
  const std::string& finish();

 private:
  void add(std::uint32_t to_base, std::uint32_t length);
  void shift();

  std::string bytes_;
  std::uint32_t base_ = 0, length_ = 0xFFFFFFFFU;
};

/// Encodes integers as corrections of a prediction: what LazInteger decodes.
class LazIntegerEncoder {
 public:
  LazIntegerEncoder(unsigned bits, std::uint32_t contexts);
  void encode(LazEncoder& encoder, std::int32_t predicted, std::int32_t value, std::uint32_t context = 0);
  std::uint32_t bits() const { return k_; }

 private:
  unsigned bits_;
  std::uint32_t k_ = 0;
  std::vector<LazModel> lengths_, uppers_;
  LazBit small_;
};

}  // namespace atrium::io
