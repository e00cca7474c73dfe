#pragma once
#include <vector>

#include "modules/layout/raster.hpp"
#include "modules/types/plane_primitives.hpp"

namespace atrium::layout {

constexpr double least_raised = 3.0;      ///< m²: a smaller level surface over the floor is furniture
constexpr double large_raised = 5.0;      ///< m²: beds are smaller
constexpr double bed_height = 1.0;        ///< m: beds are lower
constexpr double least_sheltered = 0.25;  ///< of a floor: less of it than this is the ground outside

/// How far a floor is part of a building, told by what stands over and around it: the ground outside that a scan shows
/// through windows can be larger than all rooms.
class Shelter {
 public:
  /// `footprints`: of the planes. Nothing is copied: both must outlive this.
  Shelter(const PlanePrimitives& planes, const std::vector<Footprint>& footprints, double min_clearance);

  /// Share of a floor's squares that lie `min_clearance` or more under a surface that looks down.
  double covered(std::size_t floor) const;
  /// Share of a floor's squares that lie less than `min_clearance` under the lowest surface of 2 m² or more over them.
  double under_low_ceiling(std::size_t floor) const;
  /// Share of directions, from places of the floor and level with its walls, in which a wall stands that looks towards
  /// the place, with no wall's back before it. Near 1 in rooms, whatever their size; below 0.5 beside a facade.
  double enclosed(std::size_t floor) const;
  /// Whether a level surface over a floor is one, too: one can stand on most of it, and walls stand around its largest
  /// connected piece. Around one of a bed's size on all sides, since a bed often fills an alcove.
  bool raised(std::size_t floor) const;

 private:
  /// The largest connected piece of a floor.
  struct Piece {
    double area = 0;    ///< square metres
    double walled = 0;  ///< share of its rim along which walls stand on it and look towards it: near 1 in a room, 0.5
                        ///< of a bed in a corner
  };
  Piece largest_piece(std::size_t floor) const;
  struct Wall {
    Eigen::Vector2d a, b;    ///< ends in plan
    Eigen::Vector2d normal;  ///< towards the side that it was seen from
    double low, high;        ///< heights, metres
  };
  bool at_wall(const Eigen::Vector2d& p, double height, double pixel) const;
  bool faces(const Eigen::Vector2d& from, const Eigen::Vector2d& direction, double height) const;

  const PlanePrimitives& planes_;
  const std::vector<Footprint>& footprints_;
  double min_clearance_;
  std::vector<Wall> walls_;
  std::vector<std::size_t> down_;  ///< planes that look down
};

}  // namespace atrium::layout
