#include "modules/floorplan/dxf_groups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "graph/api/error.hpp"

namespace atrium::floorplan {
namespace {

// The shortest text that is read back as the same double; readers of DXF need not know exponents.
std::string decimal(double value) {
  std::string text = fmt::format("{}", value);
  if (const auto mark = text.find('e'); mark != std::string::npos) {
    const auto point = text.find('.');
    const int digits = point == std::string::npos ? 0 : static_cast<int>(mark - point) - 1;
    text = fmt::format("{:.{}f}", value, std::max(digits - std::stoi(text.substr(mark + 1)), 1));
  }
  return text.find('.') == std::string::npos ? text + ".0" : text;
}

// Windows-1252 from 0x80 to 0x9F, 0 where it has nothing; above, it is Unicode.
constexpr std::array<std::uint16_t, 32> upper_controls{0x20AC, 0,      0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021,
                                                       0x02C6, 0x2030, 0x0160, 0x2039, 0x0152, 0,      0x017D, 0,
                                                       0,      0x2018, 0x2019, 0x201C, 0x201D, 0x2022, 0x2013, 0x2014,
                                                       0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0,      0x017E, 0x0178};

std::string in_code_page(std::uint32_t code) {
  if (code >= 0x80 && code < 0xA0) return {};  // control characters
  if (code >= 0xA0 && code <= 0xFF) return {static_cast<char>(code)};
  const auto* place = std::find(upper_controls.begin(), upper_controls.end(), code);
  if (place != upper_controls.end()) return {static_cast<char>(0x80 + (place - upper_controls.begin()))};
  return code > 0xFFFF ? "?" : fmt::format("\\U+{:04X}", code);
}

}  // namespace

std::string dxf_text(std::string_view utf8) {
  std::string result;
  for (std::size_t i = 0; i < utf8.size(); ++i) {
    const auto lead = static_cast<unsigned char>(utf8[i]);
    if (lead < 0x80) {
      if (lead >= 0x20 && lead != 0x7F) result += utf8[i];
      continue;
    }
    const int more = lead >= 0xF0 ? 3 : lead >= 0xE0 ? 2 : lead >= 0xC2 ? 1 : 0;
    std::uint32_t code = lead & (0x3FU >> more);
    int read = 0;
    for (; read < more && i + 1 < utf8.size() && (utf8[i + 1] & 0xC0) == 0x80; ++read, ++i)
      code = code << 6U | (static_cast<unsigned char>(utf8[i + 1]) & 0x3FU);
    result += more == 0 || read < more ? "?" : in_code_page(code);
  }
  return result;
}

void DxfGroups::text(int code, std::string_view value) {
  fmt::format_to(std::back_inserter(text_), "{:>3}\n{}\n", code, value);
}

void DxfGroups::integer(int code, std::int64_t value) { text(code, fmt::format("{}", value)); }

void DxfGroups::real(int code, double value) {
  if (!std::isfinite(value))
    throw Error("the plan has a coordinate that is not a finite number",
                "DXF cannot hold it; is the scan's scale right?");
  text(code, decimal(value));
}

void DxfGroups::handle(int code, DxfHandle value) { text(code, fmt::format("{:X}", value)); }

void DxfGroups::point(int code, const Eigen::Vector2d& p) {
  real(code, p.x());
  real(code + 10, p.y());
}

void DxfGroups::point(int code, const Eigen::Vector2d& p, double z) {
  point(code, p);
  real(code + 20, z);
}

void DxfGroups::record(std::string_view kind, DxfHandle handle, DxfHandle owner) {
  text(0, kind);
  this->handle(kind == "DIMSTYLE" ? 105 : 5, handle);
  this->handle(330, owner);
}

void DxfGroups::begin_section(std::string_view name) {
  text(0, "SECTION");
  text(2, name);
}

}  // namespace atrium::floorplan
