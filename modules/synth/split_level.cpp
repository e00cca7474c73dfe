#include "modules/synth/split_level.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "modules/synth/furniture.hpp"
#include "modules/synth/openings.hpp"
#include "modules/synth/solids.hpp"

namespace atrium::synth {

SplitLevel::Out SplitLevel::run(const Params& p, Context& context) {
  constexpr double room_width = 5, upper_depth = 2.6, flight = 1.05;
  constexpr Colour landing_colour{150, 116, 80};
  const double w = p.width, d = p.depth, t = p.inner_wall, h = p.ceiling_height, up = h + p.slab, half = up / 2;
  const double east_end = w + t + room_width;
  Building b;
  const int stairwell = b.add_prism("stairwell", 0, rectangle(0, w, 0, d), 0, up + h);
  const int lower = b.add_prism("lower room", 0, rectangle(w + t, east_end, 0, d), 0, h);
  const int middle = b.add_prism("middle room", 1, rectangle(0, east_end, d + t, d + t + upper_depth), half, half + h);
  const int upper = b.add_prism("upper room", 2, rectangle(w + t, east_end, 0, d), up, up + h);

  // Up along the west wall to a landing in the north, back along the east wall to a landing in the south.
  const double rear = d - 1.05;
  const double length = add_flight(b, {0.01 + flight, rear - 0.27 * (std::round(half / 0.178) - 1)},
                                   std::numbers::pi / 2, flight, 0, half);
  add_flight(b, {w - flight - 0.01, rear}, -std::numbers::pi / 2, flight, half, up);
  const int landings = b.add_object("landing");
  b.add_box(landings, {0, 0}, 0, {0.01, rear, half - 0.2}, {w - 0.01, d - 0.01, half}, landing_colour);
  b.add_box(landings, {0, 0}, 0, {0.01, 0.01, up - 0.2}, {w - 0.01, rear - length, up}, landing_colour);
  b.stand_within(stairwell, rectangle(0.1, w - 0.1, 0.1, rear - length));
  b.add_position({w / 2, d - 0.5, half + 1.5});
  b.add_position({w / 2, (rear - length) / 2, up + 1.5});

  const double front = 0.5 * (rear - length);
  add_door_at(b, stairwell, lower, {w + t / 2, std::max(0.5, front)});
  add_door_at(b, stairwell, upper, {w + t / 2, std::max(0.5, front)});
  add_door_at(b, stairwell, middle, {w / 2, d + t / 2});
  add_entrance(b, stairwell, south, {w / 2, 0}, p.outer_wall);
  for (const int room : {lower, upper}) {
    add_window(b, room, east, {0, d / 2}, 1.6, 0.9, 2.1, p.outer_wall);
    add_window(b, room, south, {w + t + 0.6 * room_width, 0}, 1.2, 0.9, 2.1, p.outer_wall);
  }
  add_window(b, middle, north, {0.6 * east_end, 0}, 1.8, 0.9, 2.1, p.outer_wall);
  Random random = context.random();
  furnish(b, lower, RoomUse::kitchen, p.furniture, h, random);
  furnish(b, middle, RoomUse::study, p.furniture, h, random);
  furnish(b, upper, RoomUse::bedroom, p.furniture, h, random);
  return {b.finish()};
}

}  // namespace atrium::synth
