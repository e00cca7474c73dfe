#include "modules/plane/regularize.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>

#include "graph/api/text.hpp"
#include "modules/plane/measured_plane.hpp"

namespace atrium::plane {
namespace {

constexpr double quarter = std::numbers::pi / 2;

/// The planes of the scene while they are turned.
class Turning {
 public:
  Turning(std::vector<MeasuredPlane>& planes, double distance, double angle)
      : planes_(planes), distance_(distance), least_cosine_(std::cos(angle * radians_per_degree)) {}

  /// Turns plane i to the normal if that moves none of its places by more than the limit.
  bool turn(std::size_t i, const Eigen::Vector3d& normal) {
    MeasuredPlane& plane = planes_[i];
    if (normal.dot(plane.plane.normal) < least_cosine_) return false;
    const Plane turned{normal, -normal.dot(plane.moments.mean())};
    if (plane.reach_to(turned) > distance_) return false;
    plane.plane = turned;
    return true;
  }

  void upright() {
    for (std::size_t i = 0; i < planes_.size(); ++i) {
      const Eigen::Vector3d n = planes_[i].plane.normal;
      if (planes_[i].moments.count == 0) continue;
      if (std::abs(n.z()) > std::sqrt(0.5))
        turned_ += turn(i, Eigen::Vector3d(0, 0, n.z() > 0 ? 1 : -1)) ? 1 : 0;
      else
        turned_ += turn(i, Eigen::Vector3d(n.x(), n.y(), 0).normalized()) ? 1 : 0;
    }
  }

  /// Families of directions modulo 90°: the plane of the largest area that has none begins one.
  void vertical_families() {
    std::vector<std::size_t> free;
    for (std::size_t i = 0; i < planes_.size(); ++i)
      if (planes_[i].moments.count > 0 && planes_[i].plane.normal.z() == 0) free.push_back(i);
    sort_by_area(free);
    while (!free.empty()) {
      const double first = heading(free.front());
      std::complex<double> sum = 0;
      for (const auto i : free)
        if (fits(i, first)) sum += std::polar(certainty(i), 4 * std::remainder(heading(i) - first, quarter));
      const double mean = first + std::arg(sum) / 4;
      const auto taken = [&](std::size_t i) { return i == free.front() || turn(i, nearest(i, mean)); };
      const std::size_t front = free.front();
      turn(front, nearest(front, mean));
      std::erase_if(free, taken);
      std::erase(free, front);
      ++families_;
    }
  }

  /// Slanted planes of one steepness, on one of the two axes of their family, seen from either side.
  void slanted_families() {
    std::vector<std::size_t> free;
    for (std::size_t i = 0; i < planes_.size(); ++i) {
      const double z = std::abs(planes_[i].plane.normal.z());
      if (planes_[i].moments.count > 0 && z > 0 && z < 1) free.push_back(i);
    }
    sort_by_area(free);
    while (!free.empty()) {
      const std::size_t front = free.front();
      const Slope first = slope(front);
      int members = 0;
      double tilts = 0, tilt_weight = 0, turns = 0, turn_weight = 0;
      for (const auto i : free) {
        if (i != front && !fits(i, like(i, first))) continue;
        ++members;
        const auto [tilt, heading] = slope_certainty(i);
        tilts += tilt * (slope(i).tilt - first.tilt);
        tilt_weight += tilt;
        turns += heading * std::remainder(slope(i).heading - first.heading, quarter);
        turn_weight += heading;
      }
      Slope mean = first;
      if (tilt_weight > 0) mean.tilt += tilts / tilt_weight;
      if (turn_weight > 0) mean.heading += turns / turn_weight;
      if (members > 1) turn(front, like(front, mean));
      std::erase_if(free, [&](std::size_t i) { return i == front || turn(i, like(i, mean)); });
    }
  }

  int turned() const { return turned_; }
  int families() const { return families_; }

