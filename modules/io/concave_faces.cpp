#include "modules/io/concave_faces.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "modules/geometry/ear_clipping.hpp"
#include "modules/geometry/polygon.hpp"

namespace atrium::io {
namespace {

/// The face's corners in its plane, counter-clockwise; empty if it has no area.
PlanRing in_its_plane(const std::vector<Eigen::Vector3d>& vertices, const std::vector<std::uint32_t>& corners) {
  std::vector<Eigen::Vector3d> places;
  places.reserve(corners.size());
  for (const auto c : corners) places.push_back(vertices[c]);
  const Eigen::Vector3d area = vector_area(places);
  if (!(area.norm() > 0) || !area.allFinite()) return {};
  const Eigen::Vector3d normal = area.normalized();
  const Eigen::Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
  PlanRing ring;
  for (const auto& p : places) ring.emplace_back(u.dot(p - places[0]), v.dot(p - places[0]));
  return ring;
}

}  // namespace

void cut_concave_faces(const std::vector<Eigen::Vector3d>& vertices, const std::vector<FaceFan>& fans,
                       std::vector<std::array<std::uint32_t, 3>>& triangles) {
  std::vector<std::uint32_t> corners;
  for (const FaceFan& fan : fans) {
    corners.assign({triangles[fan.first][0], triangles[fan.first][1]});
    for (std::size_t k = 0; k + 2 < fan.corners; ++k) corners.push_back(triangles[fan.first + k][2]);
    const PlanRing ring = in_its_plane(vertices, corners);
    if (ring.empty()) continue;
    double size = 0;
    for (const auto& p : ring) size = std::max(size, p.norm());
    constexpr double rounding = 1e-6;  // of its size: what faces of float32 are off
    if (is_convex(ring, rounding * size)) continue;
    const auto cut = clip_ears({ring, {}});
    if (cut.size() != fan.corners - 2) continue;
    for (std::size_t k = 0; k < cut.size(); ++k)
      triangles[fan.first + k] = {corners[cut[k][0]], corners[cut[k][1]], corners[cut[k][2]]};
  }
}

}  // namespace atrium::io
