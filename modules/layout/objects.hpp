#pragma once
#include "graph/api/node.hpp"
#include "modules/types/building.hpp"
#include "modules/types/structure.hpp"

namespace atrium::layout {

/// The points of what stands in the rooms: furniture, and all else that is no surface of the building.
///
/// A point counts if it is inside of a room, or at most `reach` outside of it; further than `distance` from every face;
/// and in no reveal, the prism that an opening cuts through its wall (one wall's thickness deep, `reveal_depth` where
/// that is not known), made larger by `distance` on all sides. All columns of the cloud are kept. No random numbers.
///
/// Errors: faces with corners that are not there.
struct Objects {
  static constexpr std::string_view type = "layout.objects";
  static constexpr std::string_view summary = "The points in the rooms that belong to no face and no reveal.";
  struct In {
    Input<Building> building;
    Input<Structure> structure;
  };
  struct Out {
    Cloud cloud;
  };
  struct Params {
    double distance = 0.04;
    double reach = 0;
    double reveal_depth = 0.5;
  };
  static constexpr auto inputs =
      std::tuple{port<&In::building>("Closed rooms, with openings."),
                 port<&In::structure>("The points, in the building's frame: those that the layout was made from.")};
  static constexpr auto outputs = std::tuple{port<&Out::cloud>("Points of objects, in the building's frame.")};
  static constexpr auto params =
      std::tuple{param<&Params::distance>(metres, within(0, 1), "Points this near to a face belong to it."),
                 param<&Params::reach>(metres, within(0, 10), "How far outside of the rooms points still count."),
                 param<&Params::reveal_depth>(metres, within(0, 10),
                                              "Depth of the reveal where only one face of a wall is known.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::layout
