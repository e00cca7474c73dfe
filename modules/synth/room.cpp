#include "modules/synth/room.hpp"

#include <algorithm>

#include "modules/synth/furniture.hpp"

namespace atrium::synth {

Room::Out Room::run(const Params& p, Context& context) {
  constexpr double least = 1.2;  // what the notch leaves: room for the door, and to walk
  const double w = p.width, d = p.depth;
  Ring2 outline{{0, 0}, {w, 0}, {w, d}, {0, d}};
  if (p.notch_width > 0 && p.notch_depth > 0) {
    if (p.notch_width > w - least || p.notch_depth > d - least)
      throw Error("the notch leaves less than 1.2 m of the room",
                  "make notch_width and notch_depth smaller, or the room larger");
    outline = {{0, 0}, {w, 0}, {w, d - p.notch_depth}, {w - p.notch_width, d - p.notch_depth}, {w - p.notch_width, d},
               {0, d}};
  }
  Building b;
  const int room = b.add_prism("room", 0, outline, 0, p.ceiling_height);
  const int south = b.wall_of(room, 0), west = b.wall_of(room, static_cast<int>(outline.size()) - 1);
  b.pierce_outside("window", south, b.on_wall(south, {0.5 * w, 0}, 1.5, 0.9, 2.1), p.outer_wall);
  b.pierce_outside("door", west, b.on_wall(west, {0, 0.7 * d}, 0.9, 0, 2.01), p.outer_wall, true);
  if (p.wardrobe > 0) {
    const int north = static_cast<int>(outline.size()) - 2;
    add_wardrobe(b, room, north, outline[static_cast<std::size_t>(north)], p.wardrobe, std::min(2.2, p.ceiling_height));
  }
  Random random = context.random();
  furnish(b, room, RoomUse::living, p.furniture, p.ceiling_height, random);
  return {b.finish()};
}

}  // namespace atrium::synth
