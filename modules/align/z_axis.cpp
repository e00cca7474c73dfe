#include "modules/align/z_axis.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "modules/types/turn_between.hpp"

namespace atrium::align {
namespace {

/// The plane's normal on the side from which its points were seen: that of their mean normal.
Eigen::Vector3d seen_normal(const PlanePrimitive& primitive, const Cloud& cloud) {
  const Eigen::Vector3d& normal = primitive.plane.normal;
  if (!cloud.has_normals()) return normal;
  double agreement = 0;
  for (const auto i : primitive.inliers) agreement += cloud.normals[i].cast<double>().dot(normal);
  return agreement < 0 ? Eigen::Vector3d(-normal) : normal;
}

Eigen::Vector3d given_direction(const std::vector<double>& values) {
  const Eigen::Vector3d direction(values[0], values[1], values[2]);
  const double length = direction.norm();
  if (length > 0 && std::isfinite(length)) return direction / length;
  throw Error(fmt::format("'up' is [{}, {}, {}], which is no direction", values[0], values[1], values[2]),
              "[0, 0, 1] where z points up");
}

/// The list U or D of Algorithm 1: how many planes, and the one with most points.
struct Side {
  std::size_t planes = 0;
  std::size_t points = 0;
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();

  void add(const PlanePrimitive& primitive, const Eigen::Vector3d& seen) {
    ++planes;
    if (primitive.inliers.size() <= points) return;
    points = primitive.inliers.size();
    normal = seen;
  }
};

}  // namespace

ZAxis::Out ZAxis::run(const In& in, const Params& params, Context& context) {
  const Eigen::Vector3d vertical = given_direction(params.up);
  Side up, down;
  for (const auto& primitive : in.planes->primitives) {
    if (primitive.inliers.empty() || std::abs(primitive.plane.normal.dot(vertical)) < params.min_vertical) continue;
    const Eigen::Vector3d normal = seen_normal(primitive, *in.planes->cloud);
    (normal.dot(vertical) > 0 ? up : down).add(primitive, normal);
  }
  if (up.planes + down.planes == 0) {
    throw Error(
        fmt::format("none of the {} planes is roughly horizontal (|c| of its normal at least {})",
                    in.planes->primitives.size(), params.min_vertical),
        "the z axis of the scan must point roughly upwards; set `up` to what does ([0, -1, 0] for a depth camera, "
        "[0, 1, 0] for many phones), or lower min_vertical, or leave the frame as it is with align.none");
  }
  const bool upwards = up.planes > down.planes;
  const Eigen::Vector3d normal = (upwards ? up : down).normal;
  const Eigen::Vector3d target = upwards ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d(-Eigen::Vector3d::UnitZ());
  // First the given direction onto +z, then what is left: both by the least rotation.
  const Eigen::Quaterniond first = turn_between(vertical, Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d roughly = first * normal;
  Transform turn;
  turn.rotation = (turn_between(roughly, target) * first).normalized().toRotationMatrix();
  const double tilt = std::acos(std::min(1.0, roughly.dot(target))) * 180.0 / std::numbers::pi;
  context.info(fmt::format("{} of {} planes decide; tilt {:.2f} deg", upwards ? up.planes : down.planes,
                           in.planes->primitives.size(), tilt));
  return {transformed(*in.planes, turn), chained(in.transform ? *in.transform : Transform{}, turn)};
}

}  // namespace atrium::align
