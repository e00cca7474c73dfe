#include "modules/synth/solids.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "modules/synth/openings.hpp"

namespace atrium::synth {
namespace {

using V = Eigen::Vector3d;
constexpr Colour boards_paint{160, 132, 96}, ceiling_paint{240, 240, 236}, wall_paint{216, 212, 200},
    column_paint{206, 206, 210}, tread_paint{140, 104, 70};

V lifted(const Eigen::Vector2d& p, double z) { return {p.x(), p.y(), z}; }

std::vector<V> lifted(const Ring2& ring, double z) {
  std::vector<V> result;
  for (const auto& p : ring) result.push_back(lifted(p, z));
  return result;
}

// Faces out of the solid: counter-clockwise seen from the room around it.
int add_sides(Building& b, int room, const Ring2& ring, double low, double high) {
  int first = -1;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const auto &p = ring[i], &q = ring[(i + 1) % ring.size()];
    const int face = b.add_face(room, SurfaceClass::wall,
                                {lifted(p, low), lifted(q, low), lifted(q, high), lifted(p, high)}, column_paint);
    if (first < 0) first = face;
  }
  return first;
}

SurfaceClass class_of(const V& normal, bool is_vault) {
  constexpr double steep = 0.3420201433256687;  // sine of 20 degrees
  if (normal.z() > 0.7) return SurfaceClass::floor;
  return normal.z() < (is_vault ? -1e-9 : -steep) ? SurfaceClass::ceiling : SurfaceClass::wall;
}

}  // namespace

int add_loft(Building& b, const std::string& name, int storey, const Ring2& lower, const Ring2& upper,
             double floor_height, double ceiling_height) {
  const int room = b.add_room(name, storey, lower, floor_height);
  b.add_face(room, SurfaceClass::floor, lifted(lower, floor_height), boards_paint);
  auto ceiling = lifted(upper, ceiling_height);
  std::reverse(ceiling.begin(), ceiling.end());
  b.add_face(room, SurfaceClass::ceiling, ceiling, ceiling_paint);
  for (std::size_t i = 0; i < lower.size(); ++i) {
    const std::size_t k = (i + 1) % lower.size();
    b.add_face(room, SurfaceClass::wall,
               {lifted(lower[k], floor_height), lifted(lower[i], floor_height), lifted(upper[i], ceiling_height),
                lifted(upper[k], ceiling_height)},
               wall_paint);
  }
  return room;
}

int add_extrusion(Building& b, const std::string& name, int storey, const Extrusion& e) {
  const Eigen::Vector2d right(e.along.y(), -e.along.x());
  const auto at = [&](const Eigen::Vector2d& p, double t) {
    return lifted(e.start + p.x() * right + t * e.along, p.y());
  };
  Eigen::Vector2d low = e.section.front(), high = low;
  for (const auto& p : e.section) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const auto corner = [&](double x, double t) { return Eigen::Vector2d(e.start + x * right + t * e.along); };
  const int room = b.add_room(
      name, storey, {corner(low.x(), 0), corner(high.x(), 0), corner(high.x(), e.length), corner(low.x(), e.length)},
      low.y());
  for (std::size_t i = 0; i < e.section.size(); ++i) {
    const auto &p = e.section[i], &q = e.section[(i + 1) % e.section.size()];
    const std::vector<V> outline{at(p, 0), at(q, 0), at(q, e.length), at(p, e.length)};
    const SurfaceClass surface = class_of(area_vector(outline).normalized(), e.is_vault);
    b.add_face(room, surface, outline,
               surface == SurfaceClass::floor     ? boards_paint
               : surface == SurfaceClass::ceiling ? ceiling_paint
                                                  : wall_paint);
  }
  std::vector<V> near, far;
  for (const auto& p : e.section) {
    near.push_back(at(p, 0));
    far.push_back(at(p, e.length));
  }
  std::reverse(near.begin(), near.end());
  b.add_face(room, SurfaceClass::wall, near, wall_paint);
  b.add_face(room, SurfaceClass::wall, far, wall_paint);
  return room;
}

void add_column(Building& b, int room, const Ring2& ring, double floor_height, double ceiling_height) {
  b.cut_out(b.floor_of(room), lifted(ring, floor_height));
  b.cut_out(b.ceiling_of(room), lifted(ring, ceiling_height));
  b.leave_out(room, ring);
  add_sides(b, room, ring, floor_height, ceiling_height);
}

int add_block(Building& b, int room, const Ring2& ring, double floor_height, double top) {
  b.cut_out(b.floor_of(room), lifted(ring, floor_height));
  b.leave_out(room, ring);
  const int first = add_sides(b, room, ring, floor_height, top);
  b.add_face(room, SurfaceClass::floor, lifted(ring, top), boards_paint);
  return first;
}

int side_near(const Building& b, int room, const Eigen::Vector2d& at) {
  const Ring2& ring = b.room(room).outline;
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const double d = distance_to_border({ring[i], ring[(i + 1) % ring.size()]}, at);
    if (d >= least) continue;
    least = d;
    best = static_cast<int>(i);
  }
  return best;
}

void add_door_at(Building& b, int room_a, int room_b, const Eigen::Vector2d& at, double width) {
  const int face = b.wall_of(room_a, side_near(b, room_a, at));
  const double sill = std::max(b.room(room_a).floor_height, b.room(room_b).floor_height);
  b.pierce("door", face, b.on_wall(face, at, width, sill, sill + 2.01), b.wall_of(room_b, side_near(b, room_b, at)));
}

void add_window_at(Building& b, int room, const Eigen::Vector2d& at, double width, double sill, double top,
                   double wall) {
  add_window(b, room, side_near(b, room, at), at, width, sill, top, wall);
}

void add_entrance_at(Building& b, int room, const Eigen::Vector2d& at, double wall) {
  add_entrance(b, room, side_near(b, room, at), at, wall);
}

double add_flight(Building& b, const Eigen::Vector2d& foot, double yaw, double width, double low, double high) {
  constexpr double tread = 0.27;
  const int steps = static_cast<int>(std::round((high - low) / 0.178));
  const double rise = (high - low) / steps;
  const int stairs = b.add_object("stairs");
  for (int i = 1; i < steps; ++i)
    b.add_box(stairs, foot, yaw, {tread * (i - 1), 0.01, std::max(low, low + rise * i - 0.4)},
              {tread * i, width - 0.01, low + rise * i}, tread_paint);
  return tread * (steps - 1);
}

}  // namespace atrium::synth
