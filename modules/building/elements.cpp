#include "modules/building/elements.hpp"

#include <algorithm>

#include "modules/building/element_steps.hpp"
#include "modules/building/profile.hpp"

namespace atrium::building {

Eigen::Vector2d Wall::local(const Eigen::Vector2d& p) const {
  const Eigen::Vector2d d = p - start;
  return {along.dot(d), along.x() * d.y() - along.y() * d.x()};
}

Eigen::Vector2d Wall::global(const Eigen::Vector2d& p) const {
  return start + p.x() * along + p.y() * Eigen::Vector2d(-along.y(), along.x());
}

double Wall::low() const {
  double low = 1e300;
  for (const auto& part : profile) low = std::min({low, part.low_from, part.low_to});
  return low;
}

double Wall::high() const {
  double high = -1e300;
  for (const auto& part : profile) high = std::max({high, part.high_from, part.high_to});
  return high;
}

double Wall::gross_area() const {
  double sum = 0;
  for (const auto& part : profile)
    sum += (part.to - part.from) * 0.5 * (part.high_from - part.low_from + part.high_to - part.low_to);
  return sum;
}

double Wall::net_area() const {
  double sum = gross_area();
  for (const auto& hole : holes) sum -= hole.area;
  return sum;
}

namespace {

/// The integral of a linear height over a polygon (s, t), the height given at s = 0 and its rate along s.
double volume_under(const PlanRing& ring, double at_zero, double rate) {
  double area = 0, moment = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d &a = ring[i], &b = ring[(i + 1) % ring.size()];
    const double cross = a.x() * b.y() - b.x() * a.y();
    area += 0.5 * cross;
    moment += cross * (a.x() + b.x()) / 6;
  }
  return at_zero * area + rate * moment;
}

}  // namespace

double Wall::gross_volume() const {
  double sum = 0;
  for (const auto& part : profile) {
    const double span = part.to - part.from, first = part.high_from - part.low_from, last = part.high_to - part.low_to;
    const double rate = (last - first) / span;
    for (const auto& polygon : footprint_part(*this, part)) {
      const auto add = [&](const PlanRing& ring) {
        PlanRing own;
        for (const auto& p : ring) own.push_back(local(p));
        sum += volume_under(own, first - rate * part.from, rate);
      };
      add(polygon.outline);
      for (const auto& hole : polygon.holes) add(hole);
    }
  }
  return sum;
}

double Wall::net_volume() const {
  double sum = gross_volume();
  for (const auto& hole : holes) sum -= hole.volume;
  return sum;
}

std::vector<PlanPolygon> footprint_part(const Wall& wall, const ProfilePart& part) {
  if (wall.profile.size() == 1) return {wall.footprint};
  const double far = 1e3;  // metres: beyond any wall
  const PlanRing band{wall.global({part.from, -far}), wall.global({part.to, -far}), wall.global({part.to, far}),
                      wall.global({part.from, far})};
  return floorplan::common({wall.footprint}, {{band, {}}});
}

namespace {

RoomSpace::Level level_of(const Building& building, const BuildingFace& face) {
  RoomSpace::Level level{{}, 1e300, -1e300};
  PlanRing ring;
  for (const auto v : face.outline) {
    ring.emplace_back(building.vertices[v].head<2>());
    level.low = std::min(level.low, building.vertices[v].z());
    level.high = std::max(level.high, building.vertices[v].z());
  }
  level.region = floorplan::united({ring});
  return level;
}

}  // namespace

Region occupied(const RoomSpace& room, double low, double high, double least) {
  if (std::min(high, room.high) - std::max(low, room.low) <= least) return {};
  const auto below = [&](const RoomSpace::Level& floor) { return floor.low < high - least; };
  const auto above = [&](const RoomSpace::Level& ceiling) { return ceiling.high > low + least; };
  if (std::all_of(room.floors.begin(), room.floors.end(), below) &&
      std::all_of(room.ceilings.begin(), room.ceilings.end(), above))
    return {room.polygon};
  Region under, over;
  for (const auto& floor : room.floors)
    if (below(floor)) under.insert(under.end(), floor.region.begin(), floor.region.end());
  for (const auto& ceiling : room.ceilings)
    if (above(ceiling)) over.insert(over.end(), ceiling.region.begin(), ceiling.region.end());
  return floorplan::common(floorplan::common({room.polygon}, floorplan::joined(under, {})),
                           floorplan::joined(over, {}));
}

std::vector<RoomSpace> spaces_of(const Building& building) {
  std::vector<RoomSpace> result;
  for (const auto& room : building.rooms) {
    RoomSpace space;
    space.low = 1e300;
    space.high = -1e300;
    for (const auto f : room.faces) {
      const BuildingFace& face = building.faces[static_cast<std::size_t>(f)];
      for (const auto v : face.outline) {
        space.low = std::min(space.low, building.vertices[v].z());
        space.high = std::max(space.high, building.vertices[v].z());
      }
      if (face.surface == SurfaceClass::floor) space.floors.push_back(level_of(building, face));
      if (face.surface == SurfaceClass::ceiling) space.ceilings.push_back(level_of(building, face));
    }
    std::vector<PlanRing> holes;
    PlanRing outline;
    for (const auto& p : room.outline) outline.emplace_back(p.head<2>());
    for (const auto& hole : room.holes) {
      holes.emplace_back();
      for (const auto& p : hole) holes.back().emplace_back(p.head<2>());
    }
    Region region = floorplan::minus(floorplan::united({outline}), floorplan::united(holes));
    if (!region.empty()) space.polygon = std::move(region.front());
    space.box = Box(space.polygon.outline);
    result.push_back(std::move(space));
  }
  return result;
}

Elements elements_of(const Building& building, const ElementLimits& limits) {
  Elements elements;
  elements.slab_of_face.assign(building.faces.size(), -1);
  const std::vector<RoomSpace> rooms = spaces_of(building);
  add_columns(building, limits, elements);
  add_walls(building, limits, rooms, elements);
  find_backing(elements);
  add_holes(building, elements);
  add_slabs(building, limits, rooms, elements);
  return elements;
}

}  // namespace atrium::building
