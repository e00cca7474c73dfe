#pragma once
#include "graph/api/node.hpp"
#include "modules/types/building.hpp"
#include "modules/types/structure.hpp"

namespace atrium::layout {

/// Says how far each room can be trusted, and leaves out what is no room.
///
/// A room's `confidence` is the product of these shares, each 0 to 1 (what is between two limits is interpolated):
///
/// | share | 1 | lower | why |
/// |---|---|---|---|
/// | walls seen | from 40 % of their area | 0 at 8 % | the rest is inferred |
/// | enclosed: wall seen along the outline, up to a third of it | from 80 % of its length | 0 at 45 % | open sides |
/// | contact: seen wall on a seen floor or up to a seen ceiling | from 40 % of that length | 0 at 5 % | furniture |
/// | floor or ceiling seen, the better of both | from 50 % | 0 at 10 % | under 20 % of one: at most 0.85 |
/// | height over its best square metre | 2 to 5 m, or in halls | 0 at 1.2 m; 0.5 at 8 m; 0.4 above 15 m | units |
/// | area | from 0.9 m2 | 0 at 0.4 m2 | cupboards |
/// | width (2 area / perimeter) | from 0.4 m | 0 at 0.2 m | slits between two layers of a wall |
/// | walls in it, floor to ceiling | up to 4 % of its perimeter | 0.3 at 20 % | rooms that were not parted |
/// | walls that end below a ceiling which goes on behind them | up to 0.5 m | 0.6 at 3 m | fronts of cupboards |
/// | another floor over an unseen one, or ceiling under one | up to 20 % of its area | 0.3 at 60 % | wrong height |
/// | a piece of its floor without a ceiling over it, where the rest has one | up to 25 % | 0.7 at 50 % | outside |
/// | what stands in it stands in another room, too, mirrored at a wall | below 70 % | 0.3 | images in mirrors |
/// | rooms found in another way share its place (of both together) | from 80 % | 0.6 at 50 % | joined or parted |
/// | another room has the same place | up to 10 % of its area | 0.2 at 50 % | rooms overlap |
///
/// Squares of 25 cm are looked at, without openings; walls within 15 cm of their plane, floors and ceilings within 10
/// cm. In a hall, height is less than 0.45 times the root of the area. Other floors at the height of furniture (25 to
/// 95 cm) count if they have more than 5 m2. The reasons for shares below 0.9 stand in `doubts`, the gravest first.
///
/// The building's confidence is that of its rooms by area, times 1 if they hold 90 % or more of the floor that lies
/// under a ceiling 1.8 m or more above it, down to 0.3 if they hold 30 % of it (pieces of less than 2 m2 do not count);
/// times 1 down to 0.8 by the same shares of the floor that was seen beside the rooms between walls (FloorBeyond),
/// and, where there is such floor, by the share of rooms among rooms and doors that lead out, but one: 1 at 90 %, 0.6
/// at 30 %; times the likelihood of its vertical (Transform::upright); times 1 if sloping surfaces that are in no face
/// have 5 % of the rooms' area or less, down to 0.4 at 50 %; and, if the points of the faces are 8 cm apart or more
/// (the root of the observed area over their number), times 0.9 down to 0.4 at 20 cm. If 15 % of the walls or more were
/// seen twice (DoubledWalls), it is times 0.7 down to 0.4 at 60 %.
///
/// Rooms into which no opening but windows leads are a doubt, too, without weight: doors may be missed, or nobody has
/// looked for them.
///
/// Rooms below min_confidence are left out, with a warning that names place and reason; openings into them then lead
/// to what is not known. Storeys without rooms are left out, too. Rooms keep their names. Rooms below doubtful are
/// warned of. Errors: no room is left, or the building is below min_confidence: what the scan lacks; an index of what
/// is not there. No random numbers. The limits were chosen on simulated and real scans: share/doc/confidence.md.
struct Confidence {
  static constexpr std::string_view type = "layout.confidence";
  static constexpr std::string_view summary = "Says how far each room can be trusted, and leaves out what is no room.";
  struct In {
    Input<Building> building;
    Input<Structure> structure;
    OptionalInput<Transform> transform;
    OptionalInput<Building> second;
  };
  struct Out {
    Building building;
  };
  struct Params {
    double min_confidence = 0.15;
    double doubtful = 0.75;
  };
  static constexpr auto inputs =
      std::tuple{port<&In::building>("Closed rooms, with openings if these are known."),
                 port<&In::structure>("The planes and points that it was made from, in its frame."),
                 port<&In::transform>("From the frame in which warnings name places to that of the building."),
                 port<&In::second>("Rooms that were found in another way, in the building's frame (layout.surest).")};
  static constexpr auto outputs =
      std::tuple{port<&Out::building>("The rooms that are left, with confidence and doubts.")};
  static constexpr auto params = std::tuple{
      param<&Params::min_confidence>(ratio, within(0, 1), "Rooms (and buildings) below this are none; 0 keeps all."),
      param<&Params::doubtful>(ratio, within(0, 1), "Rooms below this are warned of.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::layout
