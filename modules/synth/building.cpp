#include "modules/synth/building.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "graph/api/error.hpp"
#include "modules/geometry/plan_overlay.hpp"
#include "modules/geometry/triangulate.hpp"

namespace atrium::synth {
namespace {

constexpr Colour floor_colour{166, 124, 82}, ceiling_colour{240, 240, 236}, reveal_colour{225, 222, 214},
    door_colour{196, 164, 120};
constexpr std::array<Colour, 5> wall_colours{
    {{222, 214, 196}, {206, 218, 206}, {204, 212, 226}, {226, 208, 202}, {218, 218, 218}}};

std::vector<Eigen::Vector3d> to_space(const Ring2& ring, double height) {
  std::vector<Eigen::Vector3d> result;
  for (const auto& p : ring) result.emplace_back(p.x(), p.y(), height);
  return result;
}

Ring2 corners_of(const Rectangle& r) {
  return {{r.left, r.bottom}, {r.right, r.bottom}, {r.right, r.top}, {r.left, r.top}};
}

}  // namespace

Eigen::Vector3d Building::Face::at(const Eigen::Vector2d& p) const {
  return u * p.x() + v * p.y() + normal * normal.dot(anchor);
}

int Building::add_room(const std::string& name, int storey, const Ring2& outline, double floor_height) {
  const int index = static_cast<int>(rooms_.size());
  rooms_.push_back({outline, floor_height, static_cast<int>(faces_.size()), {}, {}, {}, {}});
  scene_.truth.rooms.push_back({name, storey, to_space(outline, floor_height)});
  return index;
}

int Building::add_face(int room, SurfaceClass surface, const std::vector<Eigen::Vector3d>& outline,
                       const Colour& colour) {
  Face face;
  face.normal = area_vector(outline).normalized();
  // Exact axes stay exact: rounding must not tilt an upright wall.
  for (int k = 0; k < 3; ++k)
    if (std::abs(face.normal[k]) < 1e-14) face.normal[k] = 0;
  face.normal.normalize();
  const bool level = face.normal.x() == 0 && face.normal.y() == 0;
  face.u = level ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ().cross(face.normal).normalized();
  face.v = face.normal.cross(face.u);
  face.anchor = outline.front();
  face.rings.emplace_back();
  for (const auto& p : outline) face.rings[0].emplace_back(face.u.dot(p), face.v.dot(p));
  face.colour = colour;
  face.room = room;
  faces_.push_back(face);
  TrueFace truth;
  truth.surface = surface;
  truth.room = room;
  truth.storey = scene_.truth.rooms[room].storey;
  truth.plane = {face.normal, -face.normal.dot(face.anchor)};
  scene_.truth.faces.push_back(truth);
  return static_cast<int>(faces_.size()) - 1;
}

int Building::add_prism(const std::string& name, int storey, const Ring2& outline, double floor_height,
                        double ceiling_height) {
  const int room = add_room(name, storey, outline, floor_height);
  add_face(room, SurfaceClass::floor, to_space(outline, floor_height), floor_colour);
  auto ceiling = to_space(outline, ceiling_height);
  std::reverse(ceiling.begin(), ceiling.end());
  add_face(room, SurfaceClass::ceiling, ceiling, ceiling_colour);
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const auto &a = outline[i], &b = outline[(i + 1) % outline.size()];
    add_face(room, SurfaceClass::wall,
             {{b.x(), b.y(), floor_height},
              {a.x(), a.y(), floor_height},
              {a.x(), a.y(), ceiling_height},
              {b.x(), b.y(), ceiling_height}},
             wall_colours[static_cast<std::size_t>(room) % wall_colours.size()]);
  }
  return room;
}

Rectangle Building::on_wall(int face, const Eigen::Vector2d& centre, double width, double bottom, double top) const {
  const double u = faces_[face].u.head<2>().dot(centre);
  return {u - width / 2, u + width / 2, bottom, top};
}

void Building::cut(Face& face, const Ring2& hole_ring) {
  PlanPolygon polygon{face.rings.front(), {}};
  polygon.holes.assign(face.rings.begin() + 1, face.rings.end());
  const PlanPolygon hole = overlay::corrected({hole_ring, {}});
  if (!overlay::covers(polygon, hole))
    throw Error("an opening does not fit into its wall, floor or ceiling",
                "make the scene larger or the opening smaller, so that openings lie in their faces and apart");
  const auto rest = overlay::difference({polygon}, hole);
  if (rest.size() != 1) throw Error("an opening cuts its wall in two", "make the opening smaller than the wall");
  face.rings = {rest[0].outline};
  face.rings.insert(face.rings.end(), rest[0].holes.begin(), rest[0].holes.end());
}

