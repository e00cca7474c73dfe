#pragma once
#include "modules/floorplan/sheet.hpp"

namespace atrium::floorplan {

enum class Axes { walls, input };

/// The choices that SVG and PDF have in common.
struct PlanDrawing {
  std::string title = "Floor plan";
  std::int32_t storey = -1;  ///< the one to draw; -1: all
  Paper paper = Paper::automatic;
  std::int32_t scale = 0;
  Axes axes = Axes::walls;
  bool dimensions = true;
  Units units = Units::metres;
};

/// The plan's storeys that are drawn, as they lie on paper.
struct DrawnPlan {
  std::vector<PlanStorey> storeys;
  double turn = 0;  ///< by which they are turned, radians
};
/// Throws Error where the plan has no such storey.
DrawnPlan drawn_plan(const FloorPlan& plan, const PlanDrawing& drawing);

/// A sheet with these storeys, an SVG file; without storeys it says so. `remark` stands behind the note on its frame.
std::string svg_sheet(const FloorPlan& plan, const DrawnPlan& drawn, const Sheet& sheet, const PlanDrawing& drawing,
                      const std::string& remark = {});

}  // namespace atrium::floorplan
