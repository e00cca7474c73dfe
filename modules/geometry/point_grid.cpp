#include "modules/geometry/point_grid.hpp"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "graph/api/error.hpp"
#include "modules/geometry/quantile.hpp"
#include "modules/geometry/radix_sort.hpp"

namespace atrium {
namespace {

constexpr std::int64_t max_extent = std::int64_t{1} << 20U;
constexpr std::size_t chunk_size = std::size_t{1} << 16U;
constexpr std::uint64_t outside_key = ~std::uint64_t{0};

struct Box {
  Eigen::Vector3f low = Eigen::Vector3f::Constant(std::numeric_limits<float>::infinity());
  Eigen::Vector3f high = -low;
};

Box bounds(const std::vector<Eigen::Vector3f>& points, const Context& context) {
  std::vector<Box> boxes((points.size() + chunk_size - 1) / chunk_size);
  context.parallel_chunks(points.size(), chunk_size, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    Box box;
    for (std::size_t i = begin; i < end; ++i) {
      box.low = box.low.cwiseMin(points[i]);
      box.high = box.high.cwiseMax(points[i]);
    }
    boxes[chunk] = box;
  });
  Box all;
  for (const Box& box : boxes) {
    all.low = all.low.cwiseMin(box.low);
    all.high = all.high.cwiseMax(box.high);
  }
  return all;
}

double median_along(const std::vector<Eigen::Vector3f>& points, Eigen::Index axis) {
  std::vector<float> values;
  values.reserve(points.size());
  for (const auto& p : points) values.push_back(p[axis]);
  return median(std::move(values));
}

/// Tables that give each coordinate's bits their places in a Morton key that leaves out the bits no coordinate has.
unsigned spread_tables(const std::array<std::int32_t, 3>& extent, std::array<std::vector<std::uint64_t>, 3>& tables) {
  std::array<unsigned, 3> bits{};
  for (std::size_t axis = 0; axis < 3; ++axis)  // two bits at least: blocks are 4 × 4 × 4
    bits[axis] = std::max(2U, static_cast<unsigned>(std::bit_width(static_cast<std::uint32_t>(extent[axis] - 1))));
  unsigned next = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) tables[axis].assign(static_cast<std::size_t>(extent[axis]), 0);
  for (unsigned bit = 0; bit < 21; ++bit)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (bit >= bits[axis]) continue;
      for (std::size_t i = 0; i < tables[axis].size(); ++i)
        tables[axis][i] |= static_cast<std::uint64_t>((i >> bit) & 1U) << next;
      ++next;
    }
  return next;
}

}  // namespace

PointGrid::PointGrid(const std::vector<Eigen::Vector3f>& points, double cell_size, const Context& context,
                     Lookup lookup)
    : cell_size_(cell_size), inverse_(1.0 / cell_size) {
  if (!(cell_size > 0) || !std::isfinite(inverse_) || !std::isfinite(cell_size))
    throw Error("a grid of cells of " + std::to_string(cell_size) + " m", "the cell size must be above 0");
  if (points.size() >= none) throw Error("too many points for a grid: " + std::to_string(points.size()));
  blocks_.resize(2);  // both empty
  if (points.empty()) return;
  span(points, context);
  const auto cell_keys = make_cells(sort(points, context), context);
  if (lookup == Lookup::yes) make_blocks(cell_keys);
}

void PointGrid::span(const std::vector<Eigen::Vector3f>& points, const Context& context) {
  const Box box = bounds(points, context);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    double low = std::floor(static_cast<double>(box.low[axis]) * inverse_);
    double high = std::floor(static_cast<double>(box.high[axis]) * inverse_);
    if (high - low >= static_cast<double>(max_extent)) {
      const double middle = std::floor(median_along(points, axis) * inverse_);
      low = std::max(low, middle - 0.5 * static_cast<double>(max_extent));
      high = std::min(high, low + static_cast<double>(max_extent - 1));
    }
    base_[axis] = low;
    extent_[static_cast<std::size_t>(axis)] = static_cast<std::int32_t>(high - low) + 1;
  }
  key_bits_ = spread_tables(extent_, spread_);
}

std::uint64_t PointGrid::key(const Eigen::Vector3f& point) const {
  const Eigen::Vector3d at = point.cast<double>() * inverse_ - base_;
  const bool in =
      at.x() >= 0 && at.y() >= 0 && at.z() >= 0 && at.x() < extent_[0] && at.y() < extent_[1] && at.z() < extent_[2];
  return !in ? outside_key
             : spread_[0][static_cast<std::size_t>(at.x())] | spread_[1][static_cast<std::size_t>(at.y())] |
                   spread_[2][static_cast<std::size_t>(at.z())];
}

/// Puts the points into their order; returns their keys in it.
std::vector<std::uint64_t> PointGrid::sort(const std::vector<Eigen::Vector3f>& points, const Context& context) {
  const std::size_t total = points.size();
  const auto index_bits = static_cast<unsigned>(std::bit_width(total));
  order_.resize(total);
  points_.resize(total);
  if (key_bits_ + 1 + index_bits > 64) return sort_wide(points, context);
  const std::uint64_t outside = std::uint64_t{1} << key_bits_;  // sorts behind all cells
  std::vector<std::uint64_t> packed(total);
  context.parallel_for(
      total,
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) packed[i] = std::min(key(points[i]), outside) << index_bits | i;
      },
      chunk_size);
  radix_sort(packed, index_bits, index_bits + key_bits_ + 1, context);
  const std::uint64_t mask = (std::uint64_t{1} << index_bits) - 1;
  context.parallel_for(
      total,
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          order_[i] = static_cast<std::uint32_t>(packed[i] & mask);
          points_[i] = points[order_[i]];
          packed[i] >>= index_bits;
          if (packed[i] == outside) packed[i] = outside_key;
        }
      },
      chunk_size);
  return packed;
}

