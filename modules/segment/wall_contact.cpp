#include "modules/segment/wall_contact.hpp"

#include <algorithm>
#include <cmath>

#include "modules/geometry/polygon_distance.hpp"

namespace atrium::segment {
namespace {

using Outline = std::vector<Eigen::Vector3d>;

Outline outline_of(const PlaneExtent& plane) { return {plane.outline.begin(), plane.outline.end()}; }

bool is_near(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const std::vector<Outline>& planes,
             double distance) {
  return std::any_of(planes.begin(), planes.end(),
                     [&](const Outline& plane) { return segment_polygon_distance(from, to, plane) <= distance; });
}

/// The length of a wall along which a floor is at its foot or a ceiling at its head.
double length_in_contact(const PlaneExtent& wall, const std::vector<Outline>& floors,
                         const std::vector<Outline>& ceilings, double distance) {
  constexpr double step = 0.1;         // metres
  const auto& corners = wall.outline;  // the first two are level, at the foot
  const Eigen::Vector3d along = corners[1] - corners[0];
  const int steps = std::max(1, static_cast<int>(std::lround(along.norm() / step)));
  int meeting = 0;
  for (int i = 0; i < steps; ++i) {
    const Eigen::Vector3d begin = along * i / steps;
    const Eigen::Vector3d end = along * (i + 1) / steps;
    if (is_near(corners[0] + begin, corners[0] + end, floors, distance) ||
        is_near(corners[3] + begin, corners[3] + end, ceilings, distance))
      ++meeting;
  }
  return along.norm() * meeting / steps;
}

}  // namespace

double wall_contact(const std::vector<PlaneExtent>& walls, const std::vector<Storey>& storeys, double distance) {
  std::vector<Outline> floors, ceilings;
  for (const auto& storey : storeys) {
    for (const auto& floor : storey.floors) floors.push_back(outline_of(floor));
    for (const auto& ceiling : storey.ceilings) ceilings.push_back(outline_of(ceiling));
  }
  double total = 0;
  double meeting = 0;
  for (const auto& wall : walls) {
    total += wall.length();
    meeting += length_in_contact(wall, floors, ceilings, distance);
  }
  return total > 0 ? meeting / total : 0;
}

}  // namespace atrium::segment
