#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "modules/types/plane_primitives.hpp"

namespace atrium {

using PlanRing = std::vector<Eigen::Vector2d>;  ///< a closed polygon, first corner not repeated

/// A polygon of the plan: the outline counter-clockwise, holes clockwise.
struct PlanPolygon {
  static constexpr auto members() { return std::tuple{&PlanPolygon::outline, &PlanPolygon::holes}; }
  PlanRing outline;
  std::vector<PlanRing> holes;

  double area() const;  ///< without the holes, square metres
};

/// A straight piece of wall seen from above. Where both of its faces were seen it has a thickness and `outline` is the
/// space between them; where only one was, thickness is 0, `outline` is empty and the line is that face, seen from the
/// left of from → to.
struct PlanWall {
  static constexpr auto members() {
    return std::tuple{&PlanWall::from,       &PlanWall::to,       &PlanWall::thickness, &PlanWall::outline,
                      &PlanWall::primitives, &PlanWall::inferred, &PlanWall::corrected};
  }
  Eigen::Vector2d from = Eigen::Vector2d::Zero();  ///< the middle line (thickness > 0) or the seen face
  Eigen::Vector2d to = Eigen::Vector2d::Zero();
  double thickness = 0;                  ///< metres
  PlanRing outline;                      ///< counter-clockwise; reaches into the walls that it meets at its ends
  std::vector<std::int32_t> primitives;  ///< that it was made from
  bool inferred = false;                 ///< none of its faces was seen
  bool corrected = false;                ///< one of its faces was corrected by hand
};

/// A door or a window in a wall, or a hole in a slab, seen from above. `outline` is the gap in the wall, or the hole;
/// empty if only one face of the wall is known.
struct PlanOpening {
  static constexpr auto members() {
    return std::tuple{&PlanOpening::kind,      &PlanOpening::from,     &PlanOpening::to,   &PlanOpening::outline,
                      &PlanOpening::room_a,    &PlanOpening::room_b,   &PlanOpening::sill, &PlanOpening::height,
                      &PlanOpening::thickness, &PlanOpening::corrected};
  }
  std::string kind;  ///< "door", "passage", "window", "slab"
  Eigen::Vector2d from =
      Eigen::Vector2d::Zero();  ///< on the wall's middle line, or on its only face; of no use in slabs
  Eigen::Vector2d to = Eigen::Vector2d::Zero();
  PlanRing outline;          ///< counter-clockwise
  std::int32_t room_a = -1;  ///< index into the storey's rooms, left of from → to; −1: outside, or not known
  std::int32_t room_b = -1;  ///< the room on the right
  double sill = 0;           ///< lower edge over the storey's elevation, metres; of a slab its own height over it
  double height = 0;         ///< lower to upper edge, metres; 0 in slabs
  double thickness = 0;      ///< of the wall or slab, metres; 0: not known
  bool corrected = false;    ///< by hand

  double width() const { return (to - from).norm(); }
};

struct PlanRoom {
  static constexpr auto members() {
    return std::tuple{&PlanRoom::name, &PlanRoom::polygon, &PlanRoom::height, &PlanRoom::confidence,
                      &PlanRoom::corrected};
  }
  std::string name;
  PlanPolygon polygon;     ///< of its floor
  double height = 0;       ///< floor to ceiling, metres; 0: not known
  double confidence = -1;  ///< 0 to 1 (layout.confidence); -1: not known
  bool corrected = false;  ///< its shape, by hand
};

struct PlanStorey {
  static constexpr auto members() {
    return std::tuple{&PlanStorey::index, &PlanStorey::elevation, &PlanStorey::floor_known, &PlanStorey::height,
                      &PlanStorey::walls, &PlanStorey::bodies,    &PlanStorey::floors,      &PlanStorey::ceilings,
                      &PlanStorey::rooms, &PlanStorey::openings};
  }
  std::int32_t index = 0;  ///< 0 is the lowest
  double elevation = 0;  ///< of the floor, metres, relative to origin; where it is not known, the storey's lowest place
  bool floor_known = true;          ///< whether elevation is that of a floor, or of the foot of the walls
  double height = 0;                ///< floor to ceiling, metres; 0: not known
  std::vector<PlanWall> walls;      ///< interrupted where a door or a window stands
  std::vector<PlanPolygon> bodies;  ///< what the walls of known thickness cover, joined at corners and junctions
  std::vector<PlanPolygon> floors;
  std::vector<PlanPolygon> ceilings;
  std::vector<PlanRoom> rooms;
  std::vector<PlanOpening> openings;
};

/// Floor plans, one per storey, lowest first. Metres; a place is origin + (x, y), in the input's frame if its z points
/// up, else in that frame turned upright about `origin` by the least rotation.
struct FloorPlan {
  static constexpr std::string_view port_type = "FloorPlan";
  static constexpr auto members() { return std::tuple{&FloorPlan::origin, &FloorPlan::to_plan, &FloorPlan::storeys}; }
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Transform to_plan;  ///< from the input's frame; the identity if its z points up
  std::vector<PlanStorey> storeys;
};

}  // namespace atrium
