#include "modules/floorplan/units.hpp"

#include <fmt/format.h>

#include <cmath>

namespace atrium::floorplan {
namespace {

constexpr double inch = 0.0254, foot = 0.3048;  // metres, the international ones

std::string feet_text(double metres, bool plain) {
  const auto halves = std::llabs(std::llround(2 * metres / inch));
  const bool half = halves % 2 != 0;
  const auto feet = halves / 24, inches = halves % 24 / 2;
  const std::string_view sign = metres < 0 && halves > 0 ? "-" : "";
  if (plain) return fmt::format("{}{}'-{}{}\"", sign, feet, inches, half ? " 1/2" : "");
  const std::string whole = inches > 0 || !half ? fmt::format("{}", inches) : std::string();
  return fmt::format("{}{}\u2032 {}{}\u2033", sign, feet, whole, half ? "\u00BD" : "");
}

}  // namespace

std::string dimension_text(double metres, Units units, bool plain) {
  if (units == Units::feet) return feet_text(metres, plain);
  return units == Units::millimetres ? fmt::format("{}", std::llround(1000 * metres))
                                     : fmt::format("{:.2f}", std::round(100 * metres) / 100 + 0.0);  // no -0.00
}

std::string length_text(double metres, Units units, bool plain) {
  const std::string text = dimension_text(metres, units, plain);
  return units == Units::feet ? text : text + (units == Units::millimetres ? " mm" : " m");
}

std::string area_text(double square_metres, Units units) {
  return units == Units::feet ? fmt::format("{:.1f} sq ft", square_metres / (foot * foot))
                              : fmt::format("{:.2f} m\u00B2", square_metres);
}

double cad_units_per_metre(Units units) {
  return units == Units::feet ? 1 / inch : units == Units::millimetres ? 1000 : 1;
}

std::string_view name_of(Units units) {
  switch (units) {
    case Units::millimetres: return "millimetres";
    case Units::feet: return "feet and inches";
    default: return "metres";
  }
}

}  // namespace atrium::floorplan
