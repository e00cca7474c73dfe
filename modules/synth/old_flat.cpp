#include "modules/synth/old_flat.hpp"

#include <cmath>
#include <numbers>

#include "modules/synth/furniture.hpp"
#include "modules/synth/openings.hpp"
#include "modules/synth/solids.hpp"

namespace atrium::synth {
namespace {

// The plan is a grid of three by two quadrilaterals; what parts them is given by thickness about the grid's lines.
constexpr double outer_thickness = 0.5, bearing_thickness = 0.38, partition_thickness = 0.16;

class SkewedPlan {
 public:
  SkewedPlan(const OldFlat::Params& p, Random& random) {
    const double off = p.depth / 2 * std::tan(p.skew * std::numbers::pi / 180) / 2;
    for (int i = 0; i < 4; ++i)
      for (int k = 0; k < 3; ++k)
        corners_[i][k] = {p.width * columns[i] + random.uniform(-off, off),
                          p.depth * rows[k] + random.uniform(-off, off)};
  }
  /// Walls: south, east, north, west thickness, half of which is taken from the cell; outer walls stand outside.
  Ring2 cell(int i, int k) const {
    const Ring2 ring{corners_[i][k], corners_[i + 1][k], corners_[i + 1][k + 1], corners_[i][k + 1]};
    const auto across = [](int line) { return line == 1 ? bearing_thickness / 2 : 0.0; };
    const auto along = [](int line) {
      return line == 0 || line == 3 ? 0.0 : (line == 1 ? partition_thickness : bearing_thickness) / 2;
    };
    return inset(ring, {across(k), along(i + 1), across(k + 1), along(i)});
  }
  Eigen::Vector2d between(int i, int k, int j, int l, double share) const {
    return corners_[i][k] + share * (corners_[j][l] - corners_[i][k]);
  }

 private:
  static constexpr double columns[4] = {0, 0.33, 0.62, 1}, rows[3] = {0, 0.54, 1};
  Eigen::Vector2d corners_[4][3];
};

double side_length(const Ring2& ring, std::size_t side) { return (ring[(side + 1) % ring.size()] - ring[side]).norm(); }

// A bay with slanted cheeks in a side's middle.
void add_bay(Ring2& ring, std::size_t side, double width, double depth) {
  const Eigen::Vector2d a = ring[side], along = (ring[side + 1] - a).normalized(), out(along.y(), -along.x());
  const double from = (side_length(ring, side) - width) / 2, cheek = 0.7 * depth;
  const Ring2 corners{a + from * along, a + (from + cheek) * along + depth * out,
                      a + (from + width - cheek) * along + depth * out, a + (from + width) * along};
  ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(side) + 1, corners.begin(), corners.end());
}

}  // namespace

OldFlat::Out OldFlat::run(const Params& p, Context& context) {
  Random random = context.random();
  const SkewedPlan plan(p, random);
  Building b;
  const auto height = [&] { return p.ceiling_height + random.uniform(-0.06, 0.06); };
  const auto add = [&](const std::string& name, const Ring2& ring) { return b.add_prism(name, 0, ring, 0, height()); };
  // Sides of a cell: 0 south, 1 east, 2 north, 3 west; changed from the last to the first, so that numbers hold.
  Ring2 salon = plan.cell(0, 0), dining = plan.cell(1, 0), library = plan.cell(2, 0);
  set_back(salon, 3, 0.4 * side_length(salon, 3), 0.4 * side_length(salon, 3) + 1.5, 0.42);  // chimney breast
  add_bay(salon, 0, 2.6, 0.9);
  set_back(library, 1, 0.35 * side_length(library, 1), 0.35 * side_length(library, 1) + 1.4, 0.4);
  set_back(dining, 2, 0.15 * side_length(dining, 2), 0.15 * side_length(dining, 2) + 0.9, -0.18);  // a niche
  Ring2 kitchen = plan.cell(0, 1), hall = plan.cell(1, 1), bedroom = plan.cell(2, 1);
  set_back(bedroom, 2, 0.15 * side_length(bedroom, 2), 0.15 * side_length(bedroom, 2) + 1.0, -0.25);
  const int salon_ = add("salon", salon), dining_ = add("dining room", dining), library_ = add("library", library),
            kitchen_ = add("kitchen", kitchen), hall_ = add("hall", hall), bedroom_ = add("bedroom", bedroom);
  add_door_at(b, salon_, dining_, plan.between(1, 0, 1, 1, 0.6), 1.5);  // double doors
  add_door_at(b, dining_, library_, plan.between(2, 0, 2, 1, 0.35));
  add_door_at(b, dining_, hall_, plan.between(1, 1, 2, 1, 0.2));
  add_door_at(b, kitchen_, hall_, plan.between(1, 1, 1, 2, 0.4));
  add_door_at(b, hall_, bedroom_, plan.between(2, 1, 2, 2, 0.45));
  add_entrance_at(b, hall_, plan.between(1, 2, 2, 2, 0.5), outer_thickness);
  const auto window = [&](int room, const Eigen::Vector2d& at, double width) {
    add_window_at(b, room, at, width, 0.75, p.ceiling_height - 0.55, outer_thickness);
  };
  const auto& bay = b.room(salon_).outline;
  window(salon_, (bay[2] + bay[3]) / 2, 0.9);
  for (const double share : {0.28, 0.72}) {
    window(dining_, plan.between(1, 0, 2, 0, share), 1.0);
    window(library_, plan.between(2, 0, 3, 0, share), 1.1);
  }
  window(kitchen_, plan.between(0, 2, 1, 2, 0.5), 1.2);
  window(bedroom_, plan.between(3, 1, 3, 2, 0.5), 1.2);
  const int wall = b.wall_of(hall_, side_near(b, hall_, plan.between(1, 1, 1, 2, 0.8)));
  b.hang("mirror", wall, b.on_wall(wall, plan.between(1, 1, 1, 2, 0.8), 0.7, 0.4, 2.0), {200, 206, 210});
  for (const auto& [room, use] : {std::pair{salon_, RoomUse::living},
                                  {dining_, RoomUse::meeting},
                                  {library_, RoomUse::study},
                                  {kitchen_, RoomUse::kitchen},
                                  {hall_, RoomUse::hall},
                                  {bedroom_, RoomUse::bedroom}})
    furnish(b, room, use, p.furniture, p.ceiling_height - 0.1, random);
  return {b.finish()};
}

}  // namespace atrium::synth
