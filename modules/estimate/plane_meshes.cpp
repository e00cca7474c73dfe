#include "modules/estimate/plane_meshes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "modules/geometry/plane_frame.hpp"
#include "modules/geometry/polygon.hpp"
#include "modules/geometry/quantile.hpp"

namespace atrium::estimate {
namespace {

Eigen::Vector3d mean_of(const PlanePrimitive& primitive, const Cloud& cloud) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto i : primitive.inliers) sum += cloud.points[i].cast<double>();
  return sum / static_cast<double>(primitive.inliers.size());
}

/// The plane through `mean` with the coordinate axis that is nearest to its normal, if that is near enough.
bool snap_to_axis(Plane& plane, const Eigen::Vector3d& mean, double tolerance) {
  Eigen::Index axis = 0;
  const double along = plane.normal.cwiseAbs().maxCoeff(&axis);
  if (along < std::cos(tolerance * std::numbers::pi / 180.0)) return false;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  normal[axis] = plane.normal[axis] < 0 ? -1 : 1;
  plane = {normal, -normal.dot(mean)};
  return true;
}

Rectangle2 bounding_rectangle(const std::vector<Eigen::Vector2d>& points, const Eigen::Vector2d& axis, double trim) {
  Rectangle2 result;
  result.axis = axis;
  std::vector<double> values(points.size());
  const std::array<Eigen::Vector2d, 2> directions{axis, result.perpendicular()};
  for (int k = 0; k < 2; ++k) {
    for (std::size_t i = 0; i < points.size(); ++i) values[i] = directions[static_cast<std::size_t>(k)].dot(points[i]);
    std::tie(result.low[k], result.high[k]) = trimmed_range(values, trim);
  }
  return result;
}

Eigen::Vector2d least_area_axis(const std::vector<Eigen::Vector2d>& points) {
  const Polygon2 hull = convex_hull(points);
  return hull.size() < 3 ? Eigen::Vector2d(Eigen::Vector2d::UnitX()) : minimum_area_rectangle(hull).axis;
}

PlaneMesh make_mesh(const PlanePrimitive& primitive, SurfaceClass surface, const Cloud& cloud,
                    const PlaneMeshes::Params& params) {
  PlaneMesh mesh;
  mesh.surface = surface;
  mesh.plane = primitive.plane;
  if (primitive.inliers.size() < 3) return mesh;
  const Eigen::Vector3d mean = mean_of(primitive, cloud);
  const bool aligned = snap_to_axis(mesh.plane, mean, params.axis_tolerance);
  const PlaneFrame frame = upright_frame(mesh.plane, mean);
  std::vector<Eigen::Vector2d> points;
  points.reserve(primitive.inliers.size());
  for (const auto i : primitive.inliers) points.push_back(frame.to_plane(cloud.points[i].cast<double>()));
  const bool upright = aligned || surface == SurfaceClass::wall;
  const Eigen::Vector2d axis = upright ? Eigen::Vector2d(Eigen::Vector2d::UnitX()) : least_area_axis(points);
  const Rectangle2 rectangle = bounding_rectangle(points, axis, params.trim);
  constexpr double least_side = 1e-3;  // metres
  if ((rectangle.high - rectangle.low).minCoeff() < least_side) return mesh;
  for (const auto& corner : rectangle.corners()) mesh.corners.push_back(frame.to_space(corner));
  return mesh;
}

}  // namespace

PlaneMeshes::Out PlaneMeshes::run(const In& in, const Params& params, Context& context) {
  const PlanePrimitives& planes = *in.structure->primitives;
  std::vector<PlaneMesh> meshes(planes.primitives.size());
  context.parallel_for(
      meshes.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          const SurfaceClass surface = in.structure->classes[i];
          if (surface == SurfaceClass::object) continue;
          meshes[i] = make_mesh(planes.primitives[i], surface, *planes.cloud, params);
          meshes[i].primitive = static_cast<std::int32_t>(i);
          meshes[i].storey = in.structure->storeys[i];
        }
      },
      1);
  Out out;
  out.meshes.origin = planes.cloud->origin;
  for (auto& mesh : meshes) {
    if (mesh.primitive < 0) continue;
    if (mesh.corners.empty())
      context.warn(
          fmt::format("primitive {} ({}) spans no area: it has no mesh", mesh.primitive, name_of(mesh.surface)));
    else
      out.meshes.meshes.push_back(std::move(mesh));
  }
  return out;
}

}  // namespace atrium::estimate
