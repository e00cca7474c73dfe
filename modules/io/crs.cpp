#include "modules/io/crs.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <cstdint>

#include "modules/io/lines.hpp"
#include "modules/io/scalar.hpp"

namespace atrium::io {
namespace {

std::string_view without_blanks(std::string_view text) {
  while (!text.empty() && (static_cast<unsigned char>(text.back()) <= ' ')) text.remove_suffix(1);
  while (!text.empty() && (static_cast<unsigned char>(text.front()) <= ' ')) text.remove_prefix(1);
  return text;
}

/// Where the node NAME[ of WKT begins; npos: there is none. A longer name's end does not count.
std::size_t find_node(std::string_view wkt, std::string_view name, std::size_t from = 0) {
  for (std::size_t at = wkt.find(name, from); at != std::string_view::npos; at = wkt.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    const bool begins = at == 0 || (std::isalnum(static_cast<unsigned char>(wkt[at - 1])) == 0 && wkt[at - 1] != '_');
    if (begins && end < wkt.size() && (wkt[end] == '[' || wkt[end] == '(')) return at;
  }
  return std::string_view::npos;
}

/// The node from its name to its closing bracket.
std::string_view node_at(std::string_view wkt, std::size_t begin) {
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = begin; i < wkt.size(); ++i) {
    if (wkt[i] == '"') quoted = !quoted;
    if (quoted) continue;
    if (wkt[i] == '[' || wkt[i] == '(') ++depth;
    if ((wkt[i] == ']' || wkt[i] == ')') && --depth == 0) return wkt.substr(begin, i + 1 - begin);
  }
  return wkt.substr(begin);
}

/// The number after the name in UNIT["metre",1,…] that stands right within the node.
std::optional<double> unit_within(std::string_view node) {
  int depth = 0;
  bool quoted = false;
  std::optional<double> found;
  for (std::size_t i = 0; i < node.size(); ++i) {
    if (node[i] == '"') quoted = !quoted;
    if (quoted) continue;
    if (node[i] == '[' || node[i] == '(') ++depth;
    if (node[i] == ']' || node[i] == ')') --depth;
    if (depth != 1 || node[i] != ',') continue;
    const std::string_view rest = without_blanks(node.substr(i + 1));
    if (!rest.starts_with("UNIT") && !rest.starts_with("LENGTHUNIT")) continue;
    const std::string_view unit = node_at(rest, 0);
    const std::size_t first = unit.find("\",");
    if (first == std::string_view::npos) continue;
    const std::string_view number = without_blanks(unit.substr(first + 2));
    double value = 0;
    if (parse_number(without_blanks(number.substr(0, number.find_first_of(",])"))), value) && value > 0) found = value;
  }
  return found;
}

}  // namespace

Crs crs_of_wkt(std::string_view wkt) {
  wkt = without_blanks(wkt.substr(0, wkt.find('\0')));
  Crs crs;
  crs.text = wkt;
  for (const std::string_view name : {"PROJCS", "PROJCRS", "PROJECTEDCRS", "LOCAL_CS", "ENGCRS"})
    if (const std::size_t at = find_node(wkt, name); at != std::string_view::npos) {
      crs.metres = unit_within(node_at(wkt, at));
      return crs;
    }
  for (const std::string_view name : {"GEOGCS", "GEOGCRS", "GEODCRS"})
    if (find_node(wkt, name) != std::string_view::npos) crs.degrees = true;
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
