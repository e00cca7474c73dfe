#include "modules/synth/office.hpp"

#include <cmath>
#include <string>

#include "modules/synth/furniture.hpp"
#include "modules/synth/openings.hpp"

namespace atrium::synth {
namespace {

struct Bay {
  const char* name;
  RoomUse use;
  double share;  // of the floor's width
  double door;   // where along the room, as a share of its width
};
constexpr Bay south_bays[] = {{"office 1", RoomUse::office, 0.21, 0.75},
                              {"office 2", RoomUse::office, 0.27, 0.2},
                              {"office 3", RoomUse::office, 0.19, 0.7},
                              {"office 4", RoomUse::office, 0.33, 0.35}};
constexpr Bay north_bays[] = {{"meeting room", RoomUse::meeting, 0.36, 0.6},
                              {"office 5", RoomUse::office, 0.24, 0.25},
                              {"office 6", RoomUse::study, 0.40, 0.3}};

class Floor {
 public:
  Floor(const Office::Params& p, Random random) : p_(p), random_(random) {
    corridor_south_ = 0.52 * (p.depth - p.corridor - 2 * p.inner_wall) + p.inner_wall;
    corridor_north_ = corridor_south_ + p.corridor;
  }

  SimulatedScene build() {
    corridor_ = b_.add_prism("corridor", 0, rectangle(0, p_.width, corridor_south_, corridor_north_), 0,
                             p_.ceiling_height - p_.corridor_drop);
    const double middle = (corridor_south_ + corridor_north_) / 2;
    add_entrance(b_, corridor_, west, {0, middle}, p_.outer_wall);
    add_window(b_, corridor_, east, {0, middle}, 0.6 * p_.corridor, 0.9, 2.1, p_.outer_wall);
    const int first = add_row(south_bays, 0, corridor_south_ - p_.inner_wall, south);
    add_door(b_, first, east, first + 1, west, {0, 0.3 * corridor_south_});
    add_row(north_bays, corridor_north_ + p_.inner_wall, p_.depth, north);
    furnish(b_, corridor_, RoomUse::hall, p_.furniture, p_.ceiling_height - p_.corridor_drop, random_);
    for (int i = 0; i < std::ssize(uses_); ++i) {
      const auto& outline = b_.room(first + i).outline;
      const double area = (outline[2] - outline[0]).prod();
      furnish(b_, first + i, uses_[static_cast<std::size_t>(i)], p_.furniture * area / 24, p_.ceiling_height, random_);
    }
    // Two positions more for the length of the corridor.
    for (const double x : {0.4 * p_.width, 0.7 * p_.width})
      for (const auto& at : scanner_places(rectangle(x - 1.5, x + 1.5, corridor_south_, corridor_north_),
                                           b_.room(corridor_).furniture, 1))
        b_.add_position({at.x(), at.y(), 1.5});
    return b_.finish();
  }

 private:
  // Rooms side by side; `outer` is their side away from the corridor. Returns the first.
  template <std::size_t N>
  int add_row(const Bay (&bays)[N], double y0, double y1, Side outer) {
    const int first = corridor_ + 1 + static_cast<int>(uses_.size());
    const double t = p_.inner_wall, width = p_.width - t * (N - 1);
    double x = 0;
    for (const Bay& bay : bays) {
      const double end = x + bay.share * width;
      const int room = b_.add_prism(bay.name, 0, rectangle(x, end, y0, y1), 0, p_.ceiling_height);
      uses_.push_back(bay.use);
      add_door(b_, room, outer == south ? north : south, corridor_, outer, {x + bay.door * (end - x), 0});
      const int windows = std::max(1, static_cast<int>((end - x) / 2.8));
      for (int i = 0; i < windows; ++i)
        add_window(b_, room, outer, {x + (end - x) * (i + 0.5) / windows, 0}, 1.7, 0.85, 2.25, p_.outer_wall);
      x = end + t;
    }
    return first;
  }

  const Office::Params& p_;
  Random random_;
  Building b_;
  double corridor_south_, corridor_north_;
  int corridor_ = 0;
  std::vector<RoomUse> uses_;
};

}  // namespace

Office::Out Office::run(const Params& params, Context& context) { return {Floor(params, context.random()).build()}; }

}  // namespace atrium::synth
