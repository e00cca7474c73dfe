#include "modules/synth/flat.hpp"

#include "modules/synth/furniture.hpp"

namespace atrium::synth {
namespace {

Ring2 rectangle(double x0, double x1, double y0, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }

// Sides of a rectangle, in the order of its corners.
enum Side { south, east, north, west };

}  // namespace

Flat::Out Flat::run(const In& /*in*/, const Params& p, Context& context) {
  const double w = p.width, d = p.depth, t = p.inner_wall, h = p.ceiling_height;
  const double xs = 0.56 * w, left = 0.58 * d, right = 0.47 * d;  // the rooms' inner edges
  Building b;
  const int living = b.add_prism("living room", 0, rectangle(0, xs, 0, left), 0, h);
  const int kitchen = b.add_prism("kitchen", 0, rectangle(0, xs, left + t, d), 0, h + p.ceiling_step);
  const int bedroom = b.add_prism("bedroom", 0, rectangle(xs + t, w, 0, right), 0, h - p.ceiling_step);
  const int study = b.add_prism("study", 0, rectangle(xs + t, w, right + t, d), 0, h);

  const auto door = [&](int room_a, Side side_a, int room_b, Side side_b, const Eigen::Vector2d& at) {
    const int face = b.wall_of(room_a, side_a);
    b.pierce("door", face, b.on_wall(face, at, 0.86, 0, 2.01), b.wall_of(room_b, side_b));
  };
  door(living, north, kitchen, south, {0.72 * xs, 0});
  door(living, east, bedroom, west, {0, 0.7 * right});
  door(kitchen, east, study, west, {0, left + t + 0.35 * (d - left - t)});

  const auto window = [&](int room, Side side, const Eigen::Vector2d& at, double width, double sill, double top) {
    const int face = b.wall_of(room, side);
    b.pierce_outside("window", face, b.on_wall(face, at, width, sill, top), p.outer_wall);
  };
  const int entrance = b.wall_of(living, west);
  b.pierce_outside("door", entrance, b.on_wall(entrance, {0, 0.8 * left}, 0.95, 0, 2.05), p.outer_wall, true);
  window(living, south, {0.4 * xs, 0}, 1.9, 0, 2.1);
  window(living, west, {0, 0.35 * left}, 1.3, 0.9, 2.2);
  window(kitchen, north, {0.5 * xs, 0}, 1.2, 1.05, 2.2);
  window(bedroom, south, {xs + t + 0.5 * (w - xs - t), 0}, 1.4, 0.9, 2.15);
  window(study, north, {xs + t + 0.5 * (w - xs - t), 0}, 1.4, 0.9, 2.15);

  Random random = context.random();
  furnish(b, living, RoomUse::living, p.furniture, h, random);
  furnish(b, kitchen, RoomUse::kitchen, p.furniture, h, random);
  furnish(b, bedroom, RoomUse::bedroom, p.furniture, h - p.ceiling_step, random);
  furnish(b, study, RoomUse::study, p.furniture, h, random);
  return {b.finish()};
}

}  // namespace atrium::synth
