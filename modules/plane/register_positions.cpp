#include "modules/plane/register_positions.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "modules/plane/measured_plane.hpp"
#include "modules/plane/region_growing.hpp"

namespace atrium::plane {
namespace {

/// A plane that one position saw.
struct Patch {
  std::size_t position = 0;
  MeasuredPlane measured;
};

/// Two patches of one surface: n · (shift of b − shift of a) should be −offset.
struct Pair {
  std::size_t a, b;  ///< positions
  Eigen::Vector3d normal;
  double offset;
  double area;
};

/// Evenly chosen points of each position.
std::vector<std::vector<std::uint32_t>> points_of_positions(const Cloud& cloud, std::size_t most) {
  const std::size_t positions = cloud.sensors.size();
  std::vector<std::size_t> all(positions, 0);
  for (const auto position : cloud.source)
    if (position < positions) ++all[position];
  // Of n points those with the numbers 0, n / most, 2 n / most …
  std::vector<std::vector<std::uint32_t>> chosen(positions);
  std::vector<std::size_t> met(positions, 0), next(positions, 0);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const std::size_t k = cloud.source[i];
    if (k >= positions || met[k]++ != next[k]) continue;
    chosen[k].push_back(static_cast<std::uint32_t>(i));
    next[k] = all[k] <= most ? met[k] : chosen[k].size() * all[k] / most;
  }
  return chosen;
}

std::vector<Patch> patches_of(const Cloud& cloud, const RegisterPositions::Params& params, Context& context) {
  constexpr std::size_t few = 100;
  const auto chosen = points_of_positions(cloud, static_cast<std::size_t>(params.max_points));
  std::vector<std::vector<Patch>> found(chosen.size());
  context.parallel_chunks(chosen.size(), 1, [&](std::size_t position, std::size_t, std::size_t) {
    if (chosen[position].size() < few) return;
    const auto own = std::make_shared<Cloud>(select(cloud, chosen[position]));
    const auto grown = RegionGrowing::run({own}, {}, context);
    for (auto& measured : measure_planes(grown.planes, context))
      if (measured.moments.count > 0) found[position].push_back({position, std::move(measured)});
  });
  std::vector<Patch> patches;
  for (auto& part : found) std::move(part.begin(), part.end(), std::back_inserter(patches));
  return patches;
}

Patch moved(const Patch& patch, const Eigen::Vector3d& shift) {
  Patch result = patch;
  result.measured.plane.offset -= patch.measured.plane.normal.dot(shift);
  for (auto& corner : result.measured.corners) corner += shift;
  return result;
}

Eigen::Vector3d middle_of(const MeasuredPlane& plane) { return (plane.corners[0] + plane.corners[2]) / 2; }

std::vector<Pair> pairs_of(const std::vector<Patch>& patches, const std::vector<Eigen::Vector3d>& shifts,
                           const RegisterPositions::Params& params) {
  const double least_cosine = std::cos(params.max_angle * std::numbers::pi / 180);
  std::vector<Patch> now;
  now.reserve(patches.size());
  for (const auto& patch : patches) now.push_back(moved(patch, shifts[patch.position]));
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < now.size(); ++i)
    for (std::size_t k = i + 1; k < now.size(); ++k) {
      const MeasuredPlane &a = now[i].measured, &b = now[k].measured;
      if (now[i].position == now[k].position || a.plane.normal.dot(b.plane.normal) < least_cosine) continue;
      // The distance in the middle of both, where neither plane's tilt counts for much.
      const Eigen::Vector3d middle = (middle_of(a) + middle_of(b)) / 2;
      const double offset = a.plane.signed_distance(middle) - b.plane.signed_distance(middle);
      if (std::abs(offset) > params.max_offset) continue;
      const double shared = std::min(a.shared_area(b), b.shared_area(a));
      if (shared <= 0 || shared < params.min_overlap * std::min(a.area(), b.area())) continue;
      pairs.push_back(
          {now[i].position, now[k].position, (a.plane.normal + b.plane.normal).normalized(), offset, shared});
    }
  return pairs;
}

