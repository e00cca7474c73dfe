#include "modules/floorplan/rooms.hpp"

#include <algorithm>

#include "modules/geometry/quantile.hpp"

namespace atrium::floorplan {
namespace {

constexpr double thin = 0.001;  // metres to both sides of a face: what is cut out to part rooms, and given back after
constexpr double least_floor = 1.0 / 3;
constexpr double beyond = 0.05;  // metres: a face that ends just before another still divides

Region dividers(const PlanStorey& storey, const std::vector<WallFace>& faces, double max_opening) {
  std::vector<PlanRing> strips;
  for (const auto& wall : storey.walls)
    if (wall.thickness <= 0) strips.push_back(strip(wall.from, wall.to, thin, beyond));
  for (const auto& face : faces)
    for (std::size_t i = 1; i < face.spans.size(); ++i)
      if (face.spans[i].from - face.spans[i - 1].to <= max_opening)
        strips.push_back(strip(face.at(face.spans[i - 1].to), face.at(face.spans[i].from), thin, beyond));
  return united(strips);
}

// The part of `open` given back what the dividers took: its edges stand on the faces themselves, and the slits that
// dividers cut at reflex corners are gone. It keeps to what is `free`.
Region given_back(const PlanPolygon& part, const Region& free) {
  const Region whole = common(grown(grown({part}, 2 * thin), -thin), free);
  return grown(grown(whole, -thin), thin);  // without what runs into cracks between walls
}

}  // namespace

std::vector<PlanRoom> rooms_of(const Region& ground, const PlanStorey& storey, const std::vector<WallFace>& faces,
                               const RoomLimits& limits) {
  Region free = minus(ground, storey.bodies);
  Region open = minus(free, dividers(storey, faces, limits.max_opening));
  std::vector<PlanRoom> rooms;
  for (const auto& core : grown(open, -0.5 * limits.min_width)) {
    // The core grown back, and nothing that another room has.
    Region parts = common(grown({core}, 0.5 * limits.min_width + thin), open);
    if (parts.empty()) continue;
    open = minus(open, {parts.front()});
    parts = given_back(parts.front(), free);
    if (parts.empty() || parts.front().area() < limits.min_area) continue;
    free = minus(free, {parts.front()});
    // Ceilings that stick out past the walls are no rooms.
    if (storey.floors.empty() || area(common(parts, storey.floors)) >= least_floor * parts.front().area())
      rooms.push_back({{}, std::move(parts.front()), 0});
  }
  std::stable_sort(rooms.begin(), rooms.end(),
                   [](const PlanRoom& a, const PlanRoom& b) { return a.polygon.area() > b.polygon.area(); });
  return rooms;
}

std::optional<double> height_of(const PlanRoom& room, const std::vector<Surface>& ceilings, double elevation) {
  std::vector<std::pair<double, double>> heights;  // and areas
  for (const auto& surface : ceilings)
    for (const auto& triangle : surface.triangles) {
      const PlanRing ring{triangle[0].head<2>(), triangle[1].head<2>(), triangle[2].head<2>()};
      for (const auto& part : common(united({ring}), {room.polygon})) {
        Eigen::Vector2d middle = Eigen::Vector2d::Zero();
        for (const auto& corner : part.outline) middle += corner / static_cast<double>(part.outline.size());
        const double drop = surface.normal.head<2>().dot(middle - surface.centre.head<2>()) / surface.normal.z();
        heights.emplace_back(surface.centre.z() - drop - elevation, part.area());
      }
    }
  if (heights.empty()) return {};
  return weighted_quantile(std::move(heights), 0.5);
}

}  // namespace atrium::floorplan
