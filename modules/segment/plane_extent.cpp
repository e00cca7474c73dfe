#include "modules/segment/plane_extent.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "modules/geometry/plane_frame.hpp"

namespace atrium::segment {
namespace {

/// Level and steepest directions in steep planes; in others along x, which is along walls.
PlaneFrame frame_of(const Plane& plane) {
  constexpr double steep = 0.7;
  PlaneFrame frame = upright_frame(plane, Eigen::Vector3d::Zero());
  if (std::abs(plane.normal.z()) < steep) return frame;
  frame.u = (Eigen::Vector3d::UnitX() - plane.normal * plane.normal.x()).normalized();
  frame.v = plane.normal.cross(frame.u);
  return frame;
}

PlaneExtent measure_one(const PlanePrimitive& primitive, const Cloud& cloud) {
  constexpr double least_thickness = 0.05;
  PlaneExtent extent;
  extent.points = primitive.inliers.size();
  if (primitive.inliers.empty()) return extent;
  const Eigen::Vector3d& n = primitive.plane.normal;
  extent.angle = std::acos(std::min(1.0, std::abs(n.z()))) * 180.0 / std::numbers::pi;
  extent.faces_up = n.z() > 0;
  const PlaneFrame frame = frame_of(primitive.plane);
  Eigen::Matrix3f axes;
  axes << frame.u.cast<float>().transpose(), frame.v.cast<float>().transpose(), n.cast<float>().transpose();
  Eigen::AlignedBox3f box, along;
  double sum = 0;
  for (const auto i : primitive.inliers) {
    const Eigen::Vector3f& p = cloud.points[i];
    box.extend(p);
    along.extend(axes * p);
    sum += p.z();
  }
  extent.height = sum / static_cast<double>(extent.points);
  extent.bottom = box.min().z();
  extent.top = box.max().z();
  const Eigen::Vector3d sides = along.sizes().cast<double>();
  const Eigen::Vector3d low = along.min().cast<double>();
  const Eigen::Vector3d high = along.max().cast<double>();
  const Eigen::Vector3d base = n * (low.z() + high.z()) / 2;
  const auto corner = [&](double u, double v) -> Eigen::Vector3d { return base + frame.u * u + frame.v * v; };
  extent.outline = {corner(low.x(), low.y()), corner(high.x(), low.y()), corner(high.x(), high.y()),
                    corner(low.x(), high.y())};
  extent.volume = sides.x() * sides.y() * std::max(sides.z(), least_thickness);
  return extent;
}

}  // namespace

std::vector<PlaneExtent> measure(const PlanePrimitives& planes, const Context& context) {
  std::vector<PlaneExtent> extents(planes.primitives.size());
  context.parallel_for(
      extents.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          extents[i] = measure_one(planes.primitives[i], *planes.cloud);
          extents[i].primitive = i;
        }
      },
      1);
  return extents;
}

}  // namespace atrium::segment
