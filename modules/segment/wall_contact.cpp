#include "modules/segment/wall_contact.hpp"

#include <algorithm>

#include "modules/geometry/polygon_distance.hpp"

namespace atrium::segment {

double wall_contact(const std::vector<PlaneExtent>& walls, const std::vector<Storey>& storeys, double distance) {
  const auto outline_of = [](const PlaneExtent& plane) {
    return std::vector<Eigen::Vector3d>(plane.outline.begin(), plane.outline.end());
  };
  std::vector<std::vector<Eigen::Vector3d>> level;
  for (const auto& storey : storeys) {
    for (const auto& floor : storey.floors) level.push_back(outline_of(floor));
    for (const auto& ceiling : storey.ceilings) level.push_back(outline_of(ceiling));
  }
  double total = 0;
  double meeting = 0;
  for (const auto& wall : walls) {
    const auto outline = outline_of(wall);
    total += wall.length();
    if (std::any_of(level.begin(), level.end(),
                    [&](const auto& l) { return polygon_distance(outline, l) <= distance; }))
      meeting += wall.length();
  }
  return total > 0 ? meeting / total : 0;
}

}  // namespace atrium::segment
