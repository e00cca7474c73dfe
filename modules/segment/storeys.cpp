#include "modules/segment/storeys.hpp"

#include <algorithm>
#include <limits>

namespace atrium::segment {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

const PlaneExtent* largest(const std::vector<PlaneExtent>& planes) {
  const auto it =
      std::max_element(planes.begin(), planes.end(), [](const auto& l, const auto& r) { return l.size() < r.size(); });
  return it == planes.end() ? nullptr : &*it;
}

void add(Storey& storey, const PlaneExtent& plane) {
  (plane.faces_up ? storey.floors : storey.ceilings).push_back(plane);
}

/// Is a storey complete below this floor: has it a ceiling between its own floor and this one, high enough to stand in?
bool closes(const Storey& storey, const PlaneExtent& floor, double min_storey_height) {
  if (storey.ceilings.empty()) return false;
  const double ceiling = storey.ceilings.back().height;
  const double lowest =
      storey.floors.empty() ? storey.ceilings.front().height - infinity : storey.floors.front().height;
  return ceiling <= floor.height && ceiling - lowest >= min_storey_height;
}

/// Is there room above a storey's first floor: a ceiling or walls?
bool is_inhabited(const Storey& storey, const std::vector<PlaneExtent>& walls, const StoreyLimits& limits) {
  if (storey.floors.empty()) return true;
  const double floor = storey.floors.front().height;
  for (const auto& ceiling : storey.ceilings)
    if (limits.height_of(ceiling) - floor >= limits.min_storey_height) return true;
  return std::any_of(walls.begin(), walls.end(), [&](const auto& wall) {
    return wall.top - std::max(wall.bottom, floor) > limits.min_wall_height;
  });
}

/// Walks up through the planes: a floor above a ceiling begins the next storey.
std::vector<Storey> stack(std::vector<PlaneExtent> planes, const std::vector<PlaneExtent>& walls,
                          const StoreyLimits& limits) {
  std::stable_sort(planes.begin(), planes.end(), [](const auto& l, const auto& r) { return l.height < r.height; });
  std::vector<Storey> storeys(1, Storey{{}, {}, -infinity, infinity});
  for (const auto& plane : planes) {
    if (plane.faces_up && closes(storeys.back(), plane, limits.min_storey_height)) {
      const double between = (storeys.back().ceilings.back().height + plane.height) / 2;
      storeys.back().high = between;
      storeys.push_back({{}, {}, between, infinity});
    }
    add(storeys.back(), plane);
  }
  while (storeys.size() > 1 && !is_inhabited(storeys.back(), walls, limits)) {
    storeys.pop_back();
    storeys.back().high = infinity;
  }
  return storeys;
}

/// Equation 1, with h measured from the main plane opposite, so that it does not depend on where z = 0 lies. Where the
/// opposite plane is missing, the walls' ends stand for it.
void choose(Storey& storey, double walls_bottom, double walls_top, bool is_one_of_several, const StoreyLimits& limits) {
  const PlaneExtent* floor = largest(storey.floors);
  const PlaneExtent* ceiling = largest(storey.ceilings);
  // Too near to each other, or the wrong way round: the lesser is furniture (a wardrobe's top, a shelf's underside).
  if (floor && ceiling && limits.height_of(*ceiling) - floor->height < limits.min_storey_height)
    (floor->size() < ceiling->size() ? floor : ceiling) = nullptr;
  const double bottom = floor ? floor->height : walls_bottom;
  const double top = ceiling ? ceiling->height : walls_top;
  const double highest = ceiling ? ceiling->height - bottom : 0;
  const double deepest = floor ? top - floor->height : 0;
  if (!ceiling) storey.ceilings.clear();
  if (!floor) storey.floors.clear();
  if (is_one_of_several && limits.share_alone) return;
  std::erase_if(storey.ceilings,
                [&](const auto& p) { return limits.height_of(p) - bottom < limits.ceiling_share * highest; });
  std::erase_if(storey.floors, [&](const auto& p) { return top - p.height < limits.floor_share * deepest; });
}

}  // namespace

std::vector<Storey> find_storeys(const std::vector<PlaneExtent>& horizontal, const std::vector<PlaneExtent>& walls,
                                 const StoreyLimits& limits) {
  double most = 0;
  for (const auto& plane : horizontal) most = std::max(most, static_cast<double>(plane.points));
  std::vector<PlaneExtent> counting;
  for (const auto& plane : horizontal)
    if (static_cast<double>(plane.points) >= limits.storey_share * most) counting.push_back(plane);
  std::vector<Storey> storeys = stack(std::move(counting), walls, limits);
  if (storeys.size() == 1) {  // the 10 % rule is for several storeys only
    storeys = {Storey{{}, {}, -infinity, infinity}};
    for (const auto& plane : horizontal) add(storeys.front(), plane);
  }
  double bottom = infinity;
  double top = -infinity;
  for (const auto& wall : walls) {
    bottom = std::min(bottom, wall.bottom);
    top = std::max(top, wall.top);
  }
  for (auto& storey : storeys) choose(storey, bottom, top, storeys.size() > 1, limits);
  return storeys;
}

}  // namespace atrium::segment