TrueOpening Building::opening_of(const std::string& kind, int face, const Rectangle& rectangle) const {
  TrueOpening opening;
  opening.kind = kind;
  opening.face_a = face;
  opening.room_a = faces_[face].room;
  for (const auto& p : corners_of(rectangle)) opening.outline.push_back(faces_[face].at(p));
  return opening;
}

void Building::pierce(const std::string& kind, int face_a, const Rectangle& rectangle, int face_b) {
  TrueOpening opening = opening_of(kind, face_a, rectangle);
  const Face &a = faces_[face_a], &b = faces_[face_b];
  opening.face_b = face_b;
  opening.room_b = b.room;
  opening.thickness = -a.normal.dot(b.anchor - a.anchor);
  const Eigen::Vector3d depth = -opening.thickness * a.normal;
  Rectangle far{1e300, -1e300, 1e300, -1e300};
  for (const auto& p : opening.outline) {
    far = {std::min(far.left, b.u.dot(p)), std::max(far.right, b.u.dot(p)), std::min(far.bottom, b.v.dot(p)),
           std::max(far.top, b.v.dot(p))};
  }
  cut(faces_[face_a], corners_of(rectangle));
  cut(faces_[face_b], corners_of(far));
  note_opening(faces_[face_a], rectangle);
  note_opening(faces_[face_b], far);
  add_reveal(opening.outline, depth, false);
  scene_.truth.openings.push_back(opening);
}

void Building::pierce_outside(const std::string& kind, int face_a, const Rectangle& rectangle, double thickness,
                              bool closed) {
  TrueOpening opening = opening_of(kind, face_a, rectangle);
  opening.thickness = thickness;
  cut(faces_[face_a], corners_of(rectangle));
  note_opening(faces_[face_a], rectangle);
  add_reveal(opening.outline, -thickness * faces_[face_a].normal, closed);
  scene_.truth.openings.push_back(opening);
}

void Building::cut_out(int face, const std::vector<Eigen::Vector3d>& ring) {
  Face& from = faces_[static_cast<std::size_t>(face)];
  Ring2 local;
  for (const auto& p : ring) local.emplace_back(from.u.dot(p), from.v.dot(p));
  cut(from, local);
}

void Building::leave_out(int room, const Ring2& ring) {
  Eigen::Vector2d low = ring.front(), high = low;
  for (const auto& p : ring) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  occupy(room, {(low + high) / 2, (high - low) / 2, 0, 100});
}

void Building::hang(const std::string& name, int face, const Rectangle& rectangle, const Colour& colour) {
  const Face& on = faces_[static_cast<std::size_t>(face)];
  std::vector<Eigen::Vector3d> corners;
  for (const auto& p : corners_of(rectangle)) corners.push_back(on.at(p) + 0.01 * on.normal);
  add_polygon(SimulatedScene::object_id(static_cast<std::size_t>(add_object(name))), corners, colour);
}

// Doors want their way free, windows no tall furniture before them.
void Building::note_opening(const Face& face, const Rectangle& r) {
  if (face.normal.z() != 0) return;
  Room& room = rooms_[face.room];
  const bool door = r.bottom < room.floor_height + 0.3;
  const double depth = door ? 0.9 : 0.4;
  const Eigen::Vector3d middle = face.at({(r.left + r.right) / 2, r.bottom}) + face.normal * (depth / 2);
  Footprint zone{middle.head<2>(),
                 {(r.right - r.left) / 2, depth / 2},
                 std::atan2(face.u.y(), face.u.x()),
                 r.bottom - room.floor_height};
  (door ? room.doors : room.low_zones).push_back(zone);
}

void Building::add_reveal(const std::vector<Eigen::Vector3d>& front, const Eigen::Vector3d& depth, bool closed) {
  const std::int32_t id = SimulatedScene::object_id(static_cast<std::size_t>(add_object("reveal")));
  for (std::size_t i = 0; i < front.size(); ++i) {
    const Eigen::Vector3d &a = front[i], &b = front[(i + 1) % front.size()];
    add_polygon(id, {a, b, b + depth, a + depth}, reveal_colour);
  }
  if (!closed) return;
  const std::int32_t leaf = SimulatedScene::object_id(static_cast<std::size_t>(add_object("door leaf")));
  std::vector<Eigen::Vector3d> back = front;
  for (auto& p : back) p += depth;
  add_polygon(leaf, back, door_colour);
}

