#include "modules/types/crs_name.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "graph/api/error.hpp"

namespace atrium {
namespace {

/// WGS 84, ETRS89, NAD83, CGCS2000: what is often given in the place of a projected system.
constexpr std::array in_degrees{4326, 4979, 4258, 4937, 4269, 4490};

bool is_code(const std::string& text) {
  return !text.empty() && text.size() < 8 &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// Of well-known text: its last authority is that of the whole; without one the name by which it begins.
std::string name_in_wkt(const std::string& wkt) {
  for (const std::string mark : {"AUTHORITY[\"EPSG\",\"", "ID[\"EPSG\","}) {
    const auto at = wkt.rfind(mark);
    if (at == std::string::npos) continue;
    const auto from = at + mark.size(), to = wkt.find_first_not_of("0123456789", from);
    if (to != std::string::npos && to > from && to - from < 8) return "EPSG:" + wkt.substr(from, to - from);
  }
  const auto from = wkt.find('"'), to = wkt.find('"', from + 1);
  return from == std::string::npos || to == std::string::npos ? std::string() : wkt.substr(from + 1, to - from - 1);
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
  if (std::find(in_degrees.begin(), in_degrees.end(), std::stoi(code)) != in_degrees.end())
    throw Error("EPSG:" + code + " counts in degrees, the model in metres",
                "name the projected system that the scan's coordinates are in, for instance EPSG:25832");
  return authority + ":" + code;
}

int epsg_code(const std::string& name) {
  const std::string beginning = "EPSG:";
  return name.starts_with(beginning) && is_code(name.substr(beginning.size()))
             ? std::stoi(name.substr(beginning.size()))
             : 0;
}

std::string crs_of(const std::string& given, const Cloud* scan, const Context& context) {
  if (!given.empty()) return crs_name(given);
  if (scan == nullptr || scan->crs.empty()) return {};
  if (scan->unit != 1) {
    context.warn(fmt::format("the scan counts in units of {} m, its coordinate reference system too: it is not written",
                             scan->unit));
    return {};
  }
  try {
    return crs_name(scan->crs);
  } catch (const Error& error) {
    context.warn(fmt::format("of the scan's coordinate reference system: {}; it is not written; `crs` can name one",
                             error.what()));
    return {};
  }
}

}  // namespace atrium
