#pragma once
#include "graph/api/node.hpp"
#include "modules/types/building.hpp"
#include "modules/types/ground_truth.hpp"
#include "modules/types/metrics.hpp"

namespace atrium::metric {

/// Doors, windows and holes in slabs of a building against the true ones: precision, recall and F1.
///
/// An opening matches a true one of the same kind if the intersection of their outlines, both projected onto the true
/// wall's plane, is more than `min_iou` of their union, and if its plane is within max_angle of the true one's and
/// within max_distance of the true wall: of the space between the wall's faces, so that either side of a wall will do.
/// Of an opening that has an outline on both sides the better one counts. Pairs are taken by falling share (IoU), each
/// opening once: a door that was found twice, once from each room, is one match and one opening too many.
///
/// Metrics: openings.{true,found,matched,precision,recall,f1} of all kinds, and under openings.<kind> of those kinds
/// that either side has (door, window, slab; a passage counts as a door);
/// openings.any_kind.{matched,precision,recall,f1}, for which a window may be called a door; of what matches
/// openings.iou (mean) and openings.joined: the share that joins the right rooms. Rooms are the same where their floors
/// are within 1 m in height and share more than half of their union. What is undefined is left out: precision of
/// nothing found. Openings whose outline is no simple polygon count as found, match nothing and are warned of. Errors:
/// coordinates that are not finite.
struct Openings {
  static constexpr std::string_view type = "metric.openings";
  static constexpr std::string_view summary = "Precision, recall and F1 of a building's doors, windows and slab holes.";
  struct In {
    OptionalInput<Building> building;
    Input<GroundTruth> truth;
    OptionalInput<Transform> transform;
  };
  struct Out {
    Metrics metrics;
  };
  struct Params {
    double min_iou = 0.5;
    double max_angle = 30;
    double max_distance = 0.2;
  };
  static constexpr auto inputs = std::tuple{
      port<&In::building>("What was found; nothing, where it is not wired."), port<&In::truth>("The true openings."),
      port<&In::transform>("From the truth's frame to the building's; without it they are the same.")};
  static constexpr auto outputs = std::tuple{port<&Out::metrics>("openings.…: counts and shares.")};
  static constexpr auto params = std::tuple{
      param<&Params::min_iou>(ratio, within(0, 1), "Outlines match above this intersection over union."),
      param<&Params::max_angle>(degrees, within(0, 90), "Between the planes of openings that match."),
      param<&Params::max_distance>(metres, within(0, 10), "Between an opening and the true wall."),
  };
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::metric
