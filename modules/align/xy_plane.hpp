#pragma once
#include "graph/api/node.hpp"
#include "modules/types/plane_primitives.hpp"

namespace atrium::align {

/// What counts more in the choice of the dominant direction.
enum class DirectionWeight { area, points };

/// Turns the scene about z until its walls are along x and y as well as they can be (paper, "Alignment"; Manhattan
/// world, Coughlan and Yuille 1999).
///
/// Every wall normal has an angle modulo 90°. The dominant direction is the one with the greatest weight of walls
/// within `tolerance` of it, refined to their weighted mean; other walls (slanted, oblique) have no say. If less than
/// `min_share` of the weight lies there, the scene has no dominant direction: it is left as it is, and the log says so.
/// The turn is in (−45°, 45°]. Only wall normals' directions are used, so the result does not depend on which side
/// walls were seen from.
struct XyPlane {
  static constexpr std::string_view type = "align.xy_plane";
  static constexpr std::string_view summary = "Turns the scene about z until its walls are along x and y.";
  struct In {
    Input<PlanePrimitives> planes;
    OptionalInput<Transform> transform;
  };
  struct Out {
    SharedOutput<PlanePrimitives> planes;
    Transform transform;
  };
  struct Params {
    double wall_angle = 85;
    double tolerance = 5;
    double min_share = 0.3;
    DirectionWeight weight = DirectionWeight::area;
  };
  static constexpr auto inputs =
      std::tuple{port<&In::planes>("Primitives, z up."),
                 port<&In::transform>("What earlier alignments did to them: input frame to their frame.")};
  static constexpr auto outputs = std::tuple{port<&Out::planes>("The primitives and their cloud, walls along x and y."),
                                             port<&Out::transform>("From the input frame to that of `planes`.")};
  static constexpr auto params = std::tuple{
      param<&Params::wall_angle>(
          degrees, within(45, 90),
          "Planes whose normal is further than this from z are walls (paper, segmentation: 85 degrees)."),
      param<&Params::tolerance>(degrees, within(0.1, 22.5), "Walls this near to the dominant direction belong to it."),
      param<&Params::min_share>(
          ratio, within(0, 1),
          "Least share of the walls' weight that makes a direction dominant; in a round room each has about 0.1."),
      param<&Params::weight>(
          {{"area", DirectionWeight::area}, {"points", DirectionWeight::points}},
          "What a wall counts by: area (of the rectangle with the same second moments as its points) is independent of "
          "where the scanner stood.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::align
