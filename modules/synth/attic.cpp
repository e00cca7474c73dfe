#include "modules/synth/attic.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "modules/synth/furniture.hpp"

namespace atrium::synth {
namespace {

using V = Eigen::Vector3d;

constexpr Colour boards_colour{160, 120, 80}, slope_colour{236, 232, 222}, wall_colour{214, 208, 220};

/// The section across the ridge: its corners as (y, z), and the heights in it.
struct Section {
  double depth, knee, slope, top;                        // slope: metres up per metre in
  double inset() const { return (top - knee) / slope; }  // from the eaves to where the slope ends
  bool flat() const { return depth - 2 * inset() > 1e-9; }
  double height(double y) const { return std::min(top, knee + slope * std::min(y, depth - y)); }
};

struct Dormer {
  double west = 0, east = 0, top = 0, inner = 0;  // inner: the y where its ceiling meets the slope
};

struct Faces {
  int south_slope = 0, north_wall = 0, west = 0, east = 0;
};

int add(Building& b, int room, SurfaceClass surface, std::vector<V> outline, const V& towards, const Colour& colour) {
  if (area_vector(outline).dot(towards) < 0) std::reverse(outline.begin(), outline.end());
  return b.add_face(room, surface, outline, colour);
}

// The end of a room at x: floor, knees, slopes, collar.
std::vector<V> gable(const Section& s, double x) {
  std::vector<V> ring{{x, 0, 0}, {x, s.depth, 0}, {x, s.depth, s.knee}, {x, s.depth - s.inset(), s.top}};
  if (s.flat()) ring.emplace_back(x, s.inset(), s.top);
  ring.emplace_back(x, 0, s.knee);
  return ring;
}

void add_dormer_faces(Building& b, int room, const Section& s, const Dormer& d) {
  for (const double x : {d.west, d.east})
    add(b, room, SurfaceClass::wall, {{x, s.depth, s.knee}, {x, s.depth, d.top}, {x, d.inner, d.top}},
        V(x == d.west ? 1 : -1, 0, 0), wall_colour);
  add(b, room, SurfaceClass::ceiling,
      {{d.west, d.inner, d.top}, {d.east, d.inner, d.top}, {d.east, s.depth, d.top}, {d.west, s.depth, d.top}},
      -V::UnitZ(), slope_colour);
}

Faces add_room(Building& b, int room, const Section& s, double x0, double x1, const Dormer* dormer) {
  Faces faces;
  const double in = s.inset(), d = s.depth;
  add(b, room, SurfaceClass::floor, {{x0, 0, 0}, {x1, 0, 0}, {x1, d, 0}, {x0, d, 0}}, V::UnitZ(), boards_colour);
  faces.south_slope =
      add(b, room, SurfaceClass::ceiling, {{x0, 0, s.knee}, {x1, 0, s.knee}, {x1, in, s.top}, {x0, in, s.top}},
          -V::UnitZ(), slope_colour);
  std::vector<V> slope{{x0, d, s.knee}}, knee{{x0, d, 0}, {x1, d, 0}, {x1, d, s.knee}};
  if (dormer != nullptr) {
    slope.insert(slope.end(), {{dormer->west, d, s.knee},
                               {dormer->west, dormer->inner, dormer->top},
                               {dormer->east, dormer->inner, dormer->top},
                               {dormer->east, d, s.knee}});
    knee.insert(knee.end(), {{dormer->east, d, s.knee},
                             {dormer->east, d, dormer->top},
                             {dormer->west, d, dormer->top},
                             {dormer->west, d, s.knee}});
    add_dormer_faces(b, room, s, *dormer);
  }
  slope.insert(slope.end(), {{x1, d, s.knee}, {x1, d - in, s.top}, {x0, d - in, s.top}});
  knee.emplace_back(x0, d, s.knee);
  add(b, room, SurfaceClass::ceiling, slope, -V::UnitZ(), slope_colour);
  if (s.flat())
    add(b, room, SurfaceClass::ceiling, {{x0, in, s.top}, {x1, in, s.top}, {x1, d - in, s.top}, {x0, d - in, s.top}},
        -V::UnitZ(), slope_colour);
  faces.north_wall = add(b, room, SurfaceClass::wall, knee, -V::UnitY(), wall_colour);
  add(b, room, SurfaceClass::wall, {{x0, 0, 0}, {x1, 0, 0}, {x1, 0, s.knee}, {x0, 0, s.knee}}, V::UnitY(), wall_colour);
  faces.west = add(b, room, SurfaceClass::wall, gable(s, x0), V::UnitX(), wall_colour);
  faces.east = add(b, room, SurfaceClass::wall, gable(s, x1), -V::UnitX(), wall_colour);
  return faces;
}

// Nothing taller than the slope stands under it, and scanners only where there is headroom.
void keep_clear(Building& b, int room, const Section& s, double x0, double x1) {
  constexpr double strip = 0.25, standing = 1.7;
  for (double y = 0; y < s.inset(); y += strip)
    for (const double at : {y, s.depth - y - strip})
      b.limit_height(room, {{(x0 + x1) / 2, at + strip / 2},
                            {(x1 - x0) / 2, strip / 2},
                            0,
                            std::min(s.height(at), s.height(at + strip)) - 0.05});
  const double y = std::clamp((standing - s.knee) / s.slope, 0.0, s.inset());
  b.stand_within(room, {{x0, y}, {x1, y}, {x1, s.depth - y}, {x0, s.depth - y}});
}

// A roof window in the middle of a slope, 0.8 m × 1.0 m or what fits.
void pierce_roof(Building& b, int face, const Section& s, double x, double roof) {
  const double length = std::hypot(s.inset(), s.top - s.knee), size = std::min(1.0, 0.6 * length);
  // Along the slope v grows upwards; u runs against x, as the slope is seen from the north.
  const double eaves = (s.top - s.knee) / length * s.knee, middle = eaves + length / 2;
  b.pierce_outside("window", face, {-x - 0.4, -x + 0.4, middle - size / 2, middle + size / 2}, roof);
}

}  // namespace

Attic::Out Attic::run(const Params& p, Context& context) {
  const double slope = std::tan(p.slope * std::numbers::pi / 180), ridge = p.knee_height + slope * p.depth / 2;
  if (ridge < 2.25)
    throw Error("the ridge is only " + std::to_string(ridge) + " m above the floor",
                "raise knee_height, slope or depth");
  const Section s{p.depth, p.knee_height, slope, std::min(p.collar_height, ridge)};
  const double t = p.inner_wall, xs = 0.55 * p.width;
  Building b;
  const auto rectangle = [&](double x0, double x1) { return Ring2{{x0, 0}, {x1, 0}, {x1, p.depth}, {x0, p.depth}}; };
  Dormer dormer{0.3 * xs, 0.3 * xs + 1.6, std::min(2.2, s.top - 0.05), 0};
  dormer.inner = p.depth - (dormer.top - s.knee) / slope;
  const int west = b.add_room("west room", 0, rectangle(0, xs), 0);
  const Faces west_faces = add_room(b, west, s, 0, xs, p.dormer ? &dormer : nullptr);
  const int east = b.add_room("east room", 0, rectangle(xs + t, p.width), 0);
  const Faces east_faces = add_room(b, east, s, xs + t, p.width, nullptr);
  keep_clear(b, west, s, 0, xs);
  keep_clear(b, east, s, xs + t, p.width);

  const double middle = p.depth / 2;
  b.pierce("door", west_faces.east, b.on_wall(west_faces.east, {0, middle}, 0.86, 0, 2.01), east_faces.west);
  b.pierce_outside("window", west_faces.west, b.on_wall(west_faces.west, {0, middle}, 1.2, 0.9, 2.0), p.roof);
  b.pierce_outside("window", east_faces.east, b.on_wall(east_faces.east, {0, middle}, 1.2, 0.9, 2.0), p.roof);
  pierce_roof(b, west_faces.south_slope, s, 0.5 * xs, p.roof);
  pierce_roof(b, east_faces.south_slope, s, (xs + t + p.width) / 2, p.roof);
  if (p.dormer && dormer.top - s.knee > 0.5)
    b.pierce_outside(
        "window", west_faces.north_wall,
        b.on_wall(west_faces.north_wall, {(dormer.west + dormer.east) / 2, 0}, 1.0, s.knee + 0.1, dormer.top - 0.15),
        p.roof);
  Random random = context.random();
  furnish(b, west, RoomUse::bedroom, p.furniture, s.top, random);
  furnish(b, east, RoomUse::study, p.furniture, s.top, random);
  return {b.finish()};
}

}  // namespace atrium::synth
