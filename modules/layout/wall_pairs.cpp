#include "modules/layout/wall_pairs.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "modules/geometry/plan_overlay.hpp"
#include "modules/geometry/plane_frame.hpp"
#include "modules/layout/face_rings.hpp"
#include "modules/types/building_rules.hpp"

namespace atrium::layout {
namespace {

Eigen::AlignedBox2d box_in(const Building& building, const BuildingFace& face, const PlaneFrame& frame) {
  Eigen::AlignedBox2d box;
  for (const auto v : face.outline) box.extend(frame.to_plane(building.vertices[v]));
  return box;
}

PlanPolygon polygon_in(const Building& building, const BuildingFace& face, const PlaneFrame& frame) {
  const auto append = [&](const Ring& corners, PlanRing& ring) {
    for (const auto v : corners) ring.push_back(frame.to_plane(building.vertices[v]));
  };
  PlanPolygon result;
  append(face.outline, result.outline);
  for (const auto& hole : face.holes) append(hole, result.holes.emplace_back());
  return overlay::corrected(result);  // seen from behind it runs the other way
}

/// What two polygons have in common.
struct Shared {
  double area = 0;
  Eigen::Vector2d centroid = Eigen::Vector2d::Zero();
};
Shared shared_of(const PlanPolygon& a, const PlanPolygon& b) {
  const auto both = overlay::intersection({a}, b);
  Shared result{overlay::area(both), {}};
  if (result.area > 0) result.centroid = overlay::centroid(both);
  return result;
}

}  // namespace

bool face_contains(const Building& building, const BuildingFace& face, const Eigen::Vector3d& place, double margin) {
  if (ring_contains(face.outline, building.vertices, face.plane.normal, place)) {
    return std::none_of(face.holes.begin(), face.holes.end(), [&](const auto& hole) {
      return ring_contains(hole, building.vertices, face.plane.normal, place);
    });
  }
  // On the border within the margin: moved a little towards the middle it must be inside.
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const auto v : face.outline) middle += building.vertices[v];
  middle /= static_cast<double>(face.outline.size());
  const PlaneFrame frame = upright_frame(face.plane, middle);
  const Eigen::AlignedBox2d box = box_in(building, face, frame);
  const Eigen::Vector2d p = frame.to_plane(place);
  const Eigen::Vector2d nearest =
      p.cwiseMax(box.min() + Eigen::Vector2d::Constant(1e-4)).cwiseMin(box.max() - Eigen::Vector2d::Constant(1e-4));
  return (nearest - p).norm() <= margin &&
         ring_contains(face.outline, building.vertices, face.plane.normal, frame.to_space(nearest));
}

std::vector<BuildingWall> wall_pairs(const Building& building, double max_thickness) {
  constexpr double least_thickness = 0.02, least_area = 0.1;
  const double opposite = -std::cos(wall_parallel_angle * std::numbers::pi / 180);
  std::vector<BuildingWall> result;
  for (std::size_t a = 0; a < building.faces.size(); ++a) {
    const BuildingFace& front = building.faces[a];
    const PlaneFrame frame = upright_frame(front.plane, building.vertices[front.outline[0]]);
    const Eigen::AlignedBox2d box = box_in(building, front, frame);
    for (std::size_t b = a + 1; b < building.faces.size(); ++b) {
      const BuildingFace& back = building.faces[b];
      if (front.plane.normal.dot(back.plane.normal) > opposite) continue;
      const Eigen::AlignedBox2d boxes = box.intersection(box_in(building, back, frame));
      if (boxes.isEmpty() || boxes.volume() < least_area) continue;
      const Shared shared = shared_of(polygon_in(building, front, frame), polygon_in(building, back, frame));
      if (shared.area < least_area) continue;
      // The back looks away from the front's plane.
      const double thickness = -back.plane.signed_distance(frame.to_space(shared.centroid));
      if (thickness < least_thickness || thickness > max_thickness) continue;
      result.push_back({static_cast<std::int32_t>(a), static_cast<std::int32_t>(b), thickness, shared.area});
    }
  }
  return result;
}

}  // namespace atrium::layout
