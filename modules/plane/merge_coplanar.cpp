#include "modules/plane/merge_coplanar.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include "graph/api/text.hpp"
#include "modules/plane/measured_plane.hpp"

namespace atrium::plane {
namespace {

struct Group {
  Plane plane;
  Moments moments;  ///< of the points that the plane is fitted to
  double residual = 0;
  std::vector<std::size_t> members;
};

Plane fitted(const Moments& moments, const Eigen::Vector3d& side) {
  Plane plane = fit_plane(moments).plane;
  if (plane.normal.dot(side) < 0) plane = {-plane.normal, -plane.offset};
  return plane;
}

class Merging {
 public:
  Merging(const std::vector<MeasuredPlane>& planes, double distance, double sheet_distance, double layer_distance,
          double angle)
      : planes_(planes),
        distance_(distance),
        sheet_distance_(std::max(distance, sheet_distance)),
        layer_distance_(std::max(sheet_distance_, layer_distance)),
        least_cosine_(std::cos(angle * radians_per_degree)) {}

  std::vector<Group> run(const Context& context) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < planes_.size(); ++i)
      if (planes_[i].moments.count > 0) order.push_back(i);
    std::stable_sort(order.begin(), order.end(),
                     [&](auto a, auto b) { return planes_[a].moments.count > planes_[b].moments.count; });
    std::vector<Group> groups;
    groups.reserve(order.size());
    for (const auto i : order)
      groups.push_back({planes_[i].plane, planes_[i].moments, planes_[i].rms_to(planes_[i].plane), {i}});
    for (std::size_t before = groups.size() + 1; groups.size() < before;) {
      context.check_cancelled();
      before = groups.size();
      groups = pass(groups);
    }
    return groups;
  }

 private:
  std::vector<Group> pass(const std::vector<Group>& groups) const {
    std::vector<Group> result;
    for (const auto& group : groups) {
      std::size_t best = result.size();
      double least = 1;
      for (std::size_t k = 0; k < result.size(); ++k) {
        const double misfit = joint_misfit(result[k], group, least);
        if (misfit < least) {
          least = misfit;
          best = k;
        }
      }
      if (best == result.size())
        result.push_back(group);
      else
        join(result[best], group);
    }
    return result;
  }

  /// How far the joint plane is from the members of both, as a share of what is allowed; at least `limit`, which is 1
  /// or less, if that is more.
  double joint_misfit(const Group& a, const Group& b, double limit) const {
    if (a.plane.normal.dot(b.plane.normal) < least_cosine_) return limit;
    const double offset = a.plane.signed_distance(b.moments.mean());
    if (std::abs(offset) > layer_distance_) return limit;
    const double allowed = std::abs(offset) <= distance_ / 2 || !sheets(a, b) ? distance_
                           : layers(a, b)                                     ? layer_distance_
                                                                              : sheet_distance_;
    const Plane plane = joint_plane(a, b).second;
    double misfit = 0;
    for (const auto* group : {&a, &b})
      for (const auto i : group->members) {
        misfit = std::max(misfit, planes_[i].reach_to(plane) / allowed);
        if (misfit >= limit) return limit;
      }
    return misfit;
  }

  /// Whether the smaller lies before or behind the larger for the most part: both cannot have been seen.
  bool sheets(const Group& a, const Group& b) const {
    constexpr double most = 0.5;
    double area = 0;
    double shared = 0;
    for (const auto i : b.members) {
      double best = 0;
      for (const auto k : a.members) best = std::max(best, planes_[i].shared_area(planes_[k]));
      shared += best;
      area += planes_[i].area();
    }
    return shared > most * area;
  }

  /// Whether points of the smaller stand over points of the larger: the one before hides nothing of the other.
  bool layers(const Group& a, const Group& b) const {
    constexpr double many = 0.5;
    double area = 0, over = 0;
    for (const auto i : b.members) {
      double best = 0;
      for (const auto k : a.members) best = std::max(best, planes_[i].share_over(planes_[k]));
      over += best * planes_[i].area();
      area += planes_[i].area();
    }
    return over > many * area;
  }

  static std::pair<Moments, Plane> joint_plane(const Group& a, const Group& b) {
    const double offset = std::abs(a.plane.signed_distance(b.moments.mean()));
    if (offset > 2 * a.residual && a.moments.count >= 2 * b.moments.count) return {a.moments, a.plane};
    Moments both = a.moments;
    both += b.moments;
    return {both, fitted(both, a.plane.normal)};
  }

  static void join(Group& a, const Group& b) {
    std::tie(a.moments, a.plane) = joint_plane(a, b);
    a.members.insert(a.members.end(), b.members.begin(), b.members.end());
  }

  const std::vector<MeasuredPlane>& planes_;
  double distance_, sheet_distance_, layer_distance_, least_cosine_;
};

PlanePrimitive joined(const PlanePrimitives& planes, const std::vector<MeasuredPlane>& measured, const Group& group) {
  PlanePrimitive result;
  result.plane = group.plane;
  double squares = 0;
  for (const auto i : group.members) {
    const auto& inliers = planes.primitives[i].inliers;
    result.inliers.insert(result.inliers.end(), inliers.begin(), inliers.end());
    const double rms = measured[i].rms_to(group.plane);
    squares += rms * rms * static_cast<double>(inliers.size());
  }
  std::sort(result.inliers.begin(), result.inliers.end());
  result.residual = std::sqrt(squares / static_cast<double>(result.inliers.size()));
  return result;
}

}  // namespace

MergeCoplanar::Out MergeCoplanar::run(const In& in, const Params& params, Context& context) {
  constexpr double least_distance = 0.005;
  const std::vector<MeasuredPlane> measured = measure_planes(*in.planes, context);
  const double distance = params.distance > 0 ? params.distance : std::max(least_distance, 3 * mean_residual(measured));
  const std::vector<Group> groups =
      Merging(measured, distance, params.sheet_distance, params.layer_distance, params.angle).run(context);
  Out out;
  out.planes.cloud = in.planes->cloud;
  out.planes.primitives.resize(groups.size());
  context.parallel_for(
      groups.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) out.planes.primitives[i] = joined(*in.planes, measured, groups[i]);
      },
      1);
  std::stable_sort(out.planes.primitives.begin(), out.planes.primitives.end(),
                   [](const auto& a, const auto& b) { return a.inliers.size() > b.inliers.size(); });
  context.info(fmt::format("{} of {}, within {:.1f} mm", counted(groups.size(), "plane"),
                           counted(in.planes->primitives.size(), "primitive"), 1000 * distance));
  return out;
}

}  // namespace atrium::plane
