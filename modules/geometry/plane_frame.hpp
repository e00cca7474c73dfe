#pragma once
#include <Eigen/Core>

#include "modules/types/plane_primitives.hpp"

namespace atrium {

/// Two-dimensional coordinates in a plane: place = origin + u·x + v·y, with u × v = normal, all of unit length.
struct PlaneFrame {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d u = Eigen::Vector3d::UnitX();
  Eigen::Vector3d v = Eigen::Vector3d::UnitY();

  /// Of the orthogonal projection of x onto the plane.
  Eigen::Vector2d to_plane(const Eigen::Vector3d& x) const {
    const Eigen::Vector3d d = x - origin;
    return {u.dot(d), v.dot(d)};
  }
  Eigen::Vector3d to_space(const Eigen::Vector2d& p) const { return origin + u * p.x() + v * p.y(); }
};

/// The frame whose origin is the projection of `near` onto the plane. v is as steep as the plane allows, so u is
/// horizontal: in a vertical plane v is +z. In a horizontal plane u is +x.
PlaneFrame upright_frame(const Plane& plane, const Eigen::Vector3d& near);

}  // namespace atrium
