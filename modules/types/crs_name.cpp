#include "modules/types/crs_name.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "graph/api/error.hpp"
#include "modules/types/wkt.hpp"

namespace atrium {
namespace {

/// WGS 84, ETRS89, NAD83, CGCS2000: what is often given in the place of a projected system.
constexpr std::array in_degrees{4326, 4979, 4258, 4937, 4269, 4490};
constexpr const char* projected_help =
    "name the projected system that the scan's coordinates are in, for instance EPSG:25832";

bool is_code(const std::string& text) {
  return !text.empty() && text.size() < 8 &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

std::string unquoted(std::string_view text) {
  const bool quoted = text.size() > 1 && text.front() == '"' && text.back() == '"';
  return std::string(quoted ? text.substr(1, text.size() - 2) : text);
}

/// "EPSG:" and the code, which is that of no system that counts in degrees.
std::string epsg_name(const std::string& code) {
  if (std::find(in_degrees.begin(), in_degrees.end(), std::stoi(code)) != in_degrees.end())
    throw Error("EPSG:" + code + " counts in degrees, the model in metres", projected_help);
  return "EPSG:" + code;
}

/// Whether the system is geographic. Geodetic ones (WKT 2) may also be geocentric, in metres.
bool is_in_degrees(std::string_view text) {
  return !wkt::first_node(text, {"GEOGCS", "GEOGCRS", "GEOGRAPHICCRS"}).empty() ||
         (!wkt::first_node(text, {"GEODCRS", "GEODETICCRS"}).empty() &&
          text.find("CS[ellipsoidal") != std::string_view::npos);
}

/// Of well-known text: the EPSG code that stands right within the projected system, or within the whole where none is
/// projected; without one the name by which the text begins. Codes further within are those of its datum, its units or
/// its heights.
std::string name_in_wkt(std::string_view text) {
  const std::string_view projected = wkt::first_node(text, {"PROJCS", "PROJCRS", "PROJECTEDCRS"});
  for (const std::string_view part : wkt::parts_of(projected.empty() ? text : projected)) {
    if (!wkt::is_node(part, "AUTHORITY") && !wkt::is_node(part, "ID")) continue;
    const auto id = wkt::parts_of(part);
    if (id.size() < 2 || unquoted(id[0]) != "EPSG") continue;
    if (const std::string code = unquoted(id[1]); is_code(code)) return epsg_name(code);
  }
  const auto from = text.find('"'), to = text.find('"', from + 1);
  const bool named = from != std::string_view::npos && to != std::string_view::npos;
  std::string name(named ? text.substr(from + 1, to - from - 1) : std::string_view());
  const bool other = !projected.empty() || !wkt::first_node(text, {"LOCAL_CS", "ENGCRS"}).empty();
  if (!other && is_in_degrees(text))
    throw Error("'" + name + "' counts in degrees, the model in metres", projected_help);
  return name;
}

/// Authority and code of a name, a URN or an address.
std::pair<std::string, std::string> parts_of(const std::string& text) {
  const auto between = [&](std::size_t from, char mark) {
    return std::pair(text.substr(from, text.find(mark, from) - from), text.substr(text.rfind(mark) + 1));
  };
  for (const std::string beginning : {"https://www.opengis.net/def/crs/", "http://www.opengis.net/def/crs/"})
    if (text.starts_with(beginning)) return between(beginning.size(), '/');
  const std::string urn = "urn:ogc:def:crs:";
  if (text.starts_with(urn)) return between(urn.size(), ':');
  if (const auto colon = text.find(':'); colon != std::string::npos)
    return {text.substr(0, colon), text.substr(colon + 1)};
  return {};
}

}  // namespace

std::string crs_name(const std::string& text) {
  if (text.empty()) return text;
  if (text.find('[') != std::string::npos)
    if (std::string name = name_in_wkt(text); !name.empty()) return name;
  auto [authority, code] = parts_of(text);
  for (auto& c : authority) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  if (authority != "EPSG" || !is_code(code))
    throw Error("'" + text + "' names no coordinate reference system",
                "write it as EPSG:25832, with the number that the EPSG register (epsg.org) has for it");
  return epsg_name(code);
}

void check_crs_name(const std::string& text) { crs_name(text); }

int epsg_code(const std::string& name) {
  const std::string beginning = "EPSG:";
  return name.starts_with(beginning) && is_code(name.substr(beginning.size()))
             ? std::stoi(name.substr(beginning.size()))
             : 0;
}

std::string crs_of(const std::string& given, const Cloud* scan, const Context& context) {
  if (!given.empty()) return crs_name(given);
  if (scan == nullptr || scan->crs.empty() || scan->unit != 1) return {};
  try {
    return crs_name(scan->crs);
  } catch (const Error& error) {
    context.warn(fmt::format("of the scan's coordinate reference system: {}; it is not written; `crs` can name one",
                             error.what()));
    return {};
  }
}

std::string crs_of(const std::string& given, const Cloud* scan, const Transform& upright, std::string_view what,
                   const Context& context) {
  constexpr double level = 0.985;  // the cosine of 10 degrees, as of heights
  std::string crs = crs_of(given, scan, context);
  if (crs.empty() || upright.rotation(2, 2) > level) return crs;
  context.warn(
      fmt::format("the {} is turned upright, out of {}, whose z is not up in it: it is not written", what, crs));
  return {};
}

}  // namespace atrium
