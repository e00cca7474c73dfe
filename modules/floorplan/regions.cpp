#include "modules/floorplan/regions.hpp"

#include <algorithm>
#include <cmath>
#include <polyclipping/clipper.hpp>

namespace atrium::floorplan {
namespace {

namespace cl = ClipperLib;
constexpr double units = 1e7;      // per metre
constexpr double straight = 2e-4;  // metres: corners less than this off the line of their neighbours are none
constexpr double no_width = 2e-6;  // metres: what is narrower holds nothing together

cl::Path to_path(const PlanRing& ring) {
  cl::Path path;
  path.reserve(ring.size());
  for (const auto& p : ring) path.emplace_back(std::llround(p.x() * units), std::llround(p.y() * units));
  return path;
}

cl::Paths to_paths(const Region& region) {
  cl::Paths paths;
  for (const auto& polygon : region) {
    paths.push_back(to_path(polygon.outline));
    for (const auto& hole : polygon.holes) paths.push_back(to_path(hole));
  }
  return paths;
}

bool before(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
}

PlanRing to_ring(cl::Path path, bool counter_clockwise) {
  cl::CleanPolygon(path, straight * units);
  if (cl::Orientation(path) != counter_clockwise) cl::ReversePath(path);
  PlanRing ring;
  ring.reserve(path.size());
  for (const auto& p : path) ring.emplace_back(static_cast<double>(p.X) / units, static_cast<double>(p.Y) / units);
  std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end(), before), ring.end());
  return ring;
}

Region to_region(const cl::PolyTree& tree) {
  Region region;
  for (const cl::PolyNode* node = tree.GetFirst(); node != nullptr; node = node->GetNext()) {
    if (node->IsHole()) continue;
    PlanPolygon polygon{to_ring(node->Contour, true), {}};
    if (polygon.outline.size() < 3) continue;
    for (const cl::PolyNode* child : node->Childs)
      if (PlanRing hole = to_ring(child->Contour, false); hole.size() >= 3) polygon.holes.push_back(std::move(hole));
    std::sort(polygon.holes.begin(), polygon.holes.end(),
              [](const PlanRing& a, const PlanRing& b) { return before(a.front(), b.front()); });
    region.push_back(std::move(polygon));
  }
  std::stable_sort(region.begin(), region.end(), [](const PlanPolygon& a, const PlanPolygon& b) {
    const double left = a.area(), right = b.area();
    return left != right ? left > right : before(a.outline.front(), b.outline.front());
  });
  return region;
}

Region combined(const cl::Paths& subject, const cl::Paths& clip, cl::ClipType operation) {
  cl::Clipper clipper;
  clipper.AddPaths(subject, cl::ptSubject, true);
  clipper.AddPaths(clip, cl::ptClip, true);
  cl::PolyTree tree;
  clipper.Execute(operation, tree, cl::pftNonZero, cl::pftNonZero);
  return to_region(tree);
}

}  // namespace

Region united(const std::vector<PlanRing>& rings) {
  cl::Paths paths;
  for (const auto& ring : rings) {
    paths.push_back(to_path(ring));
    if (!cl::Orientation(paths.back())) cl::ReversePath(paths.back());
  }
  return combined(paths, {}, cl::ctUnion);
}

Region joined(const Region& a, const Region& b) { return combined(to_paths(a), to_paths(b), cl::ctUnion); }
Region minus(const Region& a, const Region& b) { return combined(to_paths(a), to_paths(b), cl::ctDifference); }
Region common(const Region& a, const Region& b) { return combined(to_paths(a), to_paths(b), cl::ctIntersection); }

Region grown(const Region& region, double distance) {
  cl::ClipperOffset offset(4.0);
  offset.AddPaths(to_paths(region), cl::jtMiter, cl::etClosedPolygon);
  cl::PolyTree tree;
  offset.Execute(tree, distance * units);
  return to_region(tree);
}

Region closed(const Region& region, double gap) { return grown(grown(region, 0.5 * gap), -0.5 * gap); }

Region parted(const Region& region) {
  Region result;
  for (const auto& polygon : region) {
    const Region cores = grown({polygon}, -0.5 * no_width);
    const Region parts = grown(cores, 0.5 * no_width);
    if (parts.size() == 1 && parts.front().holes.size() == polygon.holes.size())
      result.push_back(polygon);
    else
      result.insert(result.end(), parts.begin(), parts.end());
  }
  return result;
}

double area(const Region& region) {
  double sum = 0;
  for (const auto& polygon : region) sum += polygon.area();
  return sum;
}

PlanRing strip(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double half_width, double beyond) {
  const double length = (b - a).norm();
  if (length <= 0) return {};
  const Eigen::Vector2d along = (b - a) / length;
  const Eigen::Vector2d aside = half_width * Eigen::Vector2d(-along.y(), along.x());
  const Eigen::Vector2d from = a - beyond * along, to = b + beyond * along;
  return {from - aside, to - aside, to + aside, from + aside};
}

}  // namespace atrium::floorplan
