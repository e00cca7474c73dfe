#pragma once
#include "graph/api/node.hpp"
#include "modules/types/plane_primitives.hpp"

namespace atrium::plane {

/// Turns planes whose surroundings say that they look the other way: free space tells the side from which a surface was
/// seen, and errs where a closet is narrower than the void beside it.
///
/// - A level plane is turned if at least `majority` times as many points lie in its plane (within `apart`) and look to
///   the other side, and the walls say so, too: of the points of upright planes over and under it, within 10 cm
///   of its bounding box and 10 cm to 1 m from its height, at least four fifths are on that side. A floor at the very
///   height of the ceiling next door is as rare as a closet is common.
/// - An upright plane is turned if, 15 cm behind at least `inside` of its places, there are a floor below and a ceiling
///   above, and before hardly any place there are, but another upright plane nearer than walls are thick: rooms have
///   both, the inside of a wall has neither.
///
/// Floors and ceilings count up to 4 m below and above a place: walls of higher halls with racks right before them and
/// rooms behind may be turned.
///
/// The frame's z is up. Points, sizes and order of the primitives do not change. Cost: pairs of level planes, a pass
/// over the points of upright planes for each level one that may be turned, and at most 127 places of each upright
/// plane. No random numbers.
struct CheckSides {
  static constexpr std::string_view type = "plane.check_sides";
  static constexpr std::string_view summary =
      "Turns planes that floors, ceilings and walls around say look the other way.";
  struct In {
    Input<PlanePrimitives> planes;
  };
  struct Out {
    PlanePrimitives planes;
  };
  struct Params {
    double majority = 4;
    double apart = 0.015;
    double inside = 0.6;
  };
  static constexpr auto inputs = std::tuple{port<&In::planes>("Primitives, z up; normals to the side seen.")};
  static constexpr auto outputs = std::tuple{port<&Out::planes>("The same primitives, some of them turned.")};
  static constexpr auto params = std::tuple{
      param<&Params::majority>(ratio, within(1, 1e6),
                               "How many times as many points at the height of a level plane must look the other way."),
      param<&Params::apart>(metres, within(0, 1), "Level planes that differ by less in height are one."),
      param<&Params::inside>(ratio, within(0.5, 1),
                             "Share of an upright plane's places that must have floor and ceiling behind them.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::plane