int Building::add_object(const std::string& name) {
  scene_.objects.push_back(name);
  return static_cast<int>(scene_.objects.size()) - 1;
}

void Building::add_polygon(std::int32_t surface, const std::vector<Eigen::Vector3d>& corners, const Colour& colour) {
  const auto first = static_cast<std::uint32_t>(scene_.vertices.size());
  scene_.vertices.insert(scene_.vertices.end(), corners.begin(), corners.end());
  for (std::uint32_t i = 2; i < corners.size(); ++i) {
    scene_.triangles.push_back({first, first + i - 1, first + i});
    scene_.surfaces.push_back(surface);
    scene_.colours.push_back(colour);
  }
}

void Building::add_box(int object, const Eigen::Vector2d& at, double yaw, const Eigen::Vector3d& low,
                       const Eigen::Vector3d& high, const Colour& colour) {
  const auto corner = [&](int i) {
    const double x = (i & 1) != 0 ? high.x() : low.x(), y = (i & 2) != 0 ? high.y() : low.y();
    return Eigen::Vector3d(at.x() + std::cos(yaw) * x - std::sin(yaw) * y,
                           at.y() + std::sin(yaw) * x + std::cos(yaw) * y, (i & 4) != 0 ? high.z() : low.z());
  };
  const std::int32_t id = SimulatedScene::object_id(static_cast<std::size_t>(object));
  for (const auto& [a, b, c, d] :
       {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}})
    add_polygon(id, {corner(a), corner(b), corner(c), corner(d)}, colour);
}

void Building::add_lathe(int object, const Eigen::Vector2d& at, const std::vector<Eigen::Vector2d>& profile,
                         const Colour& colour) {
  constexpr int sides = 16;
  const std::int32_t id = SimulatedScene::object_id(static_cast<std::size_t>(object));
  const auto point = [&](const Eigen::Vector2d& p, int side) {
    const double angle = 2 * std::numbers::pi * (side % sides) / sides;
    return Eigen::Vector3d(at.x() + p.x() * std::cos(angle), at.y() + p.x() * std::sin(angle), p.y());
  };
  for (std::size_t i = 0; i + 1 < profile.size(); ++i)
    for (int side = 0; side < sides; ++side) {
      const auto &low = profile[i], &high = profile[i + 1];
      std::vector<Eigen::Vector3d> corners{point(low, side)};
      if (low.x() > 0) corners.push_back(point(low, side + 1));
      if (high.x() > 0) corners.push_back(point(high, side + 1));
      corners.push_back(point(high, side));
      add_polygon(id, corners, colour);
    }
}

SimulatedScene Building::finish() {
  auto& truth = scene_.truth;
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    const Face& face = faces_[i];
    TrueFace& to = truth.faces[i];
    for (std::size_t r = 0; r < face.rings.size(); ++r) {
      std::vector<Eigen::Vector3d> ring;
      for (const auto& p : face.rings[r]) ring.push_back(face.at(p));
      if (r == 0)
        to.outline = ring;
      else
        to.holes.push_back(ring);
    }
    const auto pieces = triangulate(face.rings);
    const auto first = static_cast<std::uint32_t>(truth.mesh.vertices.size());
    for (const auto& p : pieces.points) {
      truth.mesh.vertices.push_back(face.at(p));
      truth.mesh.colours.push_back(face.colour);
    }
    for (const auto& [a, b, c] : pieces.triangles) {
      truth.mesh.triangles.push_back({first + a, first + b, first + c});
      truth.mesh.classes.push_back(to.surface);
      truth.mesh.storeys.push_back(to.storey);
      truth.mesh.primitives.push_back(static_cast<std::int32_t>(i));
      add_polygon(static_cast<std::int32_t>(i),
                  {truth.mesh.vertices[first + a], truth.mesh.vertices[first + b], truth.mesh.vertices[first + c]},
                  face.colour);
    }
  }
  for (std::size_t i = 0; i < rooms_.size(); ++i) {
    constexpr double tripod = 1.5;
    const Room& room = rooms_[i];
    for (const auto& p : scanner_places(room.standing.empty() ? room.outline : room.standing, room.furniture, 8))
      scene_.positions.push_back({static_cast<int>(i), {p.x(), p.y(), room.floor_height + tripod}});
  }
  return std::move(scene_);
}

}  // namespace atrium::synth