/// The same where key and index do not fit into one number.
std::vector<std::uint64_t> PointGrid::sort_wide(const std::vector<Eigen::Vector3f>& points, const Context& context) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> pairs(points.size());
  context.parallel_for(pairs.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) pairs[i] = {key(points[i]), static_cast<std::uint32_t>(i)};
  });
  tbb::parallel_sort(pairs.begin(), pairs.end());
  std::vector<std::uint64_t> keys(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    std::tie(keys[i], order_[i]) = pairs[i];
    points_[i] = points[order_[i]];
  }
  return keys;
}

/// Returns the cells' keys.
std::vector<std::uint64_t> PointGrid::make_cells(const std::vector<std::uint64_t>& sorted_keys,
                                                 const Context& context) {
  inside_ = static_cast<std::size_t>(std::lower_bound(sorted_keys.begin(), sorted_keys.end(), outside_key) -
                                     sorted_keys.begin());
  std::vector<std::vector<std::uint32_t>> starts((inside_ + chunk_size - 1) / chunk_size);
  context.parallel_chunks(inside_, chunk_size, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (i == 0 || sorted_keys[i] != sorted_keys[i - 1]) starts[chunk].push_back(static_cast<std::uint32_t>(i));
  });
  std::vector<std::size_t> first(starts.size() + 1, 0);
  for (std::size_t c = 0; c < starts.size(); ++c) first[c + 1] = first[c] + starts[c].size();
  cells_.resize(first.back());
  std::vector<std::uint64_t> cell_keys(cells_.size());
  context.parallel_chunks(starts.size(), 1, [&](std::size_t c, std::size_t, std::size_t) {
    for (std::size_t k = 0; k < starts[c].size(); ++k) {
      const std::uint32_t begin = starts[c][k];
      const Eigen::Vector3d at = points_[begin].cast<double>() * inverse_ - base_;
      Cell& cell = cells_[first[c] + k];
      cell.x = static_cast<std::int32_t>(at.x());
      cell.y = static_cast<std::int32_t>(at.y());
      cell.z = static_cast<std::int32_t>(at.z());
      cell.begin = begin;
      cell_keys[first[c] + k] = sorted_keys[begin];
    }
  });
  context.parallel_for(cells_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      cells_[i].end = i + 1 < cells_.size() ? cells_[i + 1].begin : static_cast<std::uint32_t>(inside_);
  });
  return cell_keys;
}

void PointGrid::make_blocks(const std::vector<std::uint64_t>& cell_keys) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < cell_keys.size(); ++i)
    count += i == 0 || cell_keys[i] >> 6U != cell_keys[i - 1] >> 6U ? 1 : 0;
  blocks_.assign(std::bit_ceil(2 * count + 2), {});
  for (std::size_t i = 0; i < cell_keys.size();) {
    Block block{cell_keys[i] >> 6U, 0, static_cast<std::uint32_t>(i)};
    for (; i < cell_keys.size() && cell_keys[i] >> 6U == block.key; ++i)
      block.occupied |= std::uint64_t{1} << (cell_keys[i] & 63U);
    blocks_[slot(block.key)] = block;
  }
  make_map();
}

void PointGrid::make_map() {
  constexpr double most_bits = 1 << 22;
  map_shift_ = 2;
  const auto cubes = [&](std::size_t axis) { return (static_cast<std::size_t>(extent_[axis] - 1) >> map_shift_) + 1; };
  while (static_cast<double>(cubes(0)) * static_cast<double>(cubes(1)) * static_cast<double>(cubes(2)) > most_bits)
    ++map_shift_;
  map_width_ = cubes(0);
  map_height_ = cubes(1);
  map_.assign(map_width_ * map_height_ * cubes(2) / 64 + 1, 0);
  for (const Cell& cell : cells_) {
    const std::size_t bit = map_bit(cell.x, cell.y, cell.z);
    map_[bit >> 6U] |= std::uint64_t{1} << (bit & 63U);
  }
}

std::uint32_t PointGrid::find(std::int32_t x, std::int32_t y, std::int32_t z) const {
  if (x < 0 || y < 0 || z < 0 || x >= extent_[0] || y >= extent_[1] || z >= extent_[2]) return none;
  return block(x, y, z).cell(x, y, z);
}

std::array<std::uint32_t, 27> PointGrid::neighbourhood(const Cell& cell) const {
  std::array<std::uint32_t, 27> result{};
  std::size_t next = 0;
  for (std::int32_t dz = -1; dz <= 1; ++dz)
    for (std::int32_t dy = -1; dy <= 1; ++dy)
      for (std::int32_t dx = -1; dx <= 1; ++dx) result[next++] = find(cell.x + dx, cell.y + dy, cell.z + dz);
  return result;
}

std::array<std::int64_t, 3> PointGrid::place(const Eigen::Vector3d& position) const {
  std::array<std::int64_t, 3> result{};
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double at = std::floor(position[axis] * inverse_ - base_[axis]);
    result[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(std::clamp(at, -1e15, 1e15));
  }
  return result;
}

}  // namespace atrium
