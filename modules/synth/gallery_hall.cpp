#include "modules/synth/gallery_hall.hpp"

#include <cmath>

#include "modules/synth/furniture.hpp"
#include "modules/synth/openings.hpp"
#include "modules/synth/solids.hpp"

namespace atrium::synth {

GalleryHall::Out GalleryHall::run(const Params& p, Context& context) {
  constexpr double gallery = 2, wing = 4, flight = 1;
  constexpr Colour rail{70, 72, 76};
  const double w = p.width, d = p.depth, t = p.inner_wall, h = p.ceiling_height, up = h + p.slab, edge = w - gallery;
  Building b;
  // The section across, seen along y: the gallery is a notch in its east side.
  const int hall = add_extrusion(
      b, "hall", 0,
      {{0, 0}, {0, 1}, d, {{0, 0}, {w, 0}, {w, h}, {edge, h}, {edge, up}, {w, up}, {w, up + h}, {0, up + h}}});
  const int first = b.floor_of(hall);
  const int lower_east = first + 1, upper_east = first + 5, west_wall = first + 7, south_end = first + 8,
            north_end = first + 9;
  const int kitchen = b.add_prism("kitchen", 0, rectangle(w + t, w + t + wing, 0, d), 0, h);
  const int bedroom = b.add_prism("bedroom", 1, rectangle(w + t, w + t + wing, 0, d), up, up + h);
  b.pierce("door", lower_east, b.on_wall(lower_east, {w, 0.35 * d}, 0.86, 0, 2.01), b.wall_of(kitchen, west));
  b.pierce("door", upper_east, b.on_wall(upper_east, {w, 0.4 * d}, 0.86, up, up + 2.01), b.wall_of(bedroom, west));
  b.pierce_outside("door", south_end, b.on_wall(south_end, {0.3 * w, 0}, 0.95, 0, 2.05), p.outer_wall, true);
  b.pierce_outside("window", west_wall, b.on_wall(west_wall, {0, d / 2}, 2.4, 0.8, up + h - 0.5), p.outer_wall);
  b.pierce_outside("window", north_end, b.on_wall(north_end, {0.25 * w, d}, 1.6, up + 0.4, up + 1.8), p.outer_wall);
  for (const int room : {kitchen, bedroom}) {
    add_window(b, room, east, {0, 0.4 * d}, 1.4, 0.9, 2.1, p.outer_wall);
    add_window(b, room, north, {w + t + wing / 2, 0}, 1.2, 0.9, 2.1, p.outer_wall);
  }

  // The flight leads along the north wall onto the gallery.
  const double length = 0.27 * (std::round(up / 0.178) - 1);
  add_flight(b, {edge - length, d - flight - 0.02}, 0, flight, 0, up);
  b.occupy(hall, {{edge - length / 2, d - flight / 2}, {length / 2, flight / 2}, 0, up});
  b.limit_height(hall, {{w - gallery / 2, d / 2}, {gallery / 2, d / 2}, 0, h - 0.1});
  const int railing = b.add_object("railing");
  for (double y = 0.1; y < d - flight - 0.1; y += 0.6)
    b.add_box(railing, {edge + 0.06, y}, 0, {-0.02, -0.02, up}, {0.02, 0.02, up + 0.9}, rail);
  b.add_box(railing, {0, 0}, 0, {edge + 0.03, 0.02, up + 0.9}, {edge + 0.09, d - flight - 0.1, up + 0.95}, rail);
  b.add_position({edge - length / 2, d - flight / 2 - 0.02, up / 2 + 1.6});
  b.add_position({w - gallery / 2, 0.6 * d, up + 1.5});
  b.stand_within(hall, rectangle(0.2, edge - 0.2, 0.2, d - flight - 0.3));
  Random random = context.random();
  furnish(b, hall, RoomUse::living, p.furniture, h, random);
  furnish(b, kitchen, RoomUse::kitchen, p.furniture, h, random);
  furnish(b, bedroom, RoomUse::bedroom, p.furniture, h, random);
  return {b.finish()};
}

}  // namespace atrium::synth
