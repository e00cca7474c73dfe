#include "modules/io/crs.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

#include "modules/io/lines.hpp"
#include "modules/io/scalar.hpp"
#include "modules/types/wkt.hpp"

namespace atrium::io {
namespace {

/// The number after the name in UNIT["metre",1,…] that stands right within the node.
std::optional<double> unit_within(std::string_view node) {
  std::optional<double> found;
  for (const std::string_view part : wkt::parts_of(node)) {
    if (!wkt::is_node(part, "UNIT") && !wkt::is_node(part, "LENGTHUNIT")) continue;
    const auto within = wkt::parts_of(part);
    double value = 0;
    if (within.size() > 1 && parse_number(within[1], value) && value > 0) found = value;
  }
  return found;
}

}  // namespace

Crs crs_of_wkt(std::string_view text) {
  text = wkt::without_blanks(text.substr(0, text.find('\0')));
  Crs crs;
  crs.text = text;
  if (const auto node = wkt::first_node(text, {"PROJCS", "PROJCRS", "PROJECTEDCRS", "LOCAL_CS", "ENGCRS"});
      !node.empty())
    crs.metres = unit_within(node);
  else
    crs.degrees = !wkt::first_node(text, {"GEOGCS", "GEOGCRS", "GEODCRS"}).empty();
  return crs;
}

Crs crs_of_geotiff(const std::byte* keys, std::size_t size) {
  enum : std::uint16_t { model = 1024, geographic = 2048, projected = 3072, linear_unit = 3076 };
  constexpr std::uint16_t user_defined = 32767;
  Crs crs;
  std::uint16_t geographic_code = 0;
  for (std::size_t at = 8; at + 8 <= size; at += 8) {
    const auto key = load<std::uint16_t>(keys + at);
    const auto place = load<std::uint16_t>(keys + at + 2);
    const auto value = load<std::uint16_t>(keys + at + 6);
    if (place != 0) continue;  // its value stands elsewhere: a text or a real number
    if (key == model) crs.degrees = value == 2;
    if (key == geographic && value != 0 && value != user_defined) geographic_code = value;
    if (key == projected && value != 0 && value != user_defined) crs.text = fmt::format("EPSG:{}", value);
    if (key == linear_unit && value == 9001) crs.metres = 1.0;
    if (key == linear_unit && value == 9002) crs.metres = 0.3048;
    if (key == linear_unit && value == 9003) crs.metres = us_survey_foot;
  }
  if (crs.degrees && geographic_code != 0) crs.text = fmt::format("EPSG:{}", geographic_code);
  return crs;
}

}  // namespace atrium::io
