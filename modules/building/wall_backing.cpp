#include <algorithm>
#include <cmath>

#include "modules/building/element_steps.hpp"
#include "modules/building/profile.hpp"
#include "modules/geometry/polygon.hpp"

namespace atrium::building {
namespace {

constexpr double just_behind = 0.001;         // metres
constexpr double least_common_height = 0.01;  // metres: a wall of another storey stands behind no face
constexpr double on_ring = 0.001;             // metres
constexpr double least_part = 0.02;           // metres of an opening: less of it in a wall is none

struct Range {
  double from = 1e300, to = -1e300;
  void add(double v) {
    from = std::min(from, v);
    to = std::max(to, v);
  }
};

/// Where the line just behind a face runs through the polygon.
std::vector<Range> crossings(const FaceLine& line, const PlanPolygon& polygon) {
  std::vector<double> stops;
  const auto cross_ring = [&](const PlanRing& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Eigen::Vector2d &a = ring[i], &b = ring[(i + 1) % ring.size()];
      const double da = line.normal.dot(a) - line.offset + just_behind;
      const double db = line.normal.dot(b) - line.offset + just_behind;
      if ((da > 0) == (db > 0)) continue;
      stops.push_back(line.along().dot(a + (b - a) * (da / (da - db))));
    }
  };
  cross_ring(polygon.outline);
  for (const auto& hole : polygon.holes) cross_ring(hole);
  std::sort(stops.begin(), stops.end());
  std::vector<Range> result;
  for (std::size_t i = 0; i + 1 < stops.size(); i += 2) result.push_back({stops[i], stops[i + 1]});
  return result;
}

double distance_to_ring(const Eigen::Vector2d& p, const PlanRing& ring) {
  double least = 1e300;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d &a = ring[i], side = ring[(i + 1) % ring.size()] - a;
    const double t = std::clamp(side.dot(p - a) / std::max(side.squaredNorm(), 1e-12), 0.0, 1.0);
    least = std::min(least, (p - a - t * side).norm());
  }
  return least;
}

bool is_column(const PlanRing& ring, double widest) {
  const Polygon2 hull = convex_hull(ring);
  if (hull.size() < 3) return false;
  const Rectangle2 box = minimum_area_rectangle(hull);
  return ((box.high - box.low).array() <= widest).all();
}

const FaceLine* line_of_face(const Elements& elements, std::int32_t face) {
  const auto found =
      std::find_if(elements.lines.begin(), elements.lines.end(), [&](const FaceLine& l) { return l.face == face; });
  return found == elements.lines.end() ? nullptr : &*found;
}

double area_within(const WallHole& hole, const Wall& wall) {
  if (!(hole.to > hole.from) || !(hole.high > hole.low)) return 0;
  const PlanRing rectangle{{hole.from, hole.low}, {hole.to, hole.low}, {hole.to, hole.high}, {hole.from, hole.high}};
  return floorplan::area(
      floorplan::common(floorplan::united({rectangle}), floorplan::united({outline_of(wall.profile)})));
}

/// What a hole of that area takes from a wall, which may be thicker at one end.
double volume_within(const WallHole& hole, const Wall& wall) {
  const double far = 1e3;  // metres: beyond any wall
  const PlanRing band{wall.global({hole.from, -far}), wall.global({hole.to, -far}), wall.global({hole.to, far}),
                      wall.global({hole.from, far})};
  return floorplan::area(floorplan::common({wall.footprint}, {{band, {}}})) * hole.area / (hole.to - hole.from);
}

