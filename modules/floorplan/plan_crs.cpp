#include "modules/floorplan/plan_crs.hpp"

#include <fmt/format.h>

namespace atrium::floorplan {

std::string crs_of(const std::string& given, const Cloud* scan, const FloorPlan& plan, const Context& context) {
  constexpr double level = 0.985;  // the cosine of 10 degrees, as of heights
  std::string crs = atrium::crs_of(given, scan, context);
  if (crs.empty() || plan.to_plan.rotation(2, 2) > level) return crs;
  context.warn(fmt::format("the plan is turned upright, out of {}, whose z is not up in it: it is not written", crs));
  return {};
}

}  // namespace atrium::floorplan
