#pragma once
#include <vector>

#include "modules/layout/face_grid.hpp"
#include "modules/layout/raster.hpp"

namespace atrium::layout {

/// What the scan says for and against a room. Shares are 0 to 1.
struct RoomEvidence {
  double walls = 0;        ///< of its walls' area, without openings, that was seen
  double enclosed = 0;     ///< of its walls' length at which some of the wall was seen
  double contact = 0;      ///< of that length: where the seen wall stands on a seen floor or reaches a seen ceiling
  double floor = 0;        ///< of its floor that was seen
  double ceiling = 0;      ///< of its ceiling that was seen
  double headroom = 0;     ///< greatest height over a square metre (all of a smaller room), metres
  double width = 0;        ///< twice its area over its perimeter, metres: half of the width of a square, the width of a
                           ///< long room
  double inner_walls = 0;  ///< length of walls that stand in it, floor to ceiling, over its perimeter
  double other_floor = 0;  ///< of its floor that was not seen, and over which another floor was
  double other_ceiling = 0;  ///< of its ceiling that was not seen, and under which another ceiling was
  double open_part = 0;      ///< the largest piece of its floor with no ceiling seen over it, where others have one
  double open_top = 0;       ///< metres of its walls that end below a ceiling which goes on behind them
  double overlap = 0;        ///< of its area that another room has, too
};

/// One entry per room. Building and planes have one origin, z up. `walls`: the planes' footprints with their open tops
/// (find_open_tops).
std::vector<RoomEvidence> room_evidence(const Building& building, const PlanePrimitives& planes,
                                        const std::vector<FaceGrid>& grids, const std::vector<Footprint>& walls);

}  // namespace atrium::layout
