#include "modules/synth/round_room.hpp"

#include <cmath>
#include <numbers>

#include "modules/synth/furniture.hpp"
#include "modules/synth/openings.hpp"

namespace atrium::synth {

RoundRoom::Out RoundRoom::run(const Params& p, Context& context) {
  const double w = p.width, d = p.depth, radius = d / 2;
  const int strips = static_cast<int>(std::ceil(std::numbers::pi / (2 * std::acos(1 - p.sagitta / radius))));
  Ring2 outline{{0, 0}, {w, 0}};
  for (int i = 1; i < strips; ++i) {
    const double angle = std::numbers::pi * (static_cast<double>(i) / strips - 0.5);
    outline.emplace_back(w + radius * std::cos(angle), radius + radius * std::sin(angle));
  }
  outline.emplace_back(w, d);
  outline.emplace_back(0, d);
  Building b;
  const int room = b.add_prism("room", 0, outline, 0, p.ceiling_height);
  const int first = 0, last = static_cast<int>(outline.size()) - 1;  // south and west
  add_window(b, room, first, {0.55 * w, 0}, std::min(1.5, 0.6 * w), 0.9, 2.1, p.outer_wall);
  add_window(b, room, last - 1, {0.45 * w, d}, std::min(1.2, 0.6 * w), 0.9, 2.1, p.outer_wall);
  add_entrance(b, room, last, {0, 0.6 * d}, p.outer_wall);
  Random random = context.random();
  furnish(b, room, RoomUse::living, p.furniture, p.ceiling_height, random);
  return {b.finish()};
}

}  // namespace atrium::synth
