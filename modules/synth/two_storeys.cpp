#include "modules/synth/two_storeys.hpp"

#include <cmath>

#include "modules/synth/furniture.hpp"
#include "modules/synth/openings.hpp"

namespace atrium::synth {
namespace {

constexpr Colour stair_colour{140, 104, 70}, rail_colour{70, 72, 76};
constexpr double stair_width = 1.0, tread = 0.27, stair_start = 1.3, headroom = 2.05;

Footprint footprint(double x0, double x1, double y0, double y1, double height) {
  return {{(x0 + x1) / 2, (y0 + y1) / 2}, {(x1 - x0) / 2, (y1 - y0) / 2}, 0, height};
}

struct Stairs {
  int steps;
  double rise, end;  // of one step; where the upper floor begins
  double opening;    // where the slab opens: from there on the headroom would be too low
};
Stairs stairs_for(double storey, double ceiling) {
  Stairs s{};
  s.steps = static_cast<int>(std::round(storey / 0.178));
  s.rise = storey / s.steps;
  s.end = stair_start + tread * (s.steps - 1);
  s.opening = stair_start + tread * std::floor(std::max(0.0, ceiling - headroom) / s.rise);
  return s;
}

void build_stairs(Building& b, int hall, int landing, const Stairs& s, double storey) {
  const int stairs = b.add_object("stairs");
  for (int i = 1; i < s.steps; ++i) {
    const double y = stair_start + tread * (i - 1);
    b.add_box(stairs, {0, 0}, 0, {0.01, y, std::max(0.0, s.rise * i - 0.4)},
              {stair_width - 0.01, y + tread, s.rise * i}, stair_colour);
  }
  b.occupy(hall, footprint(0, stair_width, stair_start, s.end, storey));
  b.occupy(landing, footprint(0, stair_width, s.opening, s.end, 1));
  // The railing stands on the landing, along the opening's long side and its near end.
  const int railing = b.add_object("railing");
  const double x = stair_width + 0.04, y = s.opening - 0.06;
  for (double at = y; at < s.end; at += 0.6)
    b.add_box(railing, {x, at}, 0, {-0.02, -0.02, storey}, {0.02, 0.02, storey + 0.9}, rail_colour);
  b.add_box(railing, {0, 0}, 0, {x - 0.03, y - 0.03, storey + 0.9}, {x + 0.03, s.end, storey + 0.95}, rail_colour);
  b.add_box(railing, {0, 0}, 0, {0.02, y - 0.03, storey + 0.9}, {x - 0.03, y + 0.03, storey + 0.95}, rail_colour);
  const int middle = s.steps / 2;  // a scanner stands on this tread
  b.add_position({stair_width / 2, stair_start + tread * (middle + 0.5), s.rise * (middle + 1) + 1.5});
}

}  // namespace

TwoStoreys::Out TwoStoreys::run(const Params& p, Context& context) {
  const double w = p.width, d = p.depth, t = p.inner_wall, h = p.ceiling_height, up = h + p.slab;
  const double xs = 0.34 * w, lower = 0.56 * d, upper = 0.48 * d;  // inner edges of hall, living room, bedroom
  const Stairs s = stairs_for(up, h);
  if (s.end + 0.9 > d)
    throw Error("the stairs end " + std::to_string(s.end) + " m into a hall of " + std::to_string(d) + " m",
                "make depth larger or ceiling_height and slab smaller: 0.9 m are needed at their end");
  Building b;
  const int hall = b.add_prism("hall", 0, rectangle(0, xs, 0, d), 0, h);
  const int living = b.add_prism("living room", 0, rectangle(xs + t, w, 0, lower), 0, h);
  const int kitchen = b.add_prism("kitchen", 0, rectangle(xs + t, w, lower + t, d), 0, h);
  const int landing = b.add_prism("landing", 1, rectangle(0, xs, 0, d), up, up + h);
  const int bedroom = b.add_prism("bedroom", 1, rectangle(xs + t, w, 0, upper), up, up + h);
  const int study = b.add_prism("study", 1, rectangle(xs + t, w, upper + t, d), up, up + h);

  // On a ceiling v runs against y.
  b.pierce("slab", b.ceiling_of(hall), {0, stair_width, -s.end, -s.opening}, b.floor_of(landing));
  build_stairs(b, hall, landing, s, up);

  add_door(b, hall, east, living, west, {0, 0.4 * lower});
  add_door(b, hall, east, kitchen, west, {0, lower + t + 0.5 * (d - lower - t)});
  add_door(b, living, north, kitchen, south, {0.8 * w, 0});
  add_door(b, landing, east, bedroom, west, {0, 0.3 * upper});
  add_door(b, landing, east, study, west, {0, upper + t + 0.7 * (d - upper - t)});
  add_entrance(b, hall, south, {0.65 * xs, 0}, p.outer_wall);
  const double middle = xs + t + 0.5 * (w - xs - t);
  add_window(b, living, south, {middle, 0}, 2.0, 0.85, 2.1, p.outer_wall);
  add_window(b, living, east, {0, 0.5 * lower}, 1.6, 0.0, 2.1, p.outer_wall);
  add_window(b, kitchen, north, {middle, 0}, 1.2, 1.05, 2.1, p.outer_wall);
  add_window(b, landing, north, {0.6 * xs, 0}, 0.9, 0.9, 2.1, p.outer_wall);
  add_window(b, bedroom, south, {middle, 0}, 1.6, 0.85, 2.1, p.outer_wall);
  add_window(b, study, north, {middle, 0}, 1.4, 0.85, 2.1, p.outer_wall);

  Random random = context.random();
  for (const auto& [room, use] : {std::pair{hall, RoomUse::hall},
                                  {living, RoomUse::living},
                                  {kitchen, RoomUse::kitchen},
                                  {landing, RoomUse::hall},
                                  {bedroom, RoomUse::bedroom},
                                  {study, RoomUse::study}})
    furnish(b, room, use, p.furniture, h, random);
  return {b.finish()};
}

}  // namespace atrium::synth