/// Weighted least squares for the shifts; what nothing holds stays.
std::vector<Eigen::Vector3d> solve(const std::vector<Pair>& pairs, std::size_t positions, double scale) {
  constexpr int rounds = 10;
  const auto size = static_cast<Eigen::Index>(3 * positions);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(size);
  for (int round = 0; round < rounds; ++round) {
    Eigen::MatrixXd normal_matrix = Eigen::MatrixXd::Zero(size, size);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(size);
    // From wide to narrow, so that the many agree before the few are left out.
    const double width = scale * std::max(1.0, 4.0 - round);
    for (const auto& pair : pairs) {
      const auto a = static_cast<Eigen::Index>(3 * pair.a);
      const auto b = static_cast<Eigen::Index>(3 * pair.b);
      const double left = pair.normal.dot(x.segment<3>(b) - x.segment<3>(a)) + pair.offset;
      const double u = left / width;
      if (std::abs(u) >= 1) continue;
      const double weight = pair.area * (1 - u * u) * (1 - u * u);
      const Eigen::Matrix3d nn = weight * pair.normal * pair.normal.transpose();
      normal_matrix.block<3, 3>(a, a) += nn;
      normal_matrix.block<3, 3>(b, b) += nn;
      normal_matrix.block<3, 3>(a, b) -= nn;
      normal_matrix.block<3, 3>(b, a) -= nn;
      right.segment<3>(b) -= weight * pair.offset * pair.normal;
      right.segment<3>(a) += weight * pair.offset * pair.normal;
    }
    normal_matrix.block<3, 3>(0, 0) += 1e3 * Eigen::Matrix3d::Identity();
    // The solution of least norm: directions that nothing holds get no shift.
    Eigen::JacobiSVD<Eigen::MatrixXd> svd(normal_matrix, Eigen::ComputeThinU | Eigen::ComputeThinV);
    svd.setThreshold(1e-6);
    x = svd.solve(right);
  }
  std::vector<Eigen::Vector3d> shifts(positions);
  for (std::size_t i = 0; i < positions; ++i) shifts[i] = x.segment<3>(static_cast<Eigen::Index>(3 * i));
  return shifts;
}

/// The distance that half of the shared area is below.
double median_offset(const std::vector<Pair>& pairs) {
  std::vector<std::pair<double, double>> offsets;
  double area = 0;
  for (const auto& pair : pairs) {
    offsets.emplace_back(std::abs(pair.offset), pair.area);
    area += pair.area;
  }
  std::sort(offsets.begin(), offsets.end());
  double sum = 0;
  for (const auto& [offset, share] : offsets) {
    sum += share;
    if (sum >= area / 2) return offset;
  }
  return 0;
}

std::shared_ptr<const Cloud> shifted(const Cloud& cloud, const std::vector<Eigen::Vector3d>& shifts) {
  auto result = std::make_shared<Cloud>(cloud);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (cloud.source[i] < shifts.size()) result->points[i] += shifts[cloud.source[i]].cast<float>();
  for (std::size_t k = 0; k < shifts.size(); ++k) result->sensors[k] += shifts[k].cast<float>();
  return result;
}

}  // namespace

RegisterPositions::Out RegisterPositions::run(const In& in, const Params& params, Context& context) {
  const Cloud& cloud = *in.cloud;
  if (cloud.sensors.size() < 2 || cloud.source.size() != cloud.size()) {
    context.info("the cloud has fewer than two positions: nothing to register");
    return {in.cloud};
  }
  const std::vector<Patch> patches = patches_of(cloud, params, context);
  std::vector<MeasuredPlane> measured;
  measured.reserve(patches.size());
  for (const auto& patch : patches) measured.push_back(patch.measured);
  const double noise = mean_residual(measured);
  std::vector<Eigen::Vector3d> shifts(cloud.sensors.size(), Eigen::Vector3d::Zero());
  const double before = median_offset(pairs_of(patches, shifts, params));
  if (before <= noise / 2) {
    context.info(fmt::format("shared planes agree within {:.1f} mm: nothing moved", 1000 * before));
    return {in.cloud};
  }
  constexpr int rounds = 3;
  constexpr double least_scale = 0.02;
  for (int round = 0; round < rounds; ++round) {
    const auto step = solve(pairs_of(patches, shifts, params), shifts.size(), std::max(least_scale, 2 * noise));
    for (std::size_t k = 0; k < shifts.size(); ++k) shifts[k] += step[k];
  }
  double most = 0;
  for (const auto& shift : shifts) most = std::max(most, shift.norm());
  context.info(
      fmt::format("{} positions moved by up to {:.1f} mm; shared planes {:.1f} mm apart before, {:.1f} mm after",
                  shifts.size(), 1000 * most, 1000 * before, 1000 * median_offset(pairs_of(patches, shifts, params))));
  return {shifted(cloud, shifts)};
}

}  // namespace atrium::plane
