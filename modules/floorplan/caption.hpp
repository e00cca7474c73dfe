#pragma once
#include <string>

#include "modules/floorplan/units.hpp"
#include "modules/types/floor_plan.hpp"

namespace atrium::floorplan {

/// What stands above a storey's drawing: in one line, or `stacked` in three. Millimetres of paper.
struct Caption {
  std::string name;  ///< "Storey 2"
  std::string level, content;
  bool stacked = false;

  static constexpr double name_size = 3.4, size = 2.6;  ///< of the fonts
  static constexpr double line = 4;                     ///< from one line to the next
  double name_width() const;
  /// Of the rest, as it stands in one line.
  std::string about() const { return level + " \u00B7 " + content; }
  double width() const;
  double height() const { return stacked ? 9 + 2 * line : 9; }
};

/// The height of the plan's origin: its z in the input's frame where that is level to within 10 degrees, else (a scan
/// whose y points up, say) how high it lies over the input's origin.
double origin_height(const FloorPlan& plan);

/// Of a storey whose elevation counts from `origin_z`, in one line.
Caption caption_of(const PlanStorey& storey, double origin_z, Units units = Units::metres);

}  // namespace atrium::floorplan
