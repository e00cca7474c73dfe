#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string_view>
#include <tuple>
#include <vector>

#include "modules/types/cloud.hpp"

namespace atrium {

/// A plane in the frame of its cloud's float coordinates (without the cloud's origin): normal · x + offset = 0.
struct Plane {
  static constexpr auto members() { return std::tuple{&Plane::normal, &Plane::offset}; }
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit length
  double offset = 0;
  double signed_distance(const Eigen::Vector3d& x) const { return normal.dot(x) + offset; }
};

/// One vertex group P_i of the paper: a plane and the points that support it.
struct PlanePrimitive {
  static constexpr auto members() {
    return std::tuple{&PlanePrimitive::plane, &PlanePrimitive::inliers, &PlanePrimitive::residual};
  }
  Plane plane;  ///< its normal points to the side from which the surface was seen (the mean of the inliers' normals)
  std::vector<std::uint32_t> inliers;  ///< indices into the cloud, ascending, each point in one primitive at most
  double residual = 0;                 ///< RMS distance of the inliers to the plane, metres
};

/// The paper's P = {P_i}: planar primitives over a cloud, by falling number of inliers.
struct PlanePrimitives {
  static constexpr std::string_view port_type = "PlanePrimitives";
  static constexpr auto members() { return std::tuple{&PlanePrimitives::cloud, &PlanePrimitives::primitives}; }
  std::shared_ptr<const Cloud> cloud = std::make_shared<const Cloud>();
  std::vector<PlanePrimitive> primitives;
};

/// A rigid motion between frames, from the input frame to the aligned one: target = rotation * source + translation. It
/// acts on true positions: a value's origin moves, its local coordinates only turn.
struct Transform {
  static constexpr std::string_view port_type = "Transform";
  static constexpr auto members() {
    return std::tuple{&Transform::rotation, &Transform::translation, &Transform::upright};
  }
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  ///< metres
  double upright = 1;  ///< probability that the target frame's z points up, where that was found out
};

/// The cloud in the transform's target frame: origin, points, normals and sensors.
Cloud transformed(const Cloud& cloud, const Transform& transform);
/// Primitives and their cloud in the transform's target frame.
PlanePrimitives transformed(const PlanePrimitives& primitives, const Transform& transform);
/// First `first`, then `second`.
Transform chained(const Transform& first, const Transform& second);
Transform inverse(const Transform& transform);

}  // namespace atrium
