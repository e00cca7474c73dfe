#pragma once
#include "graph/api/node.hpp"
#include "modules/types/floor_plan.hpp"
#include "modules/types/ground_truth.hpp"
#include "modules/types/metrics.hpp"

namespace atrium::metric {

/// Rooms of a floor plan against the true ones: precision, recall and F1 of rooms, corners and angles, after the
/// floor-plan literature (Floor-SP, Chen et al. 2019; MonteFloor, Stekovic et al. 2021, whose program HEAT, Chen et al.
/// 2022, and RoomFormer, Yue et al. 2023, use too), in metres.
///
/// - Rooms match if the intersection of their polygons is more than `min_iou` of their union and their floors are
/// within
///   max_height of each other. Pairs are taken by falling share (IoU), each room once. Above one half no other choice
///   would match more, as long as the rooms of each side do not overlap.
/// - Corners match within matched rooms, if they are at most corner_distance apart: pairs are taken by rising distance,
///   each corner once. Corners that lie within 1 mm of the line of their neighbours are none.
/// - Angles match where corners match and the room's inner angles there differ by at most max_angle.
///
/// Precision is the share of the plan's rooms (corners, angles) that match, recall that of the true ones, F1 twice the
/// matches over the sum of both. Rooms of an open or self-crossing outline count as found and match nothing.
///
/// The literature does this on images of 256 × 256 pixels that the building fills, IoU above 0.5, corners within 10
/// pixels, angles within 5°. Ten pixels of a building E metres wide are E / 25.6 m or more: 0.4 m for a flat of 10 m.
/// The default of 10 cm asks for more; corner_distance = E / 25.6 asks for the same. Differences: MonteFloor takes the
/// true rooms by falling area, the best IoU for each; matches corners in the order of the outline; and counts a found
/// room that overlaps another found room by more than two pixels as wrong.
///
/// Metrics: rooms.{true,found,matched,precision,recall,f1}, the same under rooms.corners and rooms.angles;
/// rooms.area.{true,found} in m2; and of what matches rooms.iou (mean), rooms.corners.error (mean distance, m) and
/// rooms.angles.error (mean, deg). What is undefined is left out: precision of nothing found, means of no match.
/// Errors: neither or both of truth and true_plan; a truth without rooms; coordinates that are not finite.
struct Rooms {
  static constexpr std::string_view type = "metric.rooms";
  static constexpr std::string_view summary = "Precision, recall and F1 of a floor plan's rooms, corners and angles.";
  struct In {
    Input<FloorPlan> plan;
    OptionalInput<GroundTruth> truth;
    OptionalInput<FloorPlan> true_plan;
  };
  struct Out {
    Metrics metrics;
  };
  struct Params {
    double min_iou = 0.5;
    double corner_distance = 0.1;
    double max_angle = 5;
    double max_height = 1;
  };
  static constexpr auto inputs =
      std::tuple{port<&In::plan>("What was found."),
                 port<&In::truth>("The true rooms, in the frame that the plan was made in; this or true_plan."),
                 port<&In::true_plan>(
                     "The true rooms as a plan of the same scan, its frame undone by its to_plan; this or truth.")};
  static constexpr auto outputs = std::tuple{port<&Out::metrics>("rooms.…: counts, shares, m, deg.")};
  static constexpr auto params = std::tuple{
      param<&Params::min_iou>(ratio, within(0, 1), "Rooms match above this intersection over union."),
      param<&Params::corner_distance>(metres, within(0, 100), "Corners match within it."),
      param<&Params::max_angle>(degrees, within(0, 180), "Angles match within it."),
      param<&Params::max_height>(metres, within(0, 100), "Rooms further apart in height are of different storeys."),
  };
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::metric
