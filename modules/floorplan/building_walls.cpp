#include "modules/floorplan/building_walls.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "modules/floorplan/drawn_openings.hpp"
#include "modules/floorplan/wall_pieces.hpp"

namespace atrium::floorplan {
namespace {

constexpr double beside = 0.005;          // metres: where the two sides of a wall's face are looked at
constexpr double in_wall = 0.03;          // metres that an opening may lie off the wall that it interrupts
constexpr double parallel = 0.05;         // sin 3°
constexpr double shortest_piece = 0.001;  // metres

using Ring = std::vector<std::uint32_t>;

bool contains(const PlanPolygon& polygon, const Eigen::Vector2d& p) {
  bool inside = false;
  const auto cross_ring = [&](const PlanRing& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Eigen::Vector2d &a = ring[i], &b = ring[(i + 1) % ring.size()];
      if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()))
        inside = !inside;
    }
  };
  cross_ring(polygon.outline);
  for (const auto& hole : polygon.holes) cross_ring(hole);
  return inside;
}

/// Where a face's rings cross the height, along the line of the wall: every second span is wall.
std::vector<Span> section(const Building& building, const BuildingFace& face, double height, const WallFace& line) {
  std::vector<double> stops;
  const auto cut = [&](const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Eigen::Vector3d &a = building.vertices[ring[i]], &b = building.vertices[ring[(i + 1) % ring.size()]];
      if ((a.z() > height) == (b.z() > height)) continue;
      const double share = (height - a.z()) / (b.z() - a.z());
      stops.push_back(line.coordinate(a.head<2>() + share * (b - a).head<2>()));
    }
  };
  cut(face.outline);
  for (const auto& hole : face.holes) cut(hole);
  std::sort(stops.begin(), stops.end());
  std::vector<Span> spans;
  for (std::size_t i = 0; i + 1 < stops.size(); i += 2)
    if (stops[i + 1] - stops[i] > shortest_piece) spans.push_back({stops[i], stops[i + 1]});
  return spans;
}

/// The face as a line, whatever its plane says: where it reaches `height` or ends below. What is only above (a lintel)
/// is left out, unless all of it is.
WallFace line_of(const Building& building, const BuildingFace& face, double height) {
  constexpr double inside = 0.01, hairline = 0.002;  // metres
  WallFace line;
  const Eigen::Vector3d& first = building.vertices[face.outline[0]];
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < face.outline.size(); ++i)
    normal += (building.vertices[face.outline[i]] - first).cross(building.vertices[face.outline[i + 1]] - first);
  if (!(normal.norm() > 0) || normal.head<2>().norm() < 0.1 * normal.norm()) return line;
  double low = 1e300, high = -1e300;
  for (const auto v : face.outline) {
    low = std::min(low, building.vertices[v].z());
    high = std::max(high, building.vertices[v].z());
  }
  const double middle = 0.5 * (low + high);
  const double at = std::clamp(height, std::min(low + inside, middle), std::max(high - inside, middle));
  normal.normalize();
  const double level = normal.head<2>().norm();
  line.normal = normal.head<2>() / level;
  line.point = first.head<2>() - line.normal * (normal.z() * (at - first.z()) / level);
  std::vector<Span> spans = section(building, face, at, line);
  for (const auto v : face.outline)
    for (const double z : {building.vertices[v].z() - inside, building.vertices[v].z() + inside})
      if (z < at)
        for (const auto& span : section(building, face, z, line)) spans.push_back(span);
  line.spans = merged(std::move(spans), hairline);
  return line;
}

Eigen::Vector2d extent(const std::vector<Eigen::Vector3d>& outline, const Eigen::Vector2d& along) {
  Eigen::Vector2d range(1e300, -1e300);
  for (const auto& p : outline) {
    range.x() = std::min(range.x(), along.dot(p.head<2>()));
    range.y() = std::max(range.y(), along.dot(p.head<2>()));
  }
  return range;
}

Eigen::Vector2d heights(const std::vector<Eigen::Vector3d>& outline) {
  Eigen::Vector2d range(1e300, -1e300);
  for (const auto& p : outline) range = {std::min(range.x(), p.z()), std::max(range.y(), p.z())};
  return range;
}

