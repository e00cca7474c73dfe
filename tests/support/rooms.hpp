#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <memory>
#include <vector>

#include "graph/api/random.hpp"
#include "modules/types/plane_primitives.hpp"

namespace atrium::test {

/// Builds plane primitives of rooms from exact rectangles: what a perfect plane detection would give.
class Rooms {
 public:
  double spacing = 0.05;  ///< between points, metres
  double noise = 0;       ///< standard deviation along the normal, metres
  bool normals = true;

  /// A rectangle from `corner` along two edges; the surface is seen from the side of `normal`. `keep`: which of its
  /// points there are.
  Rooms& add(const Eigen::Vector3d& corner, const Eigen::Vector3d& a, const Eigen::Vector3d& b, Eigen::Vector3d normal,
             const std::function<bool(const Eigen::Vector3d&)>& keep = {}) {
    normal.normalize();
    const auto first = static_cast<std::uint32_t>(cloud_.points.size());
    const int na = std::max(1, static_cast<int>(std::lround(a.norm() / spacing)));
    const int nb = std::max(1, static_cast<int>(std::lround(b.norm() / spacing)));
    for (int i = 0; i <= na; ++i) {
      for (int j = 0; j <= nb; ++j) {
        const Eigen::Vector3d p = corner + a * (static_cast<double>(i) / na) + b * (static_cast<double>(j) / nb);
        if (!keep || keep(p)) add_point(p + normal * (noise * random_.normal()), normal);
      }
    }
    PlanePrimitive primitive;
    primitive.plane = {normal, -normal.dot(corner)};
    for (auto i = first; i < cloud_.points.size(); ++i) primitive.inliers.push_back(i);
    primitive.residual = noise;
    primitives_.push_back(std::move(primitive));
    return *this;
  }
  /// A vertical wall from (x0, y0) to (x1, y1); seen from its left side.
  Rooms& wall(double x0, double y0, double x1, double y1, double bottom = 0, double top = 2.5) {
    const Eigen::Vector3d along(x1 - x0, y1 - y0, 0);
    return add({x0, y0, bottom}, along, {0, 0, top - bottom}, {-along.y(), along.x(), 0});
  }
  /// Floor (seen from above) or ceiling (seen from below) over an axis-aligned rectangle.
  Rooms& floor(double x0, double y0, double x1, double y1, double z = 0,
               const std::function<bool(const Eigen::Vector3d&)>& keep = {}) {
    return add({x0, y0, z}, {x1 - x0, 0, 0}, {0, y1 - y0, 0}, {0, 0, 1}, keep);
  }
  Rooms& ceiling(double x0, double y0, double x1, double y1, double z = 2.5,
                 const std::function<bool(const Eigen::Vector3d&)>& keep = {}) {
    return add({x0, y0, z}, {x1 - x0, 0, 0}, {0, y1 - y0, 0}, {0, 0, -1}, keep);
  }
  /// Walls along a counter-clockwise outline, each shortened by `gap` at both ends; seen from inside.
  Rooms& walls(const std::vector<Eigen::Vector2d>& outline, double gap = 0, double bottom = 0, double top = 2.5) {
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Eigen::Vector2d& a = outline[i];
      const Eigen::Vector2d& b = outline[(i + 1) % outline.size()];
      const Eigen::Vector2d d = (b - a).normalized() * gap;
      wall(a.x() + d.x(), a.y() + d.y(), b.x() - d.x(), b.y() - d.y(), bottom, top);
    }
    return *this;
  }
  /// A point of no primitive.
  Rooms& stray(const Eigen::Vector3d& p) {
    add_point(p, Eigen::Vector3d::UnitZ());
    return *this;
  }

  /// The primitives by falling number of points, as detection gives them.
  PlanePrimitives planes() const {
    PlanePrimitives result = unsorted();
    std::stable_sort(result.primitives.begin(), result.primitives.end(),
                     [](const auto& l, const auto& r) { return l.inliers.size() > r.inliers.size(); });
    return result;
  }
  /// The primitives in the order in which they were added.
  PlanePrimitives unsorted() const {
    PlanePrimitives result;
    result.cloud = std::make_shared<const Cloud>(cloud_);
    result.primitives = primitives_;
    return result;
  }
  Rooms& origin(const Eigen::Vector3d& origin) {
    cloud_.origin = origin;
    return *this;
  }

 private:
  void add_point(const Eigen::Vector3d& p, const Eigen::Vector3d& normal) {
    cloud_.points.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()));
    if (normals) cloud_.normals.push_back(normal.cast<float>());
  }

  Cloud cloud_;
  std::vector<PlanePrimitive> primitives_;
  Random random_{1};
};

/// An L: 6 × 5 m without the corner x > 3, y > 2; counter-clockwise.
inline std::vector<Eigen::Vector2d> l_outline() { return {{0, 0}, {6, 0}, {6, 2}, {3, 2}, {3, 5}, {0, 5}}; }
inline bool in_l(const Eigen::Vector3d& p) { return p.x() <= 3 + 1e-6 || p.y() <= 2 + 1e-6; }

/// An L-shaped room of floor, ceiling and six walls, which end `gap` before each corner.
inline Rooms l_room(double gap = 0.2) {
  Rooms rooms;
  rooms.floor(0, 0, 6, 5, 0, in_l).ceiling(0, 0, 6, 5, 2.5, in_l).walls(l_outline(), gap);
  return rooms;
}

/// A box room 4 × 3 × 2.5 m.
inline Rooms box_room(double gap = 0) {
  Rooms rooms;
  rooms.floor(0, 0, 4, 3).ceiling(0, 0, 4, 3).walls({{0, 0}, {4, 0}, {4, 3}, {0, 3}}, gap);
  return rooms;
}

}  // namespace atrium::test
