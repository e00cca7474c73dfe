#include "modules/metric/fewest_corners.hpp"

#include <algorithm>

namespace atrium::metric {
namespace {

double to_segment(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d along = b - a;
  const double squared = along.squaredNorm();
  const double t = squared > 0 ? std::clamp((p - a).dot(along) / squared, 0.0, 1.0) : 0.0;
  return (p - a - t * along).norm();
}

std::size_t sharpest(const std::vector<Eigen::Vector3d>& ring) {
  std::size_t best = 0;
  double least = 2;  // cosine of the turn
  for (std::size_t i = 0, n = ring.size(); i < n; ++i) {
    const Eigen::Vector3d before = ring[i] - ring[(i + n - 1) % n], after = ring[(i + 1) % n] - ring[i];
    const double cosine = before.dot(after) / std::max(1e-300, before.norm() * after.norm());
    if (cosine < least - 1e-9) {
      least = cosine;
      best = i;
    }
  }
  return best;
}

}  // namespace

std::size_t fewest_corners(const std::vector<Eigen::Vector3d>& ring, double tolerance) {
  const std::size_t n = ring.size(), first = ring.empty() ? 0 : sharpest(ring);
  const auto at = [&](std::size_t i) -> const Eigen::Vector3d& { return ring[(first + i) % n]; };
  const auto fits = [&](std::size_t from, std::size_t to) {
    for (std::size_t k = from + 1; k < to; ++k)
      if (to_segment(at(k), at(from), at(to)) > tolerance) return false;
    return true;
  };
  std::size_t corners = 0;
  for (std::size_t from = 0; from < n; ++corners) {
    std::size_t to = from + 1;
    while (to < n && fits(from, to + 1)) ++to;
    from = to;
  }
  return std::max<std::size_t>(3, corners);
}

}  // namespace atrium::metric
