#include "modules/io/laz_gps_time.hpp"

namespace atrium::io {

void LazGpsTime::decode(LazDecoder& decoder) {
  // Another series is followed by its own code; four switches in a row lead back, so that more are damaged data.
  for (int switches = 0; switches < 8; ++switches) {
    if (steps_[last_] == 0) {
      const auto code = static_cast<std::int32_t>(decoder.symbol(without_step_));
      if (code == 1) {
        steps_[last_] = integer_.decode(decoder, 0, 0);
        advance(steps_[last_]);
        extremes_[last_] = 0;
      } else if (code == 2) {
        new_series(decoder);
      } else if (code > 2) {
        last_ = (last_ + static_cast<unsigned>(code) - 2) & 3U;
        continue;
      }
      return;
    }
    const auto code = static_cast<std::int32_t>(decoder.symbol(multiples_));
    if (code > full) {
      last_ = (last_ + static_cast<unsigned>(code - full)) & 3U;
      continue;
    }
    if (code == full)
      new_series(decoder);
    else if (code < unchanged)
      step(decoder, code);
    return;
  }
}

void LazGpsTime::new_series(LazDecoder& decoder) {
  const auto high = integer_.decode(decoder, static_cast<std::int32_t>(times_[last_] >> 32U), 8);
  next_ = (next_ + 1) & 3U;
  const std::uint64_t low = decoder.bits(16), middle = decoder.bits(16);
  times_[next_] = static_cast<std::int64_t>(static_cast<std::uint64_t>(high) << 32U | middle << 16U | low);
  last_ = next_;
  steps_[last_] = extremes_[last_] = 0;
}

void LazGpsTime::step(LazDecoder& decoder, std::int32_t code) {
  constexpr int most_extremes = 3;
  if (code == 1) {
    advance(integer_.decode(decoder, steps_[last_], 1));
    extremes_[last_] = 0;
    return;
  }
  const bool negative = code > largest;
  const std::int32_t multiple = negative ? largest - code : code;
  std::uint32_t context = 0;
  if (code == 0)
    context = 7;
  else if (negative)
    context = multiple > smallest ? 5 : 6;
  else
    context = multiple < 10 ? 2 : multiple < largest ? 3 : 4;
  const auto predicted =
      static_cast<std::int32_t>(static_cast<std::uint32_t>(multiple) * static_cast<std::uint32_t>(steps_[last_]));
  const std::int32_t difference = integer_.decode(decoder, predicted, context);
  advance(difference);
  if (context != 4 && context != 6 && context != 7) return;
  if (++extremes_[last_] <= most_extremes) return;
  steps_[last_] = difference;
  extremes_[last_] = 0;
}

}  // namespace atrium::io
