#include "modules/geometry/plan_overlay.hpp"

#include <boost/geometry.hpp>

#include "modules/geometry/plan_boost.hpp"

namespace atrium::overlay {
namespace {

PlanPolygon from_boost(const Polygon& source) {
  PlanPolygon result;
  for (const auto& p : source.outer()) result.outline.emplace_back(p.x(), p.y());
  for (const auto& hole : source.inners()) {
    auto& ring = result.holes.emplace_back();
    for (const auto& p : hole) ring.emplace_back(p.x(), p.y());
  }
  return result;
}
std::vector<PlanPolygon> from_boost(const Polygons& source) {
  std::vector<PlanPolygon> result;
  result.reserve(source.size());
  for (const auto& polygon : source) result.push_back(from_boost(polygon));
  return result;
}

}  // namespace

PlanPolygon corrected(const PlanPolygon& polygon) {
  Polygon result = to_boost(polygon);
  bg::correct(result);
  return from_boost(result);
}

double area(const PlanPolygon& polygon) { return bg::area(to_boost(polygon)); }
double area(const std::vector<PlanPolygon>& polygons) { return bg::area(to_boost(polygons)); }

Eigen::Vector2d centroid(const std::vector<PlanPolygon>& polygons) {
  const auto place = bg::return_centroid<Point>(to_boost(polygons));
  return {place.x(), place.y()};
}

std::vector<PlanPolygon> intersection(const std::vector<PlanPolygon>& polygons, const PlanPolygon& other) {
  Polygons result;
  bg::intersection(to_boost(polygons), to_boost(other), result);
  return from_boost(result);
}

std::vector<PlanPolygon> difference(const std::vector<PlanPolygon>& polygons, const PlanPolygon& other) {
  Polygons result;
  bg::difference(to_boost(polygons), to_boost(other), result);
  return from_boost(result);
}

}  // namespace atrium::overlay