PlanOpening in_a_wall(const BuildingOpening& source, const Eigen::Vector3d& normal, double elevation) {
  PlanOpening opening;
  opening.kind = source.kind;
  opening.thickness = source.thickness;
  const Eigen::Vector2d inwards = normal.head<2>().normalized(), along(inwards.y(), -inwards.x());
  Eigen::Vector2d range = extent(source.outline_a, along);
  if (source.outline_b.size() >= 3) range = 0.5 * (range + extent(source.outline_b, along));
  const Eigen::Vector2d on = source.outline_a[0].head<2>() - 0.5 * source.thickness * inwards;
  opening.from = on + (range.x() - along.dot(on)) * along;
  opening.to = on + (range.y() - along.dot(on)) * along;
  if (opening.thickness > 0) opening.outline = gap_of(opening, 0);
  const Eigen::Vector2d z = heights(source.outline_a);
  opening.sill = z.x() - elevation;
  opening.height = z.y() - z.x();
  return opening;
}

PlanOpening in_a_slab(const std::vector<Eigen::Vector3d>& outline, double thickness, double elevation) {
  PlanOpening opening;
  opening.kind = "slab";
  opening.thickness = thickness;
  opening.sill = heights(outline).x() - elevation;
  for (const auto& p : outline) opening.outline.emplace_back(p.head<2>());
  if (PlanPolygon{opening.outline, {}}.area() < 0) std::reverse(opening.outline.begin(), opening.outline.end());
  return opening;
}

bool is_face(const Building& building, std::int32_t face) {
  return face >= 0 && static_cast<std::size_t>(face) < building.faces.size();
}

/// Whether the room lies on both sides of the opening.
bool within(const PlanPolygon& room, const PlanOpening& opening) {
  const Eigen::Vector2d along = (opening.to - opening.from).normalized(), left(-along.y(), along.x());
  return contains(room, 0.5 * (opening.from + opening.to) - (0.5 * opening.thickness + beside) * left);
}

/// What of the wall the opening takes, along it.
Span taken(const PlanWall& wall, const PlanOpening& opening) {
  const Eigen::Vector2d along = (wall.to - wall.from).normalized(), other = (opening.to - opening.from).normalized();
  if (std::abs(cross(along, other)) > parallel) return {};
  const double off = std::abs(cross(along, 0.5 * (opening.from + opening.to) - wall.from));
  if (off > 0.5 * (wall.thickness + opening.thickness) + in_wall) return {};
  // A single face is interrupted only by what pierces it from its own side, or goes through.
  if (wall.thickness <= 0 && opening.thickness <= 0 && along.dot(other) < 0) return {};
  const double a = along.dot(opening.from - wall.from), b = along.dot(opening.to - wall.from);
  return {std::min(a, b), std::max(a, b)};
}

PlanWall piece_of(const PlanWall& wall, const Span& span) {
  const double length = (wall.to - wall.from).norm();
  const Eigen::Vector2d along = (wall.to - wall.from) / length;
  const Eigen::Vector2d right = 0.5 * wall.thickness * Eigen::Vector2d(along.y(), -along.x());
  PlanWall piece = wall;
  piece.from = wall.from + span.from * along;
  piece.to = wall.from + span.to * along;
  if (wall.outline.size() != 4) return piece;
  if (span.from > 0) {
    piece.outline[0] = piece.from + right;
    piece.outline[3] = piece.from - right;
  }
  if (span.to < length) {
    piece.outline[1] = piece.to + right;
    piece.outline[2] = piece.to - right;
  }
  return piece;
}

}  // namespace

