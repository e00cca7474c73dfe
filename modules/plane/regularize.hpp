#pragma once
#include "graph/api/node.hpp"
#include "modules/types/plane_primitives.hpp"

namespace atrium::plane {

/// Makes planes that are vertical, horizontal, parallel or perpendicular within their uncertainty exactly so.
///
/// A plane is turned only if no place of its bounding rectangle is moved by more than `distance` and the angle is at
/// most `angle`; it turns about the middle of its points, so it stays amidst them. In this order:
///
/// 1. Nearly vertical planes become vertical, nearly horizontal ones horizontal (z is up).
/// 2. Vertical planes: their directions modulo 90° are gathered into families, the widest surfaces first; each plane
///    within reach takes the mean direction of its family, weighted by what its points tell of it (their number times
///    their variance along the wall).
/// 3. Other planes that are parallel (or the mirror image, as the two sides of a roof) within reach take the same
/// slope:
///    the mean of their tilts and headings, each weighted by what its points tell of it.
///
/// No random numbers. Errors: none; without planes there is nothing to do. Source: after regularization in F. Lafarge,
/// C. Mallet, Creating large-scale city models from 3D-point clouds, IJCV 99, 2012 (parallelism, orthogonality), with
/// displacement in the place of fixed angles.
struct Regularize {
  static constexpr std::string_view type = "plane.regularize";
  static constexpr std::string_view summary = "Makes nearly vertical, horizontal, parallel or perpendicular planes so.";
  struct In {
    Input<PlanePrimitives> planes;
  };
  struct Out {
    PlanePrimitives planes;
  };
  struct Params {
    double distance = 0;
    double angle = 5;
  };
  static constexpr auto inputs = std::tuple{port<&In::planes>("Primitives, z up.")};
  static constexpr auto outputs =
      std::tuple{port<&Out::planes>("The same primitives with other planes and residuals.")};
  static constexpr auto params = std::tuple{
      param<&Params::distance>(
          metres, within(0, 10),
          "By how much a place on a primitive may move. 0: twice the noise (the mean residual of the primitives), at "
          "least 1 cm."),
      param<&Params::angle>(degrees, within(0, 45), "By how much a plane may turn.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::plane
