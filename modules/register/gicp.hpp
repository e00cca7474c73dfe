#pragma once
#include <cstdint>
#include <vector>

#include "graph/api/node.hpp"
#include "modules/types/cloud.hpp"
#include "modules/types/metrics.hpp"
#include "modules/types/poses.hpp"

namespace atrium::registration {

enum class Coarse { none, yaw_search };

/// Brings several scans into the frame of the first by Generalized ICP (Segal, Haehnel, Thrun 2009; PCL's), the paper's
/// data set preparation. Each scan is registered to all before it; copies thinned to one point per `voxel` are used for
/// that, and the result holds all points.
///
/// Start poses come from `initial`, and with coarse: yaw_search from the walls: both scans' upright surfaces are
/// projected to the ground, and each yaw votes for the shift that brings most of them together (scans must be level, z
/// up); the best few starts are refined and the one with the largest overlap is taken. GICP alone finds poses some
/// decimetres and degrees off.
///
/// The result has the columns that all scans have (a warning names what is dropped), the first one's origin, and all
/// sensors; a point's source tells its scan. Scans without sensors make the result have none. Metrics, per scan after
/// the first: register.<i>.overlap (share of its thinned points with a neighbour within max_correspondence_distance),
/// register.<i>.median_distance and .rms (of those). Warns below 20 % overlap and where GICP did not converge.
///
/// Throws Error if a scan has fewer than 30 thinned points, or `initial` has the wrong length.
struct Gicp {
  static constexpr std::string_view type = "register.gicp";
  static constexpr std::string_view summary = "Registers several scans into the frame of the first.";
  struct In {
    Inputs<Cloud> clouds;
  };
  struct Out {
    Cloud cloud;
    Poses poses;
    Metrics metrics;
  };
  struct Params {
    double max_correspondence_distance = 0.5;
    std::int64_t iterations = 100;
    double translation_epsilon = 1e-4;
    double rotation_epsilon = 0.01;
    double voxel = 0.1;
    Coarse coarse = Coarse::none;
    std::vector<double> initial;
  };
  static constexpr auto inputs = std::tuple{port<&In::clouds>("Scans, the first gives the frame.")};
  static constexpr auto outputs = std::tuple{port<&Out::cloud>("All points, in the first scan's frame."),
                                             port<&Out::poses>("Per scan the motion into the first one's frame."),
                                             port<&Out::metrics>("Overlap and distances per scan.")};
  static constexpr auto params = std::tuple{
      param<&Params::max_correspondence_distance>(metres, within(0.001, 100),
                                                  "Points further apart are never taken for the same place."),
      param<&Params::iterations>(count, within(1, 10000), "At most so many rounds."),
      param<&Params::translation_epsilon>(metres, within(1e-9, 1), "Ends when a round moves the scan by less."),
      param<&Params::rotation_epsilon>(degrees, within(1e-6, 10), "Ends when a round turns the scan by less."),
      param<&Params::voxel>(metres, within(0.001, 10), "Spacing of the points that are registered."),
      param<&Params::coarse>({{"none", Coarse::none}, {"yaw_search", Coarse::yaw_search}},
                             "How start poses are searched for."),
      param<&Params::initial>(
          unitless, unbounded,
          "Start poses: x y z (m) and yaw (deg about z) for each scan after the first. Empty: all stand alike.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::registration
