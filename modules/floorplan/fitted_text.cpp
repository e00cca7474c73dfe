#include "modules/floorplan/fitted_text.hpp"

#include <algorithm>

#include "modules/floorplan/svg_canvas.hpp"

namespace atrium::floorplan {
namespace {

constexpr std::string_view ellipsis = "\u2026";

// In units of the font's size.
double width_of(std::string_view character) {
  constexpr double wide = 1.05;
  const auto lead = static_cast<unsigned char>(character.front());
  if (character.size() == 1) {
    if (std::string_view("ijltfr.,:;'|!()[] \t\n\r").find(character) != std::string_view::npos) return 0.42;
    if (lead < 0x20 || lead >= 0x80 || std::string_view("mwMW@%").find(character) != std::string_view::npos)
      return wide;
    return lead >= 'A' && lead <= 'Z' ? 0.80 : 0.64;
  }
  return character == "\u00B7" || character == "\u00B2" ? 0.42 : lead < 0xCE ? 0.80 : wide;  // beyond Latin: wide
}

std::size_t length_at(std::string_view text, std::size_t i) {
  return std::max<std::size_t>(character_length(text, i), 1);
}

// Bytes of the longest beginning that is no wider than `width`.
std::size_t beginning(std::string_view text, double width, double size, bool bold) {
  std::size_t end = 0;
  while (end < text.size()) {
    const std::size_t next = end + length_at(text, end);
    if (font_width(text.substr(0, next), size, bold) > width) break;
    end = next;
  }
  return end;
}

}  // namespace

double font_width(std::string_view text, double size, bool bold) {
  double width = 0;
  for (std::size_t i = 0; i < text.size(); i += length_at(text, i))
    width += width_of(text.substr(i, length_at(text, i)));
  return width * size * (bold ? 1.12 : 1);
}

FittedText fitted(std::string_view text, double width, double size, double least_size, bool bold) {
  const double whole = font_width(text, size, bold);
  if (whole <= width) return {std::string(text), size};
  if (const double smaller = size * width / whole; smaller >= least_size) return {std::string(text), smaller};
  const double left = width - font_width(ellipsis, least_size, bold);
  std::string_view shown = text.substr(0, beginning(text, left, least_size, bold));
  while (!shown.empty() && shown.back() == ' ') shown.remove_suffix(1);
  return {std::string(shown) + std::string(ellipsis), least_size};
}

}  // namespace atrium::floorplan
