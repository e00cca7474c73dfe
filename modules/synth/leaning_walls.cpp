#include "modules/synth/leaning_walls.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "modules/synth/furniture.hpp"
#include "modules/synth/openings.hpp"
#include "modules/synth/solids.hpp"

namespace atrium::synth {

LeaningWalls::Out LeaningWalls::run(const Params& p, Context& context) {
  const double w = p.width, d = p.depth, t = p.inner_wall, h = p.ceiling_height, xs = 0.58 * w;
  const double south_in = h * std::tan(p.lean * std::numbers::pi / 180),
               north_out = h * std::tan(p.lean / 2 * std::numbers::pi / 180);
  Building b;
  const auto add = [&](const std::string& name, double x0, double x1) {
    const Ring2 lower = rectangle(x0, x1, 0, d);
    return add_loft(b, name, 0, lower, rectangle(x0, x1, south_in, d + north_out), 0, h);
  };
  const int large = add("west room", 0, xs), small = add("east room", xs + t, w);
  add_door_at(b, large, small, {xs + t / 2, 0.55 * d});
  add_entrance(b, large, west, {0, 0.6 * d}, p.outer_wall);
  add_window(b, small, east, {0, 0.55 * d}, 1.4, 0.9, 2.0, p.outer_wall);
  // On a leaning wall heights are measured along it.
  for (const auto& [room, x] : {std::pair{large, 0.5 * xs}, {small, (xs + t + w) / 2}}) {
    const int north_wall = b.wall_of(room, north);
    const auto& plane = b.truth().faces[static_cast<std::size_t>(north_wall)].plane;
    const Eigen::Vector3d up = plane.normal.cross(Eigen::Vector3d::UnitZ().cross(plane.normal).normalized());
    const double foot = up.dot(Eigen::Vector3d(x, d, 0));
    b.pierce_outside("window", north_wall, b.on_wall(north_wall, {x, d}, 1.4, foot + 0.9, foot + 2.0), p.outer_wall);
  }
  for (const int room : {large, small}) {
    const auto& ring = b.room(room).outline;
    b.limit_height(room, {{(ring[0].x() + ring[1].x()) / 2, south_in / 2}, {w, south_in / 2}, 0, 0.5});
    b.stand_within(room, rectangle(ring[0].x(), ring[1].x(), south_in, d));
  }
  Random random = context.random();
  furnish(b, large, RoomUse::living, p.furniture, h, random);
  furnish(b, small, RoomUse::study, p.furniture, h, random);
  return {b.finish()};
}

}  // namespace atrium::synth
