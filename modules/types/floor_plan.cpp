#include "modules/types/floor_plan.hpp"

namespace atrium {
namespace {

double signed_area(const PlanRing& ring) {
  double twice = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d a = ring[i] - ring.front();
    const Eigen::Vector2d b = ring[(i + 1) % ring.size()] - ring.front();
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

}  // namespace

double PlanPolygon::area() const {
  double area = signed_area(outline);
  for (const PlanRing& hole : holes) area += signed_area(hole);
  return area;
}

}  // namespace atrium
