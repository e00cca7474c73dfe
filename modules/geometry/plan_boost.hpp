#pragma once
#include <boost/geometry/geometries/multi_polygon.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>

#include "modules/geometry/plan_overlay.hpp"

/// Polygons as Boost.Geometry takes them; for plan_overlay.cpp and plan_relations.cpp alone.
namespace atrium::overlay {

namespace bg = boost::geometry;
using Point = bg::model::d2::point_xy<double>;
using Polygon = bg::model::polygon<Point, false, false>;  // counter-clockwise, not closed
using Polygons = bg::model::multi_polygon<Polygon>;

inline Polygon to_boost(const PlanPolygon& source) {
  Polygon result;
  for (const auto& p : source.outline) result.outer().emplace_back(p.x(), p.y());
  for (const auto& hole : source.holes) {
    auto& ring = result.inners().emplace_back();
    for (const auto& p : hole) ring.emplace_back(p.x(), p.y());
  }
  return result;
}
inline Polygons to_boost(const std::vector<PlanPolygon>& source) {
  Polygons result;
  for (const auto& polygon : source) result.push_back(to_boost(polygon));
  return result;
}

}  // namespace atrium::overlay
