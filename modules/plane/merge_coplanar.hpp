#pragma once
#include "graph/api/node.hpp"
#include "modules/types/plane_primitives.hpp"

namespace atrium::plane {

/// Joins primitives that are pieces of one plane: a wall on both sides of a door, a floor through all rooms, the two
/// sheets of a wall that drifting scanner positions saw, the slivers that a search for planes leaves beside a large
/// one.
///
/// Two primitives that face the same way are one plane if the plane fitted to both is nowhere further than `distance`
/// from either of them within its bounding rectangle. So a small piece may be turned by more than a large one, and a
/// step of a centimetre stays a step where it is more than the noise. Whether they touch does not matter. Planes that
/// look the same way and lie one before the other cannot both have been seen: these are sheets of one surface (drift, a
/// picture on a wall), and may be sheet_distance apart. The largest take the others, each the one that it fits best,
/// until nothing changes; a piece that stands off by more than twice the noise does not move the plane of one that is
/// at least twice as large.
///
/// Primitives without points are dropped. No random numbers; the order of primitives of different size does not matter.
/// Source: co-planar clustering as in A. Monszpart et al., RAPter: Rebuilding Man-made Scenes with Regular Arrangements
/// of Planes, ACM TOG 34(4), 2015, without its global optimisation.
struct MergeCoplanar {
  static constexpr std::string_view type = "plane.merge_coplanar";
  static constexpr std::string_view summary = "Joins primitives that are pieces of one plane.";
  struct In {
    Input<PlanePrimitives> planes;
  };
  struct Out {
    PlanePrimitives planes;
  };
  struct Params {
    double distance = 0;
    double sheet_distance = 0.08;
    double layer_distance = 0.2;
    double angle = 10;
  };
  static constexpr auto inputs = std::tuple{port<&In::planes>("Primitives; normals to the side seen.")};
  static constexpr auto outputs =
      std::tuple{port<&Out::planes>("Primitives over the same cloud, by falling number of inliers.")};
  static constexpr auto params = std::tuple{
      param<&Params::distance>(
          metres, within(0, 10),
          "Largest distance between a primitive and the joint plane, within its bounding rectangle. 0: three times "
          "the noise (the mean residual of the primitives), at least 5 mm."),
      param<&Params::sheet_distance>(metres, within(0, 10),
                                     "The same for planes one before the other: less than the thinnest wall."),
      param<&Params::layer_distance>(
          metres, within(0, 10),
          "The same for planes whose points stand one before the other: layers of one surface that drift has parted. A "
          "cupboard hides the wall behind it, so it is none."),
      param<&Params::angle>(degrees, within(0, 45), "Largest angle between the normals of one plane.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::plane
