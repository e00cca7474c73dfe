#include "modules/synth/flat.hpp"

#include "modules/synth/furniture.hpp"
#include "modules/synth/openings.hpp"

namespace atrium::synth {

Flat::Out Flat::run(const Params& p, Context& context) {
  const double w = p.width, d = p.depth, t = p.inner_wall, h = p.ceiling_height;
  const double xs = 0.56 * w, left = 0.58 * d, right = 0.47 * d;  // the rooms' inner edges
  Building b;
  const int living = b.add_prism("living room", 0, rectangle(0, xs, 0, left), 0, h);
  const int kitchen = b.add_prism("kitchen", 0, rectangle(0, xs, left + t, d), 0, h + p.ceiling_step);
  const int bedroom = b.add_prism("bedroom", 0, rectangle(xs + t, w, 0, right), 0, h - p.ceiling_step);
  const int study = b.add_prism("study", 0, rectangle(xs + t, w, right + t, d), 0, h);

  add_door(b, living, north, kitchen, south, {0.72 * xs, 0});
  add_door(b, living, east, bedroom, west, {0, 0.7 * right});
  add_door(b, kitchen, east, study, west, {0, left + t + 0.35 * (d - left - t)});
  add_entrance(b, living, west, {0, 0.8 * left}, p.outer_wall);
  const double middle = xs + t + 0.5 * (w - xs - t);
  add_window(b, living, south, {0.4 * xs, 0}, 1.9, 0, 2.1, p.outer_wall);
  add_window(b, living, west, {0, 0.35 * left}, 1.3, 0.9, 2.2, p.outer_wall);
  add_window(b, kitchen, north, {0.5 * xs, 0}, 1.2, 1.05, 2.2, p.outer_wall);
  add_window(b, bedroom, south, {middle, 0}, 1.4, 0.9, 2.15, p.outer_wall);
  add_window(b, study, north, {middle, 0}, 1.4, 0.9, 2.15, p.outer_wall);

  // In the corner of the wall to the study and the outer one.
  if (p.built_in > 0) add_wardrobe(b, bedroom, north, {w, right}, p.built_in, h - p.ceiling_step);
  Random random = context.random();
  if (p.mirror) {
    const int wall = b.wall_of(bedroom, east);
    b.hang("mirror", wall, b.on_wall(wall, {w, 0.5 * right}, 0.8, 0.3, 2.0), {200, 206, 210});
    b.limit_height(bedroom, {{w - 0.3, 0.5 * right}, {0.3, 0.4}, 0, 0.3});
  }
  if (p.curtains) add_curtains(b);
  if (p.door_leaves) add_door_leaves(b, random);
  if (p.shelves > 0)
    for (const auto& [room, height] :
         {std::pair{living, h}, {kitchen, h + p.ceiling_step}, {bedroom, h - p.ceiling_step}, {study, h}})
      line_walls(b, room, p.shelves, height, random);
  furnish(b, living, RoomUse::living, p.furniture, h, random);
  furnish(b, kitchen, RoomUse::kitchen, p.furniture, h, random);
  furnish(b, bedroom, RoomUse::bedroom, p.furniture, h - p.ceiling_step, random);
  furnish(b, study, RoomUse::study, p.furniture, h, random);
  return {b.finish()};
}

}  // namespace atrium::synth
