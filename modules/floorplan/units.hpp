#pragma once
#include <string>
#include <string_view>

#include "graph/api/parameter.hpp"

namespace atrium::floorplan {

/// What lengths on drawings are written in; areas are in square metres, or square feet.
enum class Units { metres, millimetres, feet };
/// Their names as parameters have them.
inline constexpr Choice<Units> unit_choices[]{{"m", Units::metres}, {"mm", Units::millimetres}, {"ft-in", Units::feet}};

/// A length as it stands on a dimension line, whose unit the title block names: "3.45", "3450", "11′ 4″"; of feet to
/// the half inch, as metres are to the centimetre. `plain`: with the signs that CAD fonts have, as CAD programs write
/// architectural units: 11'-4 1/2".
std::string dimension_text(double metres, Units units, bool plain = false);
/// With its unit: "3.45 m", "3450 mm", "11′ 4″".
std::string length_text(double metres, Units units, bool plain = false);
/// "12.34 m²", "132.8 sq ft".
std::string area_text(double square_metres, Units units);
/// How many of the unit that CAD programs count in are a metre: of feet and inches that is the inch.
double cad_units_per_metre(Units units);
/// "metres", "millimetres", "feet and inches".
std::string_view name_of(Units units);

}  // namespace atrium::floorplan
