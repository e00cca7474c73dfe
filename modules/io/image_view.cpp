#include "modules/io/image_view.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "modules/geometry/quantile.hpp"
#include "modules/io/decode_columns.hpp"

namespace atrium::io {
namespace {

/// The direction of a point from the eye, of length 1; zero if it has none.
Eigen::Vector3d direction_to(const RawGeometry& geometry, std::size_t point, const Eigen::Vector3d& eye) {
  Eigen::Vector3d p;
  constexpr Role axes[3] = {Role::x, Role::y, Role::z};
  for (int a = 0; a < 3; ++a) read_numbers(geometry.column(axes[a]), point, 1, &p[a]);
  const double distance = (p - eye).norm();
  if (!std::isfinite(distance) || distance == 0 || p.isZero(0)) return Eigen::Vector3d::Zero();
  return (p - eye) / distance;
}

double angle_of(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

}  // namespace

bool is_image_from(const RawGeometry& geometry, const Eigen::Vector3d& eye) {
  constexpr std::size_t wanted = 20000, least = 50;
  constexpr double same = 2, share = 0.95, half_width = 6 * std::numbers::pi / 180;
  std::vector<double> steps;
  std::vector<Eigen::Vector3d> directions;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const std::size_t stride = std::max<std::size_t>(1, geometry.count / wanted);
  for (std::size_t i = 0; i + 1 < geometry.count; i += stride) {
    if ((i + 1) % geometry.image_width == 0) continue;  // the last of its row
    const Eigen::Vector3d here = direction_to(geometry, i, eye), next = direction_to(geometry, i + 1, eye);
    if (here.isZero(0) || next.isZero(0)) continue;
    steps.push_back(angle_of(here, next));
    directions.push_back(here);
    sum += here;
  }
  if (steps.size() < least) return true;
  const double usual = median(steps);
  const auto alike = std::count_if(steps.begin(), steps.end(),
                                   [&](double step) { return step >= usual / same && step <= usual * same; });
  const auto wide = std::count_if(directions.begin(), directions.end(),
                                  [&](const Eigen::Vector3d& d) { return angle_of(d, sum) > half_width; });
  constexpr double some = 0.1;
  return static_cast<double>(alike) >= share * static_cast<double>(steps.size()) &&
         static_cast<double>(wide) >= some * static_cast<double>(directions.size());
}

}  // namespace atrium::io
