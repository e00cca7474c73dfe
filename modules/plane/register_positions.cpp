#include "modules/plane/register_positions.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "graph/api/text.hpp"
#include "modules/geometry/quantile.hpp"
#include "modules/plane/measured_plane.hpp"
#include "modules/plane/position_shifts.hpp"
#include "modules/plane/region_growing.hpp"

namespace atrium::plane {
namespace {

/// A plane that one position saw.
struct SeenPatch {
  std::size_t position = 0;
  MeasuredPlane measured;
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

std::vector<SeenPatch> patches_of(const Cloud& cloud, const RegisterPositions::Params& params, Context& context) {
  constexpr std::size_t few = 100;  // plane.region_growing asks for 50 of a plane
  const auto chosen = points_of_positions(cloud, static_cast<std::size_t>(params.max_points));
  std::vector<std::vector<SeenPatch>> found(chosen.size());
  context.parallel_chunks(chosen.size(), 1, [&](std::size_t position, std::size_t, std::size_t) {
    if (chosen[position].size() < few) return;
    const auto own = std::make_shared<Cloud>(select(cloud, chosen[position]));
    const auto grown = RegionGrowing::run({own}, {}, context);
    for (auto& measured : measure_planes(grown.planes, context))
      if (measured.moments.count > 0) found[position].push_back({position, std::move(measured)});
  });
  std::vector<SeenPatch> patches;
  for (auto& part : found) std::move(part.begin(), part.end(), std::back_inserter(patches));
  return patches;
}

SeenPatch moved(const SeenPatch& patch, const Eigen::Vector3d& shift) {
  SeenPatch result = patch;
  result.measured.plane.offset -= patch.measured.plane.normal.dot(shift);
  for (auto& corner : result.measured.corners) corner += shift;
  return result;
}

Eigen::Vector3d middle_of(const MeasuredPlane& plane) { return (plane.corners[0] + plane.corners[2]) / 2; }

std::optional<SharedPlane> pair_of(const SeenPatch& first, const SeenPatch& second,
                                   const RegisterPositions::Params& params) {
  const MeasuredPlane &a = first.measured, &b = second.measured;
  // The distance in the middle of both, where neither plane's tilt counts for much.
  const Eigen::Vector3d middle = (middle_of(a) + middle_of(b)) / 2;
  const double offset = a.plane.signed_distance(middle) - b.plane.signed_distance(middle);
  if (std::abs(offset) > params.max_offset) return std::nullopt;
  const double shared = std::min(a.shared_area(b), b.shared_area(a));
  if (shared <= 0 || shared < params.min_overlap * std::min(a.area(), b.area())) return std::nullopt;
  return SharedPlane{first.position, second.position, (a.plane.normal + b.plane.normal).normalized(), offset, shared};
}

std::vector<SharedPlane> pairs_of(const std::vector<SeenPatch>& patches, const std::vector<Eigen::Vector3d>& shifts,
                                  const RegisterPositions::Params& params, const Context& context) {
  constexpr std::size_t chunk_size = 16;
  const double least_cosine = std::cos(params.max_angle * std::numbers::pi / 180);
  std::vector<SeenPatch> now;
  std::vector<Eigen::Vector3d> normals;
  now.reserve(patches.size());
  normals.reserve(patches.size());
  for (const auto& patch : patches) {
    now.push_back(moved(patch, shifts[patch.position]));
    normals.push_back(patch.measured.plane.normal);
  }
  std::vector<std::vector<SharedPlane>> found((now.size() + chunk_size - 1) / chunk_size);
  context.parallel_chunks(now.size(), chunk_size, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t k = i + 1; k < now.size(); ++k) {
        if (normals[i].dot(normals[k]) < least_cosine || now[i].position == now[k].position) continue;
        if (const auto pair = pair_of(now[i], now[k], params)) found[chunk].push_back(*pair);
      }
  });
  std::vector<SharedPlane> pairs;
  for (const auto& part : found) pairs.insert(pairs.end(), part.begin(), part.end());
  return pairs;
}

/// The distance that half of the shared area is below.
double median_offset(const std::vector<SharedPlane>& pairs) {
  std::vector<std::pair<double, double>> offsets;
  offsets.reserve(pairs.size());
  for (const auto& pair : pairs) offsets.emplace_back(std::abs(pair.offset), pair.area);
  return offsets.empty() ? 0 : weighted_quantile(std::move(offsets), 0.5);
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
  const std::vector<SeenPatch> patches = patches_of(cloud, params, context);
  std::vector<MeasuredPlane> measured;
  measured.reserve(patches.size());
  for (const auto& patch : patches) measured.push_back(patch.measured);
  const double noise = mean_residual(measured);
  std::vector<Eigen::Vector3d> shifts(cloud.sensors.size(), Eigen::Vector3d::Zero());
  const double before = median_offset(pairs_of(patches, shifts, params, context));
  if (before <= noise / 2) {
    context.info(fmt::format("shared planes agree within {:.1f} mm: nothing moved", 1000 * before));
    return {in.cloud};
  }
  constexpr int rounds = 3;
  constexpr double least_scale = 0.02;
  for (int round = 0; round < rounds; ++round) {
    const auto step = position_shifts(pairs_of(patches, shifts, params, context), shifts.size(),
                                      std::max(least_scale, 2 * noise), context);
    for (std::size_t k = 0; k < shifts.size(); ++k) shifts[k] += step[k];
  }
  double most = 0;
  for (const auto& shift : shifts) most = std::max(most, shift.norm());
  context.info(fmt::format("{} moved by up to {:.1f} mm; shared planes {:.1f} mm apart before, {:.1f} mm after",
                           counted(shifts.size(), "position"), 1000 * most, 1000 * before,
                           1000 * median_offset(pairs_of(patches, shifts, params, context))));
  return {shifted(cloud, shifts)};
}

}  // namespace atrium::plane