/// Puts the opening into the walls that stand behind its face.
void pierce(const BuildingOpening& opening, std::int32_t index, const FaceLine& line, Elements& elements) {
  Range along, heights;
  const auto measure = [&](const std::vector<Eigen::Vector3d>& outline, Range& s, Range& z) {
    for (const auto& p : outline) {
      s.add(line.along().dot(p.head<2>()));
      z.add(p.z());
    }
  };
  measure(opening.outline_a, along, heights);
  if (opening.outline_b.size() >= 3) {
    Range other, other_heights;
    measure(opening.outline_b, other, other_heights);
    along = {0.5 * (along.from + other.from), 0.5 * (along.to + other.to)};
    heights = {0.5 * (heights.from + other_heights.from), 0.5 * (heights.to + other_heights.to)};
  }
  WallHole* greatest = nullptr;
  std::vector<std::size_t> pierced;
  for (const auto& part : line.backing) {
    const double from = std::max(part.from, along.from), to = std::min(part.to, along.to);
    if (part.wall < 0 || to - from < std::min(least_part, 0.5 * (along.to - along.from))) continue;
    Wall& wall = elements.walls[static_cast<std::size_t>(part.wall)];
    WallHole hole{index};
    const double s = wall.local(line.at(from)).x(), t = wall.local(line.at(to)).x();
    hole.from = std::min(s, t);
    hole.to = std::max(s, t);
    hole.low = heights.from;
    hole.high = heights.to;
    hole.area = area_within(hole, wall);
    if (hole.area < least_part * least_part) continue;
    hole.volume = volume_within(hole, wall);
    wall.holes.push_back(hole);
    pierced.push_back(static_cast<std::size_t>(part.wall));
  }
  for (const auto w : pierced)
    for (auto& hole : elements.walls[w].holes)
      if (hole.opening == index) {
        hole.main = false;
        if (greatest == nullptr || hole.area > greatest->area) greatest = &hole;
      }
  if (greatest != nullptr) greatest->main = true;
}

}  // namespace

void add_columns(const Building& building, const ElementLimits& limits, Elements& elements) {
  for (std::size_t r = 0; r < building.rooms.size(); ++r) {
    const BuildingRoom& room = building.rooms[r];
    for (const auto& hole : room.holes) {
      Column column;
      column.storey = room.storey;
      column.room = static_cast<std::int32_t>(r);
      for (const auto& p : hole) column.outline.emplace_back(p.head<2>());
      if (!is_column(column.outline, limits.max_column_width)) continue;
      if (PlanPolygon{column.outline, {}}.area() < 0) std::reverse(column.outline.begin(), column.outline.end());
      Range heights;
      for (const auto f : room.faces) {
        const BuildingFace& face = building.faces[static_cast<std::size_t>(f)];
        const auto on = [&](std::uint32_t v) {
          return distance_to_ring(building.vertices[v].head<2>(), column.outline) < on_ring;
        };
        if (face.surface != SurfaceClass::wall || !std::all_of(face.outline.begin(), face.outline.end(), on)) continue;
        column.faces.push_back(f);
        for (const auto v : face.outline) heights.add(building.vertices[v].z());
      }
      if (column.faces.empty() || !(heights.to > heights.from)) continue;
      column.low = heights.from;
      column.high = heights.to;
      elements.columns.push_back(std::move(column));
    }
  }
}

void find_backing(Elements& elements) {
  std::vector<Box> boxes;
  boxes.reserve(elements.walls.size());
  for (const auto& wall : elements.walls) boxes.emplace_back(wall.footprint.outline);
  for (auto& line : elements.lines) {
    const std::vector<Backing> spans = std::move(line.backing);
    line.backing.clear();
    PlanRing ends;
    for (const auto& span : spans) {
      ends.push_back(line.at(span.from));
      ends.push_back(line.at(span.to));
    }
    const Box box(ends);
    for (std::size_t w = 0; w < elements.walls.size(); ++w) {
      const Wall& wall = elements.walls[w];
      if (!box.meets(boxes[w], 2 * just_behind)) continue;
      if (std::min(line.high, wall.high()) - std::max(line.low, wall.low()) < least_common_height) continue;
      for (const auto& piece : crossings(line, elements.walls[w].footprint))
        for (const auto& span : spans) {
          const double from = std::max(span.from, piece.from), to = std::min(span.to, piece.to);
          if (to - from > just_behind) line.backing.push_back({static_cast<std::int32_t>(w), -1, from, to});
        }
    }
    std::sort(line.backing.begin(), line.backing.end(),
              [](const Backing& a, const Backing& b) { return a.from < b.from; });
  }
}

void add_holes(const Building& building, Elements& elements) {
  for (std::size_t o = 0; o < building.openings.size(); ++o) {
    const BuildingOpening& opening = building.openings[o];
    if (opening.outline_a.size() < 3 || in_slab(building, opening)) continue;
    const FaceLine* line = line_of_face(elements, opening.face_a);
    if (line == nullptr) line = line_of_face(elements, opening.face_b);
    if (line != nullptr) pierce(opening, static_cast<std::int32_t>(o), *line, elements);
  }
}

}  // namespace atrium::building
