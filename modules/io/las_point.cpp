#include "modules/io/las_point.hpp"

#include "modules/io/scalar.hpp"

namespace atrium::io {

LasPoint las_point(const std::byte* record, const LasRecord& type) {
  LasPoint p;
  p.x = load<std::int32_t>(record);
  p.y = load<std::int32_t>(record + 4);
  p.z = load<std::int32_t>(record + 8);
  p.intensity = load<std::uint16_t>(record + 12);
  const auto flags = std::to_integer<unsigned>(record[15]);
  p.classification = type.extended ? std::to_integer<std::uint8_t>(record[16]) : static_cast<std::uint8_t>(flags & 31U);
  p.withheld = (flags & (type.extended ? 4U : 128U)) != 0;
  if (type.rgb >= 0)
    for (std::size_t c = 0; c < 3; ++c) p.rgb[c] = load<std::uint16_t>(record + type.rgb + 2 * c);
  return p;
}

}  // namespace atrium::io
