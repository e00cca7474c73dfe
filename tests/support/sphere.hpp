#pragma once
#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "modules/types/cloud.hpp"

namespace atrium::test {

/// Points on a sphere of radius 0.5 m around (1, 2, 3), evenly spaced (Fibonacci), with their normals; red above the
/// middle, blue below; the cap above z = 3.3 unseen if `open`.
inline Cloud sphere(int count, bool open = false) {
  Cloud cloud;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - 2 * (i + 0.5) / count;
    const double angle = i * std::numbers::pi * (3 - std::sqrt(5.0));
    const double r = std::sqrt(1 - z * z);
    const Eigen::Vector3d n(r * std::cos(angle), r * std::sin(angle), z);
    if (open && n.z() > 0.6) continue;
    cloud.points.emplace_back((Eigen::Vector3d(1, 2, 3) + 0.5 * n).cast<float>());
    cloud.normals.emplace_back(n.cast<float>());
    cloud.colours.push_back(n.z() > 0 ? Colour{255, 0, 0} : Colour{0, 0, 255});
  }
  return cloud;
}

}  // namespace atrium::test
