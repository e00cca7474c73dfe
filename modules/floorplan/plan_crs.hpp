#pragma once
#include "modules/types/crs_name.hpp"
#include "modules/types/floor_plan.hpp"

namespace atrium::floorplan {

/// As crs_of() of the types. A plan that was turned upright by more than 10 degrees is in no such system: then it is
/// empty, with a warning.
std::string crs_of(const std::string& given, const Cloud* scan, const FloorPlan& plan, const Context& context);

}  // namespace atrium::floorplan
