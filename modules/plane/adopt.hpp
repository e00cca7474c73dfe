#pragma once
#include "graph/api/node.hpp"
#include "modules/types/plane_primitives.hpp"

namespace atrium::plane {

/// Gives points that belong to no primitive to the planes that they lie on.
///
/// A search for planes leaves out what is sparse or stands alone beyond a gap: the far end of a wall, the strip of
/// floor behind a table. Each free point within `distance` of a plane, and within `reach` of the bounding rectangle of
/// its primitive, joins the nearest such primitive, unless it was seen from behind (by the scanner's place, or by its
/// normal, where the cloud knows one of them and its primitive's normals agree). Planes are fitted no more; residuals
/// are those of all points. No random numbers.
struct Adopt {
  static constexpr std::string_view type = "plane.adopt";
  static constexpr std::string_view summary = "Gives points of no primitive to the planes that they lie on.";
  struct In {
    Input<PlanePrimitives> planes;
  };
  struct Out {
    PlanePrimitives planes;
  };
  struct Params {
    double distance = 0;
    double reach = 0.5;
  };
  static constexpr auto inputs = std::tuple{port<&In::planes>("Primitives.")};
  static constexpr auto outputs = std::tuple{port<&Out::planes>("The same primitives with more inliers.")};
  static constexpr auto params =
      std::tuple{param<&Params::distance>(
                     metres, within(0, 10),
                     "Of a point from its plane. 0: three times the noise (the mean residual of the primitives)."),
                 param<&Params::reach>(metres, within(0, 1000), "Of a point beyond the rectangle of its primitive.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::plane
