#pragma once
#include <array>
#include <cstdint>

#include "modules/io/laz_decoder.hpp"

namespace atrium::io {

/// LASzip's item GPSTIME11, version 2: up to four series of times with steady steps; a step is coded as a multiple of
/// the last one. Times are doubles taken as 64-bit integers.
class LazGpsTime {
 public:
  void start(std::int64_t time) { times_[0] = time; }
  void decode(LazDecoder& decoder);

 private:
  void new_series(LazDecoder& decoder);
  void step(LazDecoder& decoder, std::int32_t multiple);
  void advance(std::int32_t by) {  // may wrap around
    times_[last_] = static_cast<std::int64_t>(static_cast<std::uint64_t>(times_[last_]) +
                                              static_cast<std::uint64_t>(static_cast<std::int64_t>(by)));
  }

  static constexpr std::int32_t largest = 500, smallest = -10;
  static constexpr std::int32_t unchanged = largest - smallest + 1, full = unchanged + 1,
                                codes = largest - smallest + 6;

  LazModel multiples_{codes, true}, without_step_{6, true};
  LazInteger integer_{32, 9};
  std::array<std::int64_t, 4> times_{};
  std::array<std::int32_t, 4> steps_{}, extremes_{};
  unsigned last_ = 0, next_ = 0;
};

}  // namespace atrium::io
