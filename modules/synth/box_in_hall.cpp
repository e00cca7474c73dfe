#include "modules/synth/box_in_hall.hpp"

#include "modules/synth/furniture.hpp"
#include "modules/synth/openings.hpp"
#include "modules/synth/solids.hpp"

namespace atrium::synth {

BoxInHall::Out BoxInHall::run(const Params& p, Context& context) {
  constexpr double side = 3, wing = 4, wing_height = 2.6, wall = 0.2;
  const double w = p.width, d = p.depth, t = p.inner_wall, x = 0.55 * w, y = 0.35 * d;
  Building b;
  const int hall = b.add_prism("hall", 0, rectangle(0, w, 0, d), 0, p.ceiling_height);
  const int first = add_block(b, hall, rectangle(x, x + side, y, y + side), 0, p.box_height);
  const int box = b.add_prism("box", 0, rectangle(x + t, x + side - t, y + t, y + side - t), 0, p.box_height - t);
  const int low_wing = b.add_prism("wing", 0, rectangle(w + wall, w + wall + wing, 0, 0.7 * d), 0, wing_height);
  const int box_west = first + 3;
  b.pierce("door", box_west, b.on_wall(box_west, {x, y + side / 2}, 0.86, 0, 2.01), b.wall_of(box, west));
  const int box_south = first;
  b.pierce("window", box_south, b.on_wall(box_south, {x + side / 2, y}, 1.2, 1.0, 1.9), b.wall_of(box, south));
  add_door_at(b, hall, low_wing, {w + wall / 2, 0.5 * d}, 1.6);
  add_entrance(b, hall, south, {0.2 * w, 0}, p.outer_wall);
  for (const double at : {0.25, 0.5, 0.75})
    add_window(b, hall, north, {at * w, 0}, 0.18 * w, 2.2, p.ceiling_height - 0.6, p.outer_wall);
  add_window(b, hall, west, {0, 0.5 * d}, 2.0, 1.0, 2.4, p.outer_wall);
  add_window(b, low_wing, east, {0, 0.35 * d}, 1.6, 0.9, 2.1, p.outer_wall);
  Random random = context.random();
  furnish(b, hall, RoomUse::hall, 2 * p.furniture, 3, random);
  furnish(b, low_wing, RoomUse::office, p.furniture, wing_height, random);
  return {b.finish()};
}

}  // namespace atrium::synth
