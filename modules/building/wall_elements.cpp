#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "modules/building/element_steps.hpp"
#include "modules/building/profile.hpp"
#include "modules/floorplan/building_walls.hpp"
#include "modules/floorplan/wall_pieces.hpp"
#include "modules/types/building_rules.hpp"

namespace atrium::building {
namespace {

using floorplan::WallFace;
using floorplan::WallPiece;

constexpr double cut_height = 1.2;       // metres over the storey's floor
constexpr double min_thickness = 0.005;  // metres: thinner walls are two faces of one sheet
constexpr double corner_gap = 0.30;      // metres
constexpr double touching = 0.002;       // metres
constexpr double least_area = 1e-3;      // square metres: smaller footprints are rounding
constexpr double crumb_area = 0.02;      // square metres: smaller ones join a neighbour
constexpr double overlapping = 0.05;     // metres of common height

/// A wall that is being made, with all that decides who gives way.
struct Stretch {
  Wall wall;
  PlanRing outline;
  bool two_faces = false;
};

std::vector<WallFace> faces_of_storey(const Building& building, std::int32_t storey,
                                      const std::vector<RoomSpace>& rooms, const std::vector<bool>& of_columns) {
  std::vector<PlanPolygon> polygons;
  polygons.reserve(rooms.size());
  for (const auto& room : rooms) polygons.push_back(room.polygon);
  std::vector<WallFace> faces = floorplan::wall_faces(building, storey, cut_height, polygons);
  std::erase_if(faces, [&](const WallFace& face) { return of_columns[static_cast<std::size_t>(face.primitive)]; });
  return faces;
}

void remember_lines(const Building& building, const std::vector<WallFace>& faces, Elements& elements) {
  for (const auto& face : faces) {
    FaceLine line;
    line.face = face.primitive;
    line.normal = face.normal;
    line.offset = face.normal.dot(face.point);
    line.low = 1e300;
    line.high = -1e300;
    for (const auto v : building.faces[static_cast<std::size_t>(face.primitive)].outline) {
      line.low = std::min(line.low, building.vertices[v].z());
      line.high = std::max(line.high, building.vertices[v].z());
    }
    for (const auto& span : face.spans)
      line.backing.push_back({-1, -1, line.along().dot(face.at(span.from)), line.along().dot(face.at(span.to))});
    elements.lines.push_back(std::move(line));
  }
}

/// Where two faces of one room meet at a small angle, both end on the line between them: there is no far face to go on
/// to.
void mitre(std::vector<WallPiece>& pieces) {
  constexpr double small = 0.35, none = 1e-4;  // sines
  for (auto& p : pieces)
    for (auto& q : pieces) {
      if (&p == &q || (p.to - q.from).cwiseAbs().maxCoeff() > p.thickness + q.thickness) continue;
      const double turn = floorplan::cross(p.left.along, q.left.along);
      if (std::abs(turn) > small || std::abs(turn) < none || p.left.along.dot(q.left.along) < 0) continue;
      const Eigen::Vector2d end = floorplan::meet(p.left, p.end), begin = floorplan::meet(q.left, q.start);
      if ((end - begin).norm() > touching) continue;
      const Eigen::Vector2d middle = (p.left.along + q.left.along).normalized();
      p.end = q.start = {end, {middle.y(), -middle.x()}};
    }
}

/// Pieces of which one face is known and no thickness was given get the other face.
std::vector<bool> thicken(std::vector<WallPiece>& pieces, double thickness) {
  std::vector<bool> assumed;
  for (auto& piece : pieces) {
    assumed.push_back(!piece.two_faces());
    if (piece.two_faces()) continue;
    const Eigen::Vector2d left(-piece.left.along.y(), piece.left.along.x());
    piece.right.point = piece.left.point - thickness * left;
    piece.from -= 0.5 * thickness * left;
    piece.to -= 0.5 * thickness * left;
    piece.thickness = thickness;
  }
  return assumed;
}

PlanRing outline_of_piece(const WallPiece& piece) {
  return {floorplan::meet(piece.right, piece.start), floorplan::meet(piece.right, piece.end),
          floorplan::meet(piece.left, piece.end), floorplan::meet(piece.left, piece.start)};
}

/// Counter-clockwise, and no larger than walls are.
bool is_sound(const PlanRing& outline) {
  constexpr double largest = 1e5;  // metres
  for (const auto& p : outline)
    if (!((p - outline.front()).norm() < largest)) return false;
  return PlanPolygon{outline, {}}.area() > 0;
}

/// Sets start, length and profile by the footprint; false if nothing is left.
bool settle(const Building& building, Wall& wall) {
  double from = 1e300, to = -1e300;
  for (const auto& p : wall.footprint.outline) {
    from = std::min(from, wall.local(p).x());
    to = std::max(to, wall.local(p).x());
  }
  if (!(to - from > touching)) return false;
  wall.start += from * wall.along;
  wall.length = to - from;
  std::vector<std::vector<ProfilePart>> profiles;
  for (const auto f : wall.faces)
    profiles.push_back(profile_of(building, building.faces[static_cast<std::size_t>(f)], wall.start, wall.along));
  wall.profile = joined_profile(profiles, wall.length);
  return !wall.profile.empty() && wall.high() - wall.low() > touching;
}

std::vector<Stretch> stretches_of(const Building& building, std::int32_t storey, const std::vector<WallFace>& faces,
                                  const ElementLimits& limits) {
  std::vector<WallPiece> pieces = floorplan::paired_faces(
      faces, {min_thickness, limits.max_thickness, wall_parallel_angle, corner_gap, 0.001, 0.01});
  std::erase_if(pieces, [](const WallPiece& piece) { return piece.length() < touching; });  // they have no direction
  const std::vector<bool> assumed = thicken(pieces, limits.assumed_wall);
  const std::vector<WallPiece> square = pieces;
  pieces = floorplan::joined_ends(pieces, corner_gap);
  mitre(pieces);
  std::vector<Stretch> result;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const WallPiece& piece = pieces[i];
    if (piece.length() < touching || piece.primitives.empty()) continue;
    Stretch stretch;
    stretch.two_faces = !assumed[i];
    stretch.outline = outline_of_piece(piece);
    if (!is_sound(stretch.outline)) stretch.outline = outline_of_piece(square[i]);
    Wall& wall = stretch.wall;
    wall.storey = storey;
    wall.faces = piece.primitives;
    wall.start = piece.from;
    wall.along = (piece.to - piece.from).normalized();
    wall.thickness = piece.thickness;
    wall.assumed = assumed[i];
    wall.left_room = building.faces[static_cast<std::size_t>(wall.faces[0])].room;
    if (wall.faces.size() > 1) wall.right_room = building.faces[static_cast<std::size_t>(wall.faces[1])].room;
    wall.footprint = {stretch.outline, {}};
    if (settle(building, wall)) result.push_back(std::move(stretch));
  }
  return result;
}

/// Higher walls, then those of two faces, then longer ones go on; the others end at them.
void order(std::vector<Stretch>& stretches) {
  constexpr double height_step = 0.1;  // metres: less is no difference
  const auto key = [](const Stretch& s) {
    return std::tuple(-std::floor(s.wall.high() / height_step), !s.two_faces, -s.wall.length, s.wall.faces);
  };
  std::stable_sort(stretches.begin(), stretches.end(),
                   [&](const Stretch& a, const Stretch& b) { return key(a) < key(b); });
}

bool in_common(double low_a, double high_a, double low_b, double high_b) {
  return std::min(high_a, high_b) - std::max(low_a, low_b) > overlapping;
}

/// What of the outline is free of rooms and of the walls that come first.
Region free_of(const Stretch& stretch, const std::vector<RoomSpace>& rooms, const std::vector<Wall>& walls,
               std::size_t first, const std::vector<Box>& boxes) {
  const Box box(stretch.outline);
  const double low = stretch.wall.low(), high = stretch.wall.high();
  Region taken;
  for (const auto& room : rooms) {
    if (!box.meets(room.box)) continue;
    const Region own = occupied(room, low, high, overlapping);
    taken.insert(taken.end(), own.begin(), own.end());
  }
  for (std::size_t i = first; i < walls.size(); ++i)
    if (box.meets(boxes[i - first])) taken.push_back(walls[i].footprint);
  return floorplan::parted(floorplan::minus(floorplan::united({stretch.outline}), floorplan::joined(taken, {})));
}

/// Gives a crumb to the wall that it shares most of its border with, where their heights agree; false without one.
bool joins_neighbour(const Building& building, const Wall& crumb, std::vector<Wall>& walls, std::size_t first) {
  const Region around = floorplan::grown({crumb.footprint}, touching);
  double most = 0;
  std::size_t best = walls.size();
  for (std::size_t i = first; i < walls.size(); ++i) {
    if (!walls[i].level() || std::abs(walls[i].high() - crumb.high()) > 0.01 ||
        std::abs(walls[i].low() - crumb.low()) > 0.01 ||
        !Box(crumb.footprint.outline).meets(Box(walls[i].footprint.outline), touching))
      continue;
    const double shared = floorplan::area(floorplan::common(around, {walls[i].footprint}));
    if (shared <= most) continue;
    most = shared;
    best = i;
  }
  if (best == walls.size()) return false;
  Region both = floorplan::joined({walls[best].footprint}, {crumb.footprint});
  if (both.size() != 1) return false;
  walls[best].footprint = std::move(both.front());
  settle(building, walls[best]);
  return true;
}

void add_storey(const Building& building, std::vector<Stretch> stretches, const std::vector<RoomSpace>& rooms,
                std::vector<Wall>& walls) {
  const std::size_t first = walls.size();
  std::vector<Wall> crumbs;
  std::vector<Box> boxes;
  order(stretches);
  for (const auto& stretch : stretches)
    for (auto& polygon : free_of(stretch, rooms, walls, first, boxes)) {
      if (polygon.area() < least_area || floorplan::grown({polygon}, -0.5 * touching).empty()) continue;
      Wall wall = stretch.wall;
      wall.footprint = std::move(polygon);
      if (!settle(building, wall)) continue;
      if (wall.footprint.area() < crumb_area && wall.footprint.area() < 0.5 * PlanPolygon{stretch.outline, {}}.area()) {
        crumbs.push_back(std::move(wall));
      } else {
        boxes.emplace_back(wall.footprint.outline);
        walls.push_back(std::move(wall));
      }
    }
  for (auto& crumb : crumbs)
    if (!joins_neighbour(building, crumb, walls, first)) walls.push_back(std::move(crumb));
}

void lower_heads(Wall& wall, double height) {
  for (auto& part : wall.profile) {
    part.high_from = std::min(part.high_from, height);
    part.high_to = std::min(part.high_to, height);
  }
}

/// Where a wall of an upper storey stands in the upper part of one from below, that one ends at its foot.
void part_storeys(const Building& building, std::vector<Wall>& walls) {
  for (std::size_t i = 0; i < walls.size(); ++i)
    for (std::size_t k = 0; k < walls.size(); ++k) {
      if (walls[k].storey <= walls[i].storey ||
          !in_common(walls[i].low(), walls[i].high(), walls[k].low(), walls[k].high()))
        continue;
      if (!Box(walls[i].footprint.outline).meets(Box(walls[k].footprint.outline))) continue;
      const Region below = floorplan::parted(floorplan::common({walls[i].footprint}, {walls[k].footprint}));
      if (floorplan::area(below) < least_area) continue;
      const Region beside = floorplan::parted(floorplan::minus({walls[i].footprint}, {walls[k].footprint}));
      const double foot = walls[k].low();
      std::vector<Wall> pieces;
      for (const Region* region : {&below, &beside})
        for (const auto& polygon : *region) {
          Wall piece = walls[i];
          piece.footprint = polygon;
          if (polygon.area() < least_area || !settle(building, piece)) continue;
          if (region == &below) lower_heads(piece, foot);
          if (piece.high() - piece.low() > touching) pieces.push_back(std::move(piece));
        }
      if (pieces.empty()) continue;
      walls[i] = pieces.front();
      walls.insert(walls.end(), pieces.begin() + 1, pieces.end());
    }
}

}  // namespace

void add_walls(const Building& building, const ElementLimits& limits, const std::vector<RoomSpace>& rooms,
               Elements& elements) {
  std::vector<bool> of_columns(building.faces.size(), false);
  for (const auto& column : elements.columns)
    for (const auto f : column.faces) of_columns[static_cast<std::size_t>(f)] = true;
  for (std::size_t s = 0; s < building.storeys.size(); ++s) {
    const auto storey = static_cast<std::int32_t>(s);
    const auto faces = faces_of_storey(building, storey, rooms, of_columns);
    remember_lines(building, faces, elements);
    add_storey(building, stretches_of(building, storey, faces, limits), rooms, elements.walls);
  }
  part_storeys(building, elements.walls);
  std::stable_sort(elements.walls.begin(), elements.walls.end(), [](const Wall& a, const Wall& b) {
    return std::tuple(a.storey, a.faces, a.start.x(), a.start.y()) <
           std::tuple(b.storey, b.faces, b.start.x(), b.start.y());
  });
}

}  // namespace atrium::building
