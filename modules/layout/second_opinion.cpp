#include "modules/layout/second_opinion.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "modules/geometry/plan_overlay.hpp"

namespace atrium::layout {
namespace {

struct Place {
  PlanPolygon polygon;
  Eigen::AlignedBox2d box;
  double area = 0;
  double low = 0, high = 0;
};

std::vector<Place> places_of(const Building& building) {
  std::vector<Place> result;
  result.reserve(building.rooms.size());
  for (const auto& room : building.rooms) {
    Place place;
    double z = 0;
    for (const auto& p : room.outline) {
      place.polygon.outline.emplace_back(building.origin.head<2>() + p.head<2>());
      place.box.extend(place.polygon.outline.back());
      z += p.z();
    }
    for (const auto& hole : room.holes) {
      PlanRing& ring = place.polygon.holes.emplace_back();
      for (const auto& p : hole) ring.emplace_back(building.origin.head<2>() + p.head<2>());
    }
    place.low = building.origin.z() + z / static_cast<double>(std::max<std::size_t>(1, room.outline.size()));
    place.high = place.low + room.height;
    place.polygon = overlay::corrected(place.polygon);
    place.area = room.outline.size() < 3 ? 0 : overlay::area(std::vector{place.polygon});
    result.push_back(std::move(place));
  }
  return result;
}

/// Square metres of plan that two places share, if they are on one level.
double shared_area(const Place& a, const Place& b) {
  constexpr double level = 0.5;  // of the lower one's height
  const double common = std::min(a.high, b.high) - std::max(a.low, b.low);
  if (!a.box.intersects(b.box) || common < level * std::min(a.high - a.low, b.high - b.low)) return 0;
  if (!(a.area > 0) || !(b.area > 0)) return 0;
  return overlay::area(overlay::intersection({a.polygon}, b.polygon));
}

}  // namespace

std::vector<SecondOpinion> second_opinions(const Building& building, const Building& other) {
  constexpr double mostly = 0.5;
  const std::vector<Place> rooms = places_of(building), others = places_of(other);
  std::vector<SecondOpinion> result(rooms.size());
  for (std::size_t r = 0; r < rooms.size(); ++r)
    for (const Place& place : others) {
      const double shared = shared_area(rooms[r], place);
      if (!(shared > 0)) continue;
      if (shared > mostly * place.area) ++result[r].parts;
      const double of_both = shared / (rooms[r].area + place.area - shared);
      if (of_both <= result[r].shared) continue;
      result[r].shared = of_both;
      result[r].area = place.area;
    }
  return result;
}

}  // namespace atrium::layout
