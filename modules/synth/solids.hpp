#pragma once
#include "modules/synth/building.hpp"

namespace atrium::synth {

/// Rooms that are no upright prisms, and what stands in rooms from the floor up. All stay closed polyhedra.

/// A room between two level outlines, corner i of `upper` above corner i of `lower`: its walls lean where the outlines
/// differ. Sides that correspond must be parallel, so that walls are plane. Faces as those of Building::add_prism.
int add_loft(Building& building, const std::string& name, int storey, const Ring2& lower, const Ring2& upper,
             double floor_height, double ceiling_height);

/// A room whose section is the same all along.
struct Extrusion {
  Eigen::Vector2d start;  ///< of the axis
  Eigen::Vector2d along;  ///< unit length
  double length;          ///< metres
  Ring2 section;          ///< (to the right of the axis, height), counter-clockwise; its lowest level side is the floor
  bool is_vault = false;  ///< whether all that looks downwards, however steep, is ceiling
};
/// Faces in order: one per side of the section, then the end at the start, then the far end. Level sides that look up
/// are floors, what leans by less than 20 degrees is wall, the rest is ceiling.
int add_extrusion(Building& building, const std::string& name, int storey, const Extrusion& extrusion);

/// A solid from floor to ceiling in a prism, `ring` counter-clockwise: walls around it, holes in floor and ceiling.
void add_column(Building& building, int room, const Ring2& ring, double floor_height, double ceiling_height);

/// A solid on a prism's floor with a level top, which is a floor of the same room. Returns its first wall.
int add_block(Building& building, int room, const Ring2& ring, double floor_height, double top);

/// The side of a room that is nearest to a point of the plan.
int side_near(const Building& building, int room, const Eigen::Vector2d& at);
/// A door between rooms whose walls stand parallel on both sides of `at`; its threshold is the higher of both floors.
void add_door_at(Building& building, int room_a, int room_b, const Eigen::Vector2d& at, double width = 0.86);
void add_window_at(Building& building, int room, const Eigen::Vector2d& at, double width, double sill, double top,
                   double wall);
void add_entrance_at(Building& building, int room, const Eigen::Vector2d& at, double wall);

/// Stairs in a straight line, as boxes of an object "stairs": from `foot` at height `low` in direction `yaw` (radians)
/// up to `high`, where the floor above is the last step. Returns how long they are on the plan.
double add_flight(Building& building, const Eigen::Vector2d& foot, double yaw, double width, double low, double high);

}  // namespace atrium::synth
