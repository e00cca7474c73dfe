#include "modules/filter/voxel_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>
#include <span>

#include "graph/api/text.hpp"
#include "modules/geometry/point_grid.hpp"

namespace atrium::filter {
namespace {

using Indices = std::span<const std::uint32_t>;

Eigen::Vector3f mean_normal(const std::vector<Eigen::Vector3f>& normals, Indices indices) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto i : indices) sum += normals[i].cast<double>();
  const double length = sum.norm();
  if (length < 1e-3 * static_cast<double>(indices.size())) return normals[indices.front()];
  return (sum / length).cast<float>();
}

Colour mean_colour(const std::vector<Colour>& colours, Indices indices) {
  std::array<std::uint64_t, 3> sum{};
  for (const auto i : indices)
    for (std::size_t c = 0; c < 3; ++c) sum[c] += colours[i][c];
  Colour mean{};
  for (std::size_t c = 0; c < 3; ++c)
    mean[c] = static_cast<std::uint8_t>((sum[c] + indices.size() / 2) / indices.size());
  return mean;
}

std::int32_t majority(const std::vector<std::int32_t>& labels, Indices indices, std::vector<std::int32_t>& scratch) {
  scratch.clear();
  for (const auto i : indices) scratch.push_back(labels[i]);
  if (std::all_of(scratch.begin(), scratch.end(), [&](std::int32_t label) { return label == scratch.front(); }))
    return scratch.front();
  std::sort(scratch.begin(), scratch.end());
  std::int32_t best = scratch.front();
  std::size_t most = 0;
  for (auto it = scratch.begin(); it != scratch.end();) {
    const auto next = std::upper_bound(it, scratch.end(), *it);
    if (static_cast<std::size_t>(next - it) > most) {
      most = static_cast<std::size_t>(next - it);
      best = *it;
    }
    it = next;
  }
  return best;
}

Cloud with_columns_of(const Cloud& cloud, std::size_t size) {
  Cloud result;
  result.origin = cloud.origin;
  result.sensors = cloud.sensors;
  result.unit = cloud.unit;
  result.y_up = cloud.y_up;
  result.crs = cloud.crs;
  result.points.resize(size);
  result.normals.resize(cloud.normals.empty() ? 0 : size);
  result.colours.resize(cloud.colours.empty() ? 0 : size);
  result.labels.resize(cloud.labels.empty() ? 0 : size);
  result.intensities.resize(cloud.intensities.empty() ? 0 : size);
  result.source.resize(cloud.source.empty() ? 0 : size);
  return result;
}

void merge_columns(const Cloud& cloud, Indices indices, Cloud& result, std::size_t at,
                   std::vector<std::int32_t>& scratch) {
  if (!cloud.normals.empty()) result.normals[at] = mean_normal(cloud.normals, indices);
  if (!cloud.colours.empty()) result.colours[at] = mean_colour(cloud.colours, indices);
  if (!cloud.labels.empty()) result.labels[at] = majority(cloud.labels, indices, scratch);
  if (!cloud.source.empty()) result.source[at] = cloud.source[indices.front()];
  if (!cloud.intensities.empty()) {
    double sum = 0;
    for (const auto i : indices) sum += static_cast<double>(cloud.intensities[i]);
    result.intensities[at] = static_cast<float>(sum / static_cast<double>(indices.size()));
  }
}

/// Bit by bit.
bool has_same_points(const Cloud& a, const Cloud& b) {
  const auto same = [](const auto& p, const auto& q) {
    return p.size() == q.size() && (p.empty() || std::memcmp(p.data(), q.data(), p.size() * sizeof(p[0])) == 0);
  };
  return same(a.points, b.points) && same(a.normals, b.normals) && same(a.colours, b.colours) &&
         same(a.labels, b.labels) && same(a.intensities, b.intensities) && same(a.source, b.source);
}

void check_wild(const PointGrid& grid, double size, Context& context) {
  const std::size_t wild = grid.order().size() - grid.inside();
  if (wild == 0) return;
  const double reach = size * static_cast<double>(1U << 19U);
  if (wild > 100 && wild * 1000 > grid.order().size())
    throw Error(
        fmt::format("{} of {} points lie more than {:.6g} m from the cloud's middle: too far for voxels of {:.6g} m",
                    wild, grid.order().size(), reach, size),
        "check the unit of the scan, crop it (filter.crop), or take larger voxels");
  context.warn(fmt::format("{} more than {:.6g} m from the cloud's middle: kept as read",
                           counted(wild, "point lies", "points lie"), reach));
}

}  // namespace

VoxelGrid::Out VoxelGrid::run(const In& in, const Params& params, Context& context) {
  const Cloud& cloud = *in.cloud;
  const PointGrid grid(cloud.points, params.size, context, PointGrid::Lookup::no);
  check_wild(grid, params.size, context);
  const std::size_t cells = grid.cells().size();
  const std::size_t wild = grid.order().size() - grid.inside();
  Cloud result = with_columns_of(cloud, cells + wild);
  context.parallel_for(cells + wild, [&](std::size_t begin, std::size_t end) {
    std::vector<std::int32_t> scratch;
    for (std::size_t c = begin; c < end; ++c) {
      const bool in_cell = c < cells;
      const std::size_t first = in_cell ? grid.cells()[c].begin : grid.inside() + (c - cells);
      const std::size_t last = in_cell ? grid.cells()[c].end : first + 1;
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (std::size_t i = first; i < last; ++i) sum += grid.points()[i].cast<double>();
      result.points[c] = (sum / static_cast<double>(last - first)).cast<float>();
      merge_columns(cloud, Indices(grid.order()).subspan(first, last - first), result, c, scratch);
    }
  });
  if (cells + wild == cloud.size() && has_same_points(result, cloud)) return {in.cloud};
  return {input(std::move(result))};
}

}  // namespace atrium::filter