std::vector<WallFace> wall_faces(const Building& building, std::int32_t storey, double height,
                                 const std::vector<PlanPolygon>& rooms) {
  std::vector<WallFace> result;
  const double at = building.storeys[static_cast<std::size_t>(storey)].elevation + height;
  for (std::size_t f = 0; f < building.faces.size(); ++f) {
    const BuildingFace& face = building.faces[f];
    if (face.storey != storey || face.surface != SurfaceClass::wall) continue;
    WallFace line = line_of(building, face, at);
    line.primitive = static_cast<std::int32_t>(f);
    line.backing = face.backing;
    if (face.room >= 0 && static_cast<std::size_t>(face.room) < rooms.size()) {
      const PlanPolygon& room = rooms[static_cast<std::size_t>(face.room)];
      std::erase_if(line.spans, [&](const Span& span) {
        return contains(room, line.at(0.5 * (span.from + span.to)) - beside * line.normal);
      });
    }
    if (!line.spans.empty()) result.push_back(std::move(line));
  }
  return result;
}

std::vector<PlanOpening> plan_openings(const Building& building, std::int32_t storey,
                                       const std::vector<PlanPolygon>& rooms, const std::vector<std::int32_t>& number) {
  std::vector<PlanOpening> result;
  const double elevation = building.storeys[static_cast<std::size_t>(storey)].elevation;
  const auto room = [&](std::int32_t index) {
    return index >= 0 && static_cast<std::size_t>(index) < number.size() ? number[static_cast<std::size_t>(index)] : -1;
  };
  for (const auto& source : building.openings) {
    const auto add_slab = [&](std::int32_t face, std::int32_t its_room, const std::vector<Eigen::Vector3d>& outline) {
      if (!is_face(building, face) || building.faces[static_cast<std::size_t>(face)].storey != storey) return;
      if (outline.size() < 3) return;
      result.push_back(in_a_slab(outline, source.thickness, elevation));
      result.back().room_a = room(its_room);
      result.back().corrected = !source.corrections.empty();
    };
    if (source.kind == "slab") {
      add_slab(source.face_a, source.room_a, source.outline_a);
      add_slab(source.face_b, source.room_b, source.outline_b);
      continue;
    }
    if (!is_face(building, source.face_a) || source.outline_a.size() < 3) continue;
    const BuildingFace& face = building.faces[static_cast<std::size_t>(source.face_a)];
    if (face.storey != storey || face.plane.normal.head<2>().norm() < 0.1) continue;
    PlanOpening opening = in_a_wall(source, face.plane.normal, elevation);
    if (face.room >= 0 && static_cast<std::size_t>(face.room) < rooms.size() &&
        within(rooms[static_cast<std::size_t>(face.room)], opening))
      continue;
    result.push_back(std::move(opening));
    result.back().room_a = room(source.room_a);
    result.back().room_b = room(source.room_b);
    result.back().corrected = !source.corrections.empty();
  }
  return result;
}

void mark_inferred(const Building& building, std::vector<PlanWall>& walls) {
  constexpr double hardly = 0.1;  // share of a face's area
  for (auto& wall : walls)
    wall.inferred = std::all_of(wall.primitives.begin(), wall.primitives.end(), [&](std::int32_t f) {
      if (!is_face(building, f)) return true;
      const BuildingFace& face = building.faces[static_cast<std::size_t>(f)];
      return face.primitive < 0 || face.observed < hardly;
    });
}

void mark_corrected(const Building& building, std::vector<PlanWall>& walls) {
  for (auto& wall : walls)
    wall.corrected = std::any_of(wall.primitives.begin(), wall.primitives.end(), [&](std::int32_t f) {
      return is_face(building, f) && !building.faces[static_cast<std::size_t>(f)].corrections.empty();
    });
}

void interrupt(std::vector<PlanWall>& walls, const std::vector<PlanOpening>& openings) {
  std::vector<PlanWall> result;
  for (const auto& wall : walls) {
    std::vector<Span> spans{{0, (wall.to - wall.from).norm()}};
    for (const auto& opening : openings) {
      if (opening.kind == "slab" || !(opening.width() > 0)) continue;
      if (const Span hole = taken(wall, opening); hole.length() > 0) spans = without(spans, hole);
    }
    for (const auto& span : spans)
      if (span.length() > shortest_piece) result.push_back(piece_of(wall, span));
  }
  walls = std::move(result);
}

}  // namespace atrium::floorplan
