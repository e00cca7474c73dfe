#include "modules/floorplan/caption.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "graph/api/text.hpp"
#include "modules/floorplan/fitted_text.hpp"

namespace atrium::floorplan {

double Caption::name_width() const { return font_width(name, name_size, true); }

double Caption::width() const {
  if (stacked) return std::max({name_width(), font_width(level, size), font_width(content, size)});
  return name_width() + 3 + font_width(about(), size);
}

double origin_height(const FloorPlan& plan) {
  constexpr double level = 0.985;  // the cosine of 10 degrees
  const Eigen::Vector3d up = plan.to_plan.rotation.row(2);
  return up.z() > level ? plan.origin.z() : up.dot(plan.origin);
}

Caption caption_of(const PlanStorey& storey, double origin_z, Units units) {
  Caption caption;
  caption.name = fmt::format("Storey {}", storey.index);
  caption.level =
      storey.floor_known ? "floor at " + length_text(origin_z + storey.elevation, units) : "elevation unknown";
  caption.level += storey.height > 0 ? " \u00B7 height " + length_text(storey.height, units) : " \u00B7 height unknown";
  double area = 0;
  for (const auto& room : storey.rooms) area += room.polygon.area();
  caption.content = fmt::format("{} \u00B7 {}", counted(storey.rooms.size(), "room"), area_text(area, units));
  return caption;
}

}  // namespace atrium::floorplan
