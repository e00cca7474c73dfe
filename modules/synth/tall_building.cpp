#include "modules/synth/tall_building.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "modules/synth/furniture.hpp"
#include "modules/synth/openings.hpp"
#include "modules/synth/solids.hpp"

namespace atrium::synth {
namespace {

constexpr double corridor_width = 3, flight_width = 1, clear_height = 2.05;

class Tower {
 public:
  Tower(const TallBuilding::Params& p, Random random) : p_(p), random_(random), height_(p.ceiling_height + p.slab) {}

  SimulatedScene build() {
    const double y = p_.room_depth + p_.inner_wall, end = y + corridor_width;
    for (int storey = 0; storey < p_.storeys; ++storey) {
      const double z = storey * height_;
      corridors_.push_back(b_.add_prism("corridor " + std::to_string(storey), storey, rectangle(0, p_.width, y, end), z,
                                        z + p_.ceiling_height));
      add_row(storey, 0, p_.room_depth, Side::south);
      add_row(storey, end + p_.inner_wall, end + p_.inner_wall + p_.room_depth, Side::north);
      add_window(b_, corridors_.back(), east, {0, y + corridor_width / 2}, 1.4, 0.9, 2.1, p_.outer_wall);
    }
    add_entrance(b_, corridors_[0], west, {0, y + corridor_width / 2}, p_.outer_wall);
    for (std::size_t i = 0; i + 1 < corridors_.size(); ++i) add_stairs(i, y + (corridor_width - flight_width) / 2);
    return b_.finish();
  }

 private:
  void add_row(int storey, double y0, double y1, Side outer) {
    const int n = static_cast<int>(p_.rooms), hall = corridors_.back();
    const double t = p_.inner_wall, width = (p_.width - t * (n - 1)) / n, z = storey * height_;
    for (int i = 0; i < n; ++i) {
      const double x = i * (width + t);
      const std::string name =
          std::to_string(storey) + (outer == Side::south ? " south " : " north ") + std::to_string(i + 1);
      const int room = b_.add_prism(name, storey, rectangle(x, x + width, y0, y1), z, z + p_.ceiling_height);
      add_door(b_, room, outer == Side::south ? Side::north : Side::south, hall, outer,
               {x + width * (i % 2 == 0 ? 0.3 : 0.7), 0});
      add_window(b_, room, outer, {x + width / 2, 0}, std::min(1.6, 0.5 * width), 0.9, 2.2, p_.outer_wall);
      furnish(b_, room, RoomUse::study, p_.furniture, p_.ceiling_height, random_);
    }
  }

  // Flights stand one behind the other along the corridor, every third above the first.
  void add_stairs(std::size_t lower, double y) {
    const double z = static_cast<double>(lower) * height_;
    const int steps = static_cast<int>(std::round(height_ / 0.178));
    const double rise = height_ / steps, length = 0.27 * (steps - 1);
    const double x = 1.5 + static_cast<double>(lower % 2) * (length + 1.5), end = x + length;
    const double open = x + 0.27 * std::floor(std::max(0.0, p_.ceiling_height - clear_height) / rise);
    // On a ceiling v runs against y.
    b_.pierce("slab", b_.ceiling_of(corridors_[lower]), {open, end, -y - flight_width, -y},
              b_.floor_of(corridors_[lower + 1]));
    add_flight(b_, {x, y}, 0, flight_width, z, z + height_);
    b_.occupy(corridors_[lower], {{(x + end) / 2, y + flight_width / 2}, {length / 2, flight_width / 2}, 0, height_});
    b_.occupy(corridors_[lower + 1],
              {{(open + end) / 2, y + flight_width / 2}, {(end - open) / 2, flight_width / 2}, 0, 1});
    const int railing = b_.add_object("railing");
    constexpr Colour steel{70, 72, 76};
    const double top = z + height_ + 0.9;
    for (const double side : {y - 0.05, y + flight_width + 0.05})
      b_.add_box(railing, {0, 0}, 0, {open - 0.06, side - 0.02, top}, {end, side + 0.02, top + 0.04}, steel);
    b_.add_box(railing, {0, 0}, 0, {open - 0.06, y - 0.05, top}, {open - 0.02, y + flight_width + 0.05, top + 0.04},
               steel);
    const double half_way = std::floor(steps / 2.0);
    b_.add_position({x + 0.27 * (half_way + 0.5), y + flight_width / 2, z + rise * (half_way + 1) + 1.5});
  }

  const TallBuilding::Params& p_;
  Random random_;
  double height_;
  Building b_;
  std::vector<int> corridors_;
};

}  // namespace

TallBuilding::Out TallBuilding::run(const Params& params, Context& context) {
  return {Tower(params, context.random()).build()};
}

}  // namespace atrium::synth
