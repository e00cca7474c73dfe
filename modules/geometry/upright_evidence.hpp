#pragma once
#include <vector>

#include "modules/geometry/surface_pieces.hpp"
#include "modules/geometry/upright_axes.hpp"

namespace atrium {

/// What a scan shows if one direction is taken for up, as logarithms of likelihood ratios (natural; 1 is weak, 3 is
/// strong). Positive numbers speak for it, and each is bounded, so that no single kind decides against all others.
struct UprightEvidence {
  double heights = 0;      ///< clear heights and widths are those of rooms: ln of their density, so comparable only
  double structure = 0;    ///< surfaces are level or upright, none lies askew
  double cover = 0;        ///< what is level covers the plan
  double few_levels = 0;   ///< levels are few
  double furniture = 0;    ///< free level surfaces at the height of seats, tables and worktops above a floor
  double doors = 0;        ///< walls begin at the height of a door (or behind furniture) above a floor
  double clutter = 0;      ///< more that is plane stands on the floor than hangs from the ceiling; slopes are above
  double rough = 0;        ///< what is on no plane (cushions, plants, things on tables) is low, not high
  double floor = 0;        ///< if only one end was scanned, it is the floor
  double bound = 0;        ///< takes back what the five before it tell too surely where only one end was scanned
  double room_height = 0;  ///< metres: the median clear height; 0: no two levels face each other
  int furniture_seen = 0;  ///< how many square metres of plan show furniture of a usual height
  int doors_seen = 0;      ///< how many square metres of plan show a door's head at a usual height
  double sum() const {
    return heights + structure + cover + few_levels + furniture + doors + clutter + rough + floor + bound;
  }
};

/// A direction that may be up, and what speaks for it.
struct UprightCandidate {
  Eigen::Vector3d up;
  UprightEvidence evidence;
};

/// Candidates for up: both ways along each of upright_axes(), with what speaks for each. `faces` are the surfaces as a
/// whole, `points` the same in pieces (any number, thinned here); `scale`: metres per unit of both.
///
/// Nothing here uses on which side a surface was seen, since that is found out later and with the help of the vertical.
/// So the result turns with the scan: only the frame's own axes, which are candidates always, make a difference.
/// Cost: O(n log n) for n points, about 0.1 s for 150,000 pieces and three axes.
std::vector<UprightCandidate> upright_candidates(const std::vector<SurfacePiece>& points,
                                                 const std::vector<FacedArea>& faces, double scale,
                                                 const Context& context);

}  // namespace atrium
