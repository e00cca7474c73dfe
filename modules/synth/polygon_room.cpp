#include "modules/synth/polygon_room.hpp"

#include <cmath>
#include <numbers>

#include "modules/synth/furniture.hpp"
#include "modules/synth/openings.hpp"

namespace atrium::synth {

PolygonRoom::Out PolygonRoom::run(const Params& p, Context& context) {
  const auto n = static_cast<int>(p.corners);
  Ring2 outline;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    // Without their last digits, so that corners which mirror each other stand at exactly one height.
    constexpr double step = 1e-13;
    const auto rounded = [](double x) { return std::round(x / step) * step; };
    outline.emplace_back(rounded(p.radius * std::cos(angle)), rounded(p.radius * std::sin(angle)));
  }
  Building b;
  const int room = b.add_prism("room", 0, outline, 0, p.ceiling_height);
  const auto middle = [&](int side) {
    const auto i = static_cast<std::size_t>(side);
    return Eigen::Vector2d((outline[i] + outline[(i + 1) % outline.size()]) / 2);
  };
  const double side = (outline[1] - outline[0]).norm();
  if (p.door) add_entrance(b, room, 0, middle(0), p.outer_wall);
  if (p.window) add_window(b, room, n / 2, middle(n / 2), std::min(1.5, 0.7 * side), 0.9, 2.1, p.outer_wall);
  Random random = context.random();
  furnish(b, room, RoomUse::living, p.furniture, p.ceiling_height, random);
  return {b.finish()};
}

}  // namespace atrium::synth
