#include "modules/synth/sector_rooms.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "modules/synth/furniture.hpp"
#include "modules/synth/openings.hpp"
#include "modules/synth/solids.hpp"

namespace atrium::synth {

SectorRooms::Out SectorRooms::run(const Params& p, Context& context) {
  constexpr int planes = 4;  // of each room's round walls
  const int rooms = static_cast<int>(p.rooms), n = planes * rooms;
  if (p.outer_radius < p.radius + 2)
    throw Error("the rooms around the hall are less than 2 m deep", "make outer_radius larger than radius + 2 m");
  const Ring2 inner = regular_polygon({0, 0}, p.radius, n), outer = regular_polygon({0, 0}, p.outer_radius, n);
  Building b;
  const int hall = b.add_prism("hall", 0, inner, 0, p.ceiling_height);
  Random random = context.random();
  std::vector<int> sectors;
  for (int i = 0; i < rooms; ++i) {
    Ring2 ring;
    std::vector<double> by;
    for (int k = 0; k <= planes; ++k) {
      ring.push_back(outer[static_cast<std::size_t>((i * planes + k) % n)]);
      by.push_back(k < planes ? 0 : p.inner_wall / 2);
    }
    for (int k = planes; k >= 0; --k) {
      ring.push_back(inner[static_cast<std::size_t>((i * planes + k) % n)]);
      by.push_back(k > 0 ? p.inner_wall : p.inner_wall / 2);
    }
    const int room = b.add_prism("room " + std::to_string(i + 1), 0, inset(ring, by), 0, p.ceiling_height);
    sectors.push_back(room);
    const auto middle = [&](const Ring2& of, int k) {
      const std::size_t at = static_cast<std::size_t>(i) * planes + static_cast<std::size_t>(k);
      return Eigen::Vector2d((of[at] + of[(at + 1) % of.size()]) / 2);
    };
    const double chord = (inner[1] - inner[0]).norm();
    add_door_at(b, hall, room, middle(inner, 1), std::min(0.86, 0.8 * chord));
    for (const int k : {0, 2}) add_window_at(b, room, middle(outer, k), 1.1, 0.9, 2.2, p.outer_wall);
    if (i == 0) add_entrance_at(b, room, middle(outer, 3), p.outer_wall);
  }
  furnish(b, hall, RoomUse::living, p.furniture, p.ceiling_height, random);
  for (const int room : sectors) furnish(b, room, RoomUse::office, p.furniture, p.ceiling_height, random);
  return {b.finish()};
}

}  // namespace atrium::synth
