#pragma once
#include "graph/api/node.hpp"
#include "modules/types/cloud.hpp"

namespace atrium::filter {

/// Keeps the scanner's positions that the points confirm, and finds a single one that the file does not name.
///
/// - Several positions, each point with its own (`source`): believed if the way from the position is free for most of
///   the points that it is said to have seen. Else all are left out, with a warning.
/// - One position for all points (a PCD's VIEWPOINT, `sensor: origin` of io.read_scan), or none: is the cloud
/// star-shaped
///   about it, or about the file's origin? The directions around the place are cut into bins of about 2°; the share of
///   bins whose furthest point is seen freely from there is .75 to .95 for single positions and below .4 for maps
///   of several. A named position that fails is left out, with a warning; the file's origin that passes becomes the
///   position.
///
/// Points do not change. A way is free if no voxel on its first four fifths is filled as surfaces fill them (a fifth of
/// what the voxel of the median point holds): near its end it may graze the surface that it was aimed at. Cost: linear
/// in the points; at most 20,000 ways. No random numbers.
struct Positions {
  static constexpr std::string_view type = "filter.positions";
  static constexpr std::string_view summary = "Keeps the scanner positions that the points confirm.";
  struct In {
    Input<Cloud> cloud;
  };
  struct Out {
    SharedOutput<Cloud> cloud;
  };
  struct Params {
    double min_free = 0.5;
    double min_visible = 0.7;
  };
  static constexpr auto inputs = std::tuple{port<&In::cloud>("Points with any columns.")};
  static constexpr auto outputs =
      std::tuple{port<&Out::cloud>("The same points; the positions that are believed, with or without `source`.")};
  static constexpr auto params = std::tuple{
      param<&Params::min_free>(
          unitless, within(0, 1),
          "Share of free ways between points and their own positions from which on these are believed."),
      param<&Params::min_visible>(
          unitless, within(0, 1),
          "Share of directions from which on a cloud is taken for that of one position; above 1 is never reached, so "
          "1 all but switches this off.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::filter
