#pragma once
#include "graph/api/node.hpp"
#include "modules/types/cloud.hpp"

namespace atrium::plane {

/// Moves the scanner's positions until the planes that they share agree: takes out the drift that shows as double
/// walls.
///
/// The planes of each position are found by plane.region_growing in its own points (max_points of them, evenly chosen),
/// so that drift does not blur them. Planes of two positions that look the same way, lie over each other (min_overlap
/// of the smaller one's rectangle) and are at most max_offset apart are taken for one surface. The shifts of the
/// positions are the least squares solution for all these distances, weighted by the shared area, with Tukey's weights
/// against pairs that are none (a cupboard before a wall), the first position held, in three rounds. Rotations stay as
/// they are. Positions that share no surface with others do not move, nor does a position along directions in which no
/// surface holds it.
///
/// If half of the shared area agrees within half the noise already, or the cloud does not say which position saw which
/// point, nothing is changed. No random numbers. Source: plane-to-plane registration after K. Pathak et al., Fast
/// registration based on noisy planes with unknown correspondences for 3-D mapping, IEEE T-RO 26(3), 2010, translations
/// only.
struct RegisterPositions {
  static constexpr std::string_view type = "plane.register_positions";
  static constexpr std::string_view summary = "Moves the scanner's positions until the planes that they share agree.";
  struct In {
    Input<Cloud> cloud;
  };
  struct Out {
    SharedOutput<Cloud> cloud;
  };
  struct Params {
    double max_offset = 0.15;
    double max_angle = 5;
    double min_overlap = 0.3;
    std::int64_t max_points = 40000;
  };
  static constexpr auto inputs = std::tuple{port<&In::cloud>("Points with sensors and sources.")};
  static constexpr auto outputs = std::tuple{port<&Out::cloud>("The same points and sensors, moved.")};
  static constexpr auto params =
      std::tuple{param<&Params::max_offset>(metres, within(0, 10), "Of two planes of one surface."),
                 param<&Params::max_angle>(degrees, within(0, 45), "Between the normals of two such planes."),
                 param<&Params::min_overlap>(ratio, within(0, 1), "Of the smaller plane's rectangle."),
                 param<&Params::max_points>(count, within(1000, 1e9), "Of a position that planes are sought in.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::plane
