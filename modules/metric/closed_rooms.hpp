#pragma once
#include "graph/api/node.hpp"
#include "modules/types/ground_truth.hpp"
#include "modules/types/mesh.hpp"
#include "modules/types/metrics.hpp"

namespace atrium::metric {

/// How many true rooms a model has as closed volumes of their own.
///
/// A shell is a component of the mesh (faces that hang together over edges; vertices of exactly equal coordinates are
/// one) that is closed, 2-manifold along its edges, consistently oriented and passes nowhere through itself by more
/// than 1 mm, which rounded coordinates may; it may look inwards or outwards. A room and a shell match if the
/// intersection of their volumes is more than `min_iou` of their union. Pairs are taken by falling share (IoU), each
/// room and shell once: four rooms in one shell are none, and neither is a box around them. True rooms are closed at
/// their doors and windows by the openings' outlines. Volumes are exact, intersections are counted at `samples` places
/// per room: an IoU of one half is known to within 0.005.
///
/// Metrics: closed_rooms.{true,left_out,shells,matched}, closed_rooms.recall = matched / true, closed_rooms.iou (mean
/// of what matches; left out where nothing does). True rooms that their faces and openings do not close are left out:
/// counted as left_out, with a warning. Faces of the class object are left out. Errors: a vertex that is not finite, a
/// triangle of vertices that do not exist; a truth without closed rooms.
struct ClosedRooms {
  static constexpr std::string_view type = "metric.closed_rooms";
  static constexpr std::string_view summary = "True rooms that a model has as closed volumes of their own.";
  struct In {
    Input<Mesh> mesh;
    Input<GroundTruth> truth;
  };
  struct Out {
    Metrics metrics;
  };
  struct Params {
    double min_iou = 0.5;
    std::int64_t samples = 20'000;
  };
  static constexpr auto inputs = std::tuple{port<&In::mesh>("The model, in the truth's frame."),
                                            port<&In::truth>("The true rooms: their faces and openings.")};
  static constexpr auto outputs = std::tuple{port<&Out::metrics>("closed_rooms.…: counts and shares.")};
  static constexpr auto params = std::tuple{
      param<&Params::min_iou>(ratio, within(0, 1), "Volumes match above this intersection over union."),
      param<&Params::samples>(count, within(100, 1e7), "Places at which a room's box is probed."),
  };
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::metric
