#include "modules/synth/barrel_vault.hpp"

#include <cmath>
#include <numbers>

#include "modules/synth/furniture.hpp"
#include "modules/synth/openings.hpp"
#include "modules/synth/solids.hpp"

namespace atrium::synth {

BarrelVault::Out BarrelVault::run(const Params& p, Context& context) {
  constexpr double flat_depth = 3.5, flat_height = 2.7;
  const double w = p.width, d = p.depth, t = p.inner_wall, r = w / 2;
  Building b;
  Ring2 section{{0, 0}, {w, 0}};
  for (std::int64_t i = 0; i <= p.strips; ++i) {
    const double angle = std::numbers::pi * static_cast<double>(i) / static_cast<double>(p.strips);
    section.emplace_back(i == p.strips ? 0.0 : r + r * std::cos(angle),
                         p.springing + (i == p.strips ? 0.0 : r * std::sin(angle)));
  }
  const int vaulted = add_extrusion(b, "vaulted room", 0, {{0, 0}, {0, 1}, d, section, true});
  const int first = b.floor_of(vaulted), sides = static_cast<int>(section.size());
  const int south_end = first + sides, north_end = first + sides + 1;
  const int flat = b.add_prism("flat room", 0, rectangle(0, w, d + t, d + t + flat_depth), 0, flat_height);
  b.pierce("door", north_end, b.on_wall(north_end, {0.6 * w, d}, 0.86, 0, 2.01), b.wall_of(flat, south));
  b.pierce_outside("door", south_end, b.on_wall(south_end, {0.5 * w, 0}, 0.95, 0, 2.05), p.outer_wall, true);
  b.pierce_outside("window", south_end, b.on_wall(south_end, {0.5 * w, 0}, 0.3 * w, 2.4, p.springing + 0.6 * r),
                   p.outer_wall);
  add_window(b, flat, north, {0.5 * w, 0}, 1.6, 0.9, 2.1, p.outer_wall);
  add_window(b, flat, east, {0, d + t + flat_depth / 2}, 1.2, 0.9, 2.1, p.outer_wall);
  // Where the vault is low nothing tall stands.
  for (const double x : {0.15, w - 0.15}) b.limit_height(vaulted, {{x, d / 2}, {0.15, d / 2}, 0, p.springing});
  Random random = context.random();
  furnish(b, vaulted, RoomUse::living, p.furniture, p.springing + 0.6 * r, random);
  furnish(b, flat, RoomUse::study, p.furniture, flat_height, random);
  return {b.finish()};
}

}  // namespace atrium::synth
