#pragma once
#include "graph/api/node.hpp"
#include "modules/types/building.hpp"
#include "modules/types/structure.hpp"

namespace atrium::layout {

/// Finds doors, passages, windows and holes in slabs: where a face must have been hit if it were solid, and was not.
///
/// - A square of a face is solid if points lie on it (within `tolerance`, or thrice the face's noise; in thin walls at
///   most a third of their thickness) or around it as densely as they do there; if the face behind it in the same wall
///   is solid there; else it is hidden.
/// - A hidden square is a hole if points behind the face show through it (by the ways from the scanner's places in the
///   room; without these, points between the wall's faces), or if the way from there to such a place is free. Without
///   known places, to a quarter of a grid of places 1.5 m above the room's floor, of those that do not graze the face.
///   Surfaces stop ways however sparse they are, single points do not. What is a hole in one face and hidden in the one
///   behind it is a hole in both.
/// - Of each connected part the rectangles that hold the most holes and the fewest solid squares are openings if they
///   are min_width wide and min_height high (in floors and ceilings: both min_slab_width), if min_fill of them is a
///   hole (hidden squares count half), and if something shows through them, more than strays do: a reveal at least.
///   Their sides are moved to where the face's points begin around them, or to the jambs of the reveal.
/// - Panes often show nothing behind them. A gap in an outer wall is a window all the same if nine tenths of each side
///   of its rim were seen, most of it is in sight, it has 0.3 m² or more, and nothing stands up to 0.6 m before it. The
///   warning counts these, and gaps that are less clean, which are left closed.
/// - Closed doors, whose leaf hides what is behind it, are rectangles of a door's size on the wall's foot that stand 2
///   to 16 cm behind the wall around them, or 2 to 6 cm before it, with a clean rim (layout/closed_leaves.hpp); blinds
///   and panes above a sill likewise, 3 cm behind at least, in outer walls only. They are no doors if the wall is whole
///   on its other side, unless what is left of it there is as thick as a leaf (2 to 7 cm). The log names each with its
///   step and a confidence; those below 0.7 are warned of, those below 0.5 are left closed, with a warning.
/// - What begins within sill_height over its face's foot, or hides its foot and joins two rooms or has a leaf, is a
///   door and reaches the foot; wider than max_door_width it is a passage. Lower than min_door_height, it is
///   warned of; it is left out, with a warning, if it is lower than 1 m or less than 0.6 m wide, too. One that joins no
///   rooms, shows no leaf and has no floor beyond is glazed if it is higher than 2.4 m, or wider than 1.3 m and
///   1.8 m high: a window, as all others are. Else it is a door, or left out if it is low. Warnings count these.
/// - A room into which nothing else leads has its door in the narrowest of its glazed openings down to the floor of 2.1
///   by 2.5 m at most and its windows whose foot is hidden and that are 1.1 m wide at most; of the latter a warning
///   tells.
/// - Faces that are inferred, or of which less than 5 % was seen, have no openings of their own. Around an opening the
///   face must have been seen: on min_rim of a rim of 15 cm, on min_wide_rim of it for slabs and for what is wider than
///   max_door_width. These must have their rim on each side, wide openings in walls both jambs in the face. Openings
///   for which too little was seen are left out, and counted in the log.
/// - Rectangles of two faces back to back that lie over each other are one opening: it joins their rooms, and has the
///   thickness of the wall; each side is where more points say so.
///
/// Where no door stands on a floor, but windows hang from the ceiling as doors would upside down, a warning says so:
/// the scan's z may point down.
///
/// The wall pairs (two faces back to back at most max_thickness apart, with their overlap) are written too. Faces of no
/// room have no openings. The building and the cloud may have different origins. Errors: an index in the building of
/// what is not there, a face of fewer than three corners, a number that is not finite. No random numbers. Source:
/// occlusion reasoning after A. Adan, D. Huber, 3D reconstruction of interior wall surfaces under occlusion and
/// clutter, 3DIMPVT 2011, without learned openings.
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
    double min_door_height = 1.5;
    double max_thickness = 0.6;
    double max_door_width = 2;
    double min_rim = 0.3;
    double min_wide_rim = 0.6;
  };
  static constexpr auto inputs =
      std::tuple{port<&In::building>("Closed rooms."),
                 port<&In::structure>("The points, in the building's frame, with the scanner's places.")};
  static constexpr auto outputs = std::tuple{port<&Out::building>("The same with openings and walls.")};
  static constexpr auto params =
      std::tuple{param<&Params::pixel>(metres, within(0.01, 1), "Edge of the squares that a face is divided into."),
                 param<&Params::tolerance>(metres, within(0.001, 1), "Points this near to a face lie on it."),
                 param<&Params::min_width>(metres, within(0.05, 10), "Of an opening in a wall."),
                 param<&Params::min_height>(metres, within(0.05, 10), "Of an opening in a wall."),
                 param<&Params::min_slab_width>(metres, within(0.05, 10), "Of an opening in a floor or ceiling."),
                 param<&Params::min_fill>(ratio, within(0, 1), "Share of an opening's rectangle that is a hole."),
                 param<&Params::sill_height>(metres, within(0, 10), "Lower openings are doors."),
                 param<&Params::min_door_height>(metres, within(0, 10), "Lower doors are warned of, or left out."),
                 param<&Params::max_thickness>(metres, within(0.01, 10), "Of a wall or slab."),
                 param<&Params::max_door_width>(metres, within(0.1, 100), "What is wider is a passage."),
                 param<&Params::min_rim>(ratio, within(0, 1), "Share of the rim around an opening that was seen."),
                 param<&Params::min_wide_rim>(ratio, within(0, 1),
                                              "The same for slabs, and for openings wider than max_door_width.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::layout
