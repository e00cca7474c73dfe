#pragma once
#include "modules/synth/building.hpp"

namespace atrium::synth {

/// An axis-aligned rectangle, counter-clockwise. Its sides, in the order of its corners, are those of `Side`.
inline Ring2 rectangle(double x0, double x1, double y0, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }
enum Side { south, east, north, west };

/// What ordinary buildings have, each about the plan point of the wall that is nearest to `at`. Heights are metres
/// above the room's floor; sides are those of Building::wall_of.
///
/// A passage, 0.86 m × 2.01 m, to the room on the other side.
void add_door(Building& building, int room_a, int side_a, int room_b, int side_b, const Eigen::Vector2d& at);
/// A shut door to the outside, 0.95 m × 2.05 m.
void add_entrance(Building& building, int room, int side, const Eigen::Vector2d& at, double wall);
void add_window(Building& building, int room, int side, const Eigen::Vector2d& at, double width, double sill,
                double top, double wall);

}  // namespace atrium::synth
