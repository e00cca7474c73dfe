#pragma once
#include "graph/api/node.hpp"
#include "modules/types/building.hpp"
#include "modules/types/structure.hpp"

namespace atrium::layout {

/// Finds doors, windows and holes in slabs: where a face must have been hit if it were solid, and was not.
///
/// - A square of a face is a hole if no point lies within `tolerance` of it although it was in sight: the way from it
///   to a place of the scanner in its room is free (of occupied voxels). Without known places of the scanner, to most
///   of a grid of places 1.5 m above the room's floor. What furniture hides is no hole, and neither is a hole
///   behind which nothing was seen, not even its reveal.
/// - Connected squares are an opening if they fill min_fill of their rectangle, which is min_width wide and min_height
///   high at least (in floors and ceilings: both min_slab_width). Its sides are moved to where the points of the face
///   begin around it. A rectangle that begins within sill_height over its face's foot is a door and reaches the foot;
///   others are windows.
/// - Openings of two faces back to back that lie over each other are one: it joins their rooms, and has the thickness
///   of the wall. If only one face shows it and the other is there and unseen at that place, it goes through as well.
///
/// The wall pairs (two faces back to back at most max_thickness apart, with their overlap) are written too. No random
/// numbers. Source: occlusion reasoning after A. Adan, D. Huber, 3D reconstruction of interior wall surfaces under
/// occlusion and clutter, 3DIMPVT 2011, without learned openings.
struct Openings {
  static constexpr std::string_view type = "layout.openings";
  static constexpr std::string_view summary = "Finds doors, windows and slab openings where faces were seen through.";
  struct In {
    Input<Building> building;
    Input<Structure> structure;
  };
  struct Out {
    Building building;
  };
  struct Params {
    double pixel = 0.05;
    double tolerance = 0.05;
    double min_width = 0.4;
    double min_height = 0.4;
    double min_slab_width = 0.7;
    double min_fill = 0.7;
    double sill_height = 0.2;
    double max_thickness = 0.6;
  };
  static constexpr auto inputs =
      std::tuple{port(&In::building, "building", "Closed rooms."),
                 port(&In::structure, "structure", "The points, in the building's frame, with the scanner's places.")};
  static constexpr auto outputs = std::tuple{port(&Out::building, "building", "The same with openings and walls.")};
  static constexpr auto params = std::tuple{
      param(&Params::pixel, "pixel", metres, within(0.01, 1),
            "Least edge of the squares; scans that do not fill them have larger ones."),
      param(&Params::tolerance, "tolerance", metres, within(0.001, 1), "Points this near to a face lie on it."),
      param(&Params::min_width, "min_width", metres, within(0.05, 10), "Of an opening in a wall."),
      param(&Params::min_height, "min_height", metres, within(0.05, 10), "Of an opening in a wall."),
      param(&Params::min_slab_width, "min_slab_width", metres, within(0.05, 10),
            "Of an opening in a floor or ceiling."),
      param(&Params::min_fill, "min_fill", ratio, within(0, 1), "Share of an opening's rectangle that is a hole."),
      param(&Params::sill_height, "sill_height", metres, within(0, 10), "Lower openings are doors."),
      param(&Params::max_thickness, "max_thickness", metres, within(0.01, 10), "Of a wall or slab.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::layout
