#include "modules/plane/voxel_grid.hpp"

#include <cmath>

namespace atrium::plane {
namespace {

constexpr std::size_t voxels_per_chunk = 1024;

/// Every third bit of a Morton code.
std::uint32_t gather_bits(std::uint64_t v) {
  v &= 0x1249249249249249ULL;
  v = (v | v >> 2U) & 0x10c30c30c30c30c3ULL;
  v = (v | v >> 4U) & 0x100f00f00f00f00fULL;
  v = (v | v >> 8U) & 0x1f0000ff0000ffULL;
  v = (v | v >> 16U) & 0x1f00000000ffffULL;
  return static_cast<std::uint32_t>((v | v >> 32U) & 0x1fffffULL);
}

/// Where codes begin that differ from the ones before above the lowest `shift` bits.
std::vector<std::uint32_t> run_starts(const std::vector<std::uint64_t>& codes, std::uint32_t shift,
                                      const Context& context) {
  constexpr std::size_t size = 65536;
  std::vector<std::vector<std::uint32_t>> found((codes.size() + size - 1) / size);
  context.parallel_chunks(codes.size(), size, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (i == 0 || (codes[i] ^ codes[i - 1]) >> shift != 0) found[chunk].push_back(static_cast<std::uint32_t>(i));
  });
  std::vector<std::uint32_t> starts;
  for (const auto& part : found) starts.insert(starts.end(), part.begin(), part.end());
  return starts;
}

}  // namespace

VoxelGrid::VoxelGrid(const MortonOrder& order, double cell, std::uint32_t level, const std::vector<std::int32_t>& owner,
                     const Planarity& planarity, const Context& context)
    : edge_(cell * std::pow(2.0, level)), shift_(order.shift), centre_(1 << (20 - static_cast<std::int32_t>(level))) {
  const std::uint32_t shift = 3 * level;
  const std::vector<std::uint32_t> starts = run_starts(order.codes, shift, context);
  voxels_.resize(starts.size());
  context.parallel_for(
      voxels_.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          Voxel& voxel = voxels_[i];
          voxel.begin = starts[i];
          voxel.end = i + 1 < starts.size() ? starts[i + 1] : static_cast<std::uint32_t>(order.codes.size());
          const std::uint64_t code = order.codes[voxel.begin] >> shift;
          for (unsigned axis = 0; axis < 3; ++axis)
            voxel.index[axis] = static_cast<std::int32_t>(gather_bits(code >> axis));
          measure(voxel, order, owner, planarity);
        }
      },
      voxels_per_chunk);
  make_blocks();
}

void VoxelGrid::update(const MortonOrder& order, const std::vector<std::int32_t>& owner, const Planarity& planarity,
                       const Context& context) {
  context.parallel_for(
      voxels_.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          Voxel& voxel = voxels_[i];
          std::uint64_t free = 0;
          for (std::uint32_t k = voxel.begin; k < voxel.end; ++k) free += owner[k] < 0 ? 1 : 0;
          if (free == voxel.moments.count) continue;
          voxel.planar = false;
          measure(voxel, order, owner, planarity);
        }
      },
      voxels_per_chunk);
}

void VoxelGrid::measure(Voxel& voxel, const MortonOrder& order, const std::vector<std::int32_t>& owner,
                        const Planarity& planarity) const {
  // About a point of the voxel first: the fit loses nothing to large coordinates.
  const Eigen::Vector3d reference = order.columns.point(voxel.begin).cast<double>();
  Moments local;
  for (std::uint32_t i = voxel.begin; i < voxel.end; ++i)
    if (owner[i] < 0) local.add(order.columns.point(i).cast<double>() - reference);
  const auto n = static_cast<double>(local.count);
  voxel.moments.count = local.count;
  voxel.moments.sum = local.sum + n * reference;
  voxel.moments.products = local.products + reference * local.sum.transpose() + local.sum * reference.transpose() +
                           n * reference * reference.transpose();
  if (local.count < planarity.min_points) return;
  const PlaneFit fit = fit_plane(local);
  voxel.normal = fit.plane.normal;
  // With few points the fit bends to the noise: n - 3 degrees of freedom are left.
  voxel.residual = std::sqrt(fit.variances[0] * n / (n - 3));
  constexpr double least_width = 1.0 / 8;  // of the voxel, standard deviation
  voxel.planar = voxel.residual <= planarity.max_residual && std::sqrt(fit.variances[1]) >= least_width * edge_ &&
                 fit.variances[0] < 0.25 * fit.variances[1];
}

void VoxelGrid::make_blocks() {
  std::vector<Block> blocks;
  for (std::uint32_t i = 0; i < voxels_.size(); ++i) {  // in Morton order: those of a block stand together
    const auto [x, y, z] = voxels_[i].index;
    const std::uint64_t own = key(x >> 2, y >> 2, z >> 2);
    if (blocks.empty() || blocks.back().key != own) blocks.push_back({own, 0, i});
    blocks.back().occupied |= std::uint64_t{1} << place(x, y, z);
  }
  table_.assign(std::bit_ceil(3 * blocks.size() + 16), {});
  for (const Block& block : blocks) table_[slot(block.key)] = block;
}

Voxel::Index VoxelGrid::index_at(const Eigen::Vector3d& p) const {
  const auto axis = [&](double v) { return static_cast<std::int32_t>(std::floor((v + shift_) / edge_)) + centre_; };
  return {axis(p.x()), axis(p.y()), axis(p.z())};
}

}  // namespace atrium::plane