 private:
  struct Slope {
    double tilt, heading;  // radians
  };
  Slope slope(std::size_t i) const {
    const Eigen::Vector3d& n = planes_[i].plane.normal;
    return {std::atan2(n.head<2>().norm(), std::abs(n.z())), heading(i)};
  }
  /// The normal of plane i with another slope, on the axis of its family and the side that is nearest.
  Eigen::Vector3d like(std::size_t i, const Slope& slope) const {
    const Eigen::Vector3d flat = nearest(i, slope.heading) * std::sin(slope.tilt);
    return {flat.x(), flat.y(), std::copysign(std::cos(slope.tilt), planes_[i].plane.normal.z())};
  }
  /// What tilt and heading of a slanted plane are known by: its points times their variance down the slope and along
  /// it.
  Slope slope_certainty(std::size_t i) const {
    const Moments& moments = planes_[i].moments;
    const Eigen::Vector3d& n = planes_[i].plane.normal;
    const Eigen::Vector3d level = Eigen::Vector3d::UnitZ().cross(n).normalized();
    const Eigen::Vector3d down = n.cross(level);
    const auto certainty = [&](const Eigen::Vector3d& along) {
      return static_cast<double>(moments.count) * std::max(0.0, along.dot(moments.covariance() * along));
    };
    return {certainty(down), certainty(level) * n.head<2>().squaredNorm()};
  }
  double heading(std::size_t i) const {
    const Eigen::Vector3d& n = planes_[i].plane.normal;
    return std::atan2(n.y(), n.x());
  }
  double area(std::size_t i) const {
    const auto& c = planes_[i].corners;
    return (c[1] - c[0]).norm() * (c[3] - c[0]).norm();
  }
  /// What the heading of a wall is known by: its points times their variance along it.
  double certainty(std::size_t i) const {
    const Moments& moments = planes_[i].moments;
    const Eigen::Vector3d along = Eigen::Vector3d::UnitZ().cross(planes_[i].plane.normal);
    return static_cast<double>(moments.count) * std::max(0.0, along.dot(moments.covariance() * along));
  }
  void sort_by_area(std::vector<std::size_t>& indices) const {
    std::stable_sort(indices.begin(), indices.end(), [&](auto a, auto b) { return area(a) > area(b); });
  }
  Eigen::Vector3d nearest(std::size_t i, double family) const {
    const double angle = family + quarter * std::round((heading(i) - family) / quarter);
    return {std::cos(angle), std::sin(angle), 0};
  }
  bool fits(std::size_t i, double family) const { return fits(i, nearest(i, family)); }
  bool fits(std::size_t i, const Eigen::Vector3d& normal) const {
    const MeasuredPlane& plane = planes_[i];
    if (normal.dot(plane.plane.normal) < least_cosine_) return false;
    return plane.reach_to({normal, -normal.dot(plane.moments.mean())}) <= distance_;
  }

  std::vector<MeasuredPlane>& planes_;
  double distance_, least_cosine_;
  int turned_ = 0, families_ = 0;
};

}  // namespace

Regularize::Out Regularize::run(const In& in, const Params& params, Context& context) {
  constexpr double least_distance = 0.01;
  std::vector<MeasuredPlane> measured = measure_planes(*in.planes, context);
  const double distance = params.distance > 0 ? params.distance : std::max(least_distance, 2 * mean_residual(measured));
  Turning turning(measured, distance, params.angle);
  turning.upright();
  turning.vertical_families();
  turning.slanted_families();
  Out out{*in.planes};
  for (std::size_t i = 0; i < measured.size(); ++i) {
    if (measured[i].moments.count == 0) continue;
    out.planes.primitives[i].plane = measured[i].plane;
    out.planes.primitives[i].residual = measured[i].rms_to(measured[i].plane);
  }
  context.info(fmt::format("{} of {} vertical or horizontal, {} of wall directions, within {:.1f} mm", turning.turned(),
                           counted(measured.size(), "plane"), counted(turning.families(), "family", "families"),
                           1000 * distance));
  return out;
}

}  // namespace atrium::plane
