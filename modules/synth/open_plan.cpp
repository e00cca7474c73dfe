#include "modules/synth/open_plan.hpp"

#include <cmath>
#include <numbers>

#include "modules/synth/furniture.hpp"
#include "modules/synth/openings.hpp"
#include "modules/synth/solids.hpp"

namespace atrium::synth {
namespace {

// Columns about the middle of the floor, all but those in the corner of the meeting room.
void add_columns(Building& b, int hall, const OpenPlan::Params& p, double corner_x, double corner_y) {
  const int columns = static_cast<int>(p.width / p.grid - 0.5), rows = static_cast<int>(p.depth / p.grid - 0.5);
  for (int i = 0; i < columns; ++i)
    for (int k = 0; k < rows; ++k) {
      const Eigen::Vector2d at(p.width / 2 + p.grid * (i - 0.5 * (columns - 1)),
                               p.depth / 2 + p.grid * (k - 0.5 * (rows - 1)));
      if (at.x() < corner_x + 0.8 && at.y() < corner_y + 0.8) continue;
      add_column(b, hall,
                 (i + k) % 2 == 0 ? rectangle(at.x() - 0.2, at.x() + 0.2, at.y() - 0.2, at.y() + 0.2)
                                  : regular_polygon(at, 0.25, 12),
                 0, p.ceiling_height);
    }
}

// Screens in the shape of an H between four desks, wherever the grid leaves room.
void add_screens(Building& b, int hall, const OpenPlan::Params& p) {
  constexpr Colour felt{96, 104, 124};
  constexpr double height = 1.6;
  for (double x = 0.5 * p.grid; x < p.width - 2; x += p.grid)
    for (double y = 0.5 * p.grid; y < p.depth - 2; y += p.grid) {
      const Footprint place{{x, y}, {1.7, 0.9}, 0, height};
      bool free = inside(b.room(hall).outline, place);
      for (const auto& f : b.room(hall).furniture) free = free && !overlap(f, place, 0.3);
      for (const auto& f : b.room(hall).doors) free = free && !overlap(f, place, 0.3);
      if (!free) continue;
      const int screen = b.add_object("screen");
      b.add_box(screen, place.centre, 0, {-1.6, -0.02, 0.05}, {1.6, 0.02, height}, felt);
      for (const double end : {-1.6, 1.6})
        b.add_box(screen, place.centre, 0, {end - 0.02, -0.8, 0.05}, {end + 0.02, 0.8, height}, felt);
      b.occupy(hall, place);
    }
}

}  // namespace

OpenPlan::Out OpenPlan::run(const Params& p, Context& context) {
  const double w = p.width, d = p.depth, t = p.inner_wall, h = p.ceiling_height, mx = 5, my = 4;
  Building b;
  const int hall =
      b.add_prism("open plan", 0, {{mx + t, 0}, {w, 0}, {w, d}, {0, d}, {0, my + t}, {mx + t, my + t}}, 0, h);
  const int meeting = b.add_prism("meeting room", 0, rectangle(0, mx, 0, my), 0, h);
  add_columns(b, hall, p, mx, my);
  add_door_at(b, meeting, hall, {0.6 * mx, my + t / 2});
  add_entrance_at(b, hall, {w, 0.5 * d}, p.outer_wall);
  constexpr double window = 2.2, pitch = 3;
  for (double x = 1.5; x + window / 2 < w; x += pitch) {
    add_window_at(b, hall, {x, d}, window, 0.8, h - 0.5, p.outer_wall);
    if (x - window / 2 > mx + t + 0.2) add_window_at(b, hall, {x, 0}, window, 0.8, h - 0.5, p.outer_wall);
  }
  for (double y = my + 2.2; y + window / 2 < d - 0.2; y += pitch) {
    add_window_at(b, hall, {0, y}, window, 0.8, h - 0.5, p.outer_wall);
    if (std::abs(y - 0.5 * d) > 0.5 + window / 2 + 0.2)
      add_window_at(b, hall, {w, y}, window, 0.8, h - 0.5, p.outer_wall);
  }
  add_window_at(b, meeting, {0.5 * mx, 0}, window, 0.8, h - 0.5, p.outer_wall);
  if (p.furniture > 0) add_screens(b, hall, p);
  Random random = context.random();
  furnish(b, hall, RoomUse::office, p.furniture * w * d / 120, h, random);
  furnish(b, meeting, RoomUse::meeting, p.furniture, h, random);
  // Six positions more for the size of the floor.
  for (const double x : {0.2, 0.5, 0.8})
    for (const double y : {0.35, 0.75}) {
      const Eigen::Vector2d at(x * w, y * d);
      const Ring2 around = rectangle(at.x() - 1.5, at.x() + 1.5, at.y() - 1.5, at.y() + 1.5);
      for (const auto& place : scanner_places(around, b.room(hall).furniture, 1))
        b.add_position({place.x(), place.y(), 1.5});
    }
  return {b.finish()};
}

}  // namespace atrium::synth
