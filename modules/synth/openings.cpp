#include "modules/synth/openings.hpp"

namespace atrium::synth {
namespace {

Rectangle on_side(const Building& b, int room, int side, const Eigen::Vector2d& at, double width, double low,
                  double high) {
  const double floor = b.room(room).floor_height;
  return b.on_wall(b.wall_of(room, side), at, width, floor + low, floor + high);
}

}  // namespace

void add_door(Building& b, int room_a, int side_a, int room_b, int side_b, const Eigen::Vector2d& at) {
  b.pierce("door", b.wall_of(room_a, side_a), on_side(b, room_a, side_a, at, 0.86, 0, 2.01), b.wall_of(room_b, side_b));
}

void add_entrance(Building& b, int room, int side, const Eigen::Vector2d& at, double wall) {
  b.pierce_outside("door", b.wall_of(room, side), on_side(b, room, side, at, 0.95, 0, 2.05), wall, true);
}

void add_window(Building& b, int room, int side, const Eigen::Vector2d& at, double width, double sill, double top,
                double wall) {
  b.pierce_outside("window", b.wall_of(room, side), on_side(b, room, side, at, width, sill, top), wall);
}

}  // namespace atrium::synth
