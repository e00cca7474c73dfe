#include "modules/synth/raised_room.hpp"

#include "modules/synth/furniture.hpp"
#include "modules/synth/openings.hpp"
#include "modules/synth/solids.hpp"

namespace atrium::synth {

RaisedRoom::Out RaisedRoom::run(const Params& p, Context& context) {
  constexpr double raised_width = 4, raised_depth = 3.6;
  constexpr Colour step_colour{150, 116, 80};
  const double w = p.width, d = p.depth, t = p.inner_wall, h = p.ceiling_height;
  Building b;
  const int lower = b.add_prism("lower room", 0, rectangle(0, w, 0, d), 0, h);
  const int raised = b.add_prism("raised room", 0, rectangle(w + t, w + t + raised_width, 0, raised_depth), p.rise, h);
  const double at = 0.6 * raised_depth;
  add_door_at(b, raised, lower, {w + t / 2, at});
  // Steps before the door, as deep as their number asks for.
  const int steps = b.add_object("stairs");
  const int count = static_cast<int>(p.rise / 0.18);
  for (int i = 1; i <= count; ++i)
    b.add_box(steps, {w, at}, 0, {-0.3 * (count + 1 - i), -0.5, 0}, {-0.01, 0.5, p.rise * i / (count + 1)},
              step_colour);
  b.occupy(lower, {{w - 0.15 * count, at}, {0.15 * count, 0.5}, 0, p.rise});
  add_entrance(b, lower, west, {0, 0.3 * d}, p.outer_wall);
  add_window(b, lower, south, {0.5 * w, 0}, 2.0, 0.8, 2.2, p.outer_wall);
  add_window(b, lower, north, {0.3 * w, 0}, 1.4, 0.8, 2.2, p.outer_wall);
  add_window(b, raised, east, {0, raised_depth / 2}, 1.4, 0.8, 2.1, p.outer_wall);
  Random random = context.random();
  furnish(b, lower, RoomUse::living, p.furniture, h, random);
  furnish(b, raised, RoomUse::study, p.furniture, h - p.rise, random);
  return {b.finish()};
}

}  // namespace atrium::synth
