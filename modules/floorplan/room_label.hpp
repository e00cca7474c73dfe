#pragma once
#include "modules/types/floor_plan.hpp"

namespace atrium::floorplan {

/// The middle of the room's roomiest place for a box of the given proportions: of a raster of points, the one about
/// which the largest such box (in metres, `size` times the result's `scale`, at most 1) keeps clear of the room's edges
/// and of walls that stand in it.
struct LabelPlace {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  double scale = 0;  ///< 0: there is no place
};
/// Whether the room's confidence is known and low (below 0.5): its label then says so.
bool is_doubtful(const PlanRoom& room);
/// "confidence 0.37"
std::string confidence_text(const PlanRoom& room);

LabelPlace label_place(const PlanPolygon& room, const Eigen::Vector2d& size, const std::vector<PlanWall>& walls);

}  // namespace atrium::floorplan
