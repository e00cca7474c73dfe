#include <boost/geometry.hpp>

#include "modules/geometry/plan_boost.hpp"

namespace atrium::overlay {

bool is_valid(const PlanPolygon& polygon) { return bg::is_valid(to_boost(polygon)); }

bool covers(const PlanPolygon& whole, const PlanPolygon& part) {
  return bg::covered_by(to_boost(part), to_boost(whole));
}

}  // namespace atrium::overlay
