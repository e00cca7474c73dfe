#include "modules/plane/point_octree.hpp"

#include <tbb/parallel_sort.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "modules/geometry/quantile.hpp"
#include "modules/geometry/radix_sort.hpp"

namespace atrium::plane {
namespace {

constexpr std::uint32_t bits_per_axis = 21;
constexpr std::uint32_t block_points = 16384;

/// The bits of a 21-bit number with two zeros after each.
std::uint64_t spread(std::uint64_t v) {
  v = (v | v << 32U) & 0x1f00000000ffffULL;
  v = (v | v << 16U) & 0x1f0000ff0000ffULL;
  v = (v | v << 8U) & 0x100f00f00f00f00fULL;
  v = (v | v << 4U) & 0x10c30c30c30c30c3ULL;
  return (v | v << 2U) & 0x1249249249249249ULL;
}

std::uint64_t morton_code(const Eigen::Vector3d& p, double cell) {
  constexpr double half = 1U << (bits_per_axis - 1);
  const auto axis = [&](double v) {
    return static_cast<std::uint64_t>(std::clamp(std::floor(v / cell) + half, 0.0, 2 * half - 1));
  };
  return spread(axis(p.x())) | spread(axis(p.y())) << 1U | spread(axis(p.z())) << 2U;
}

/// The median of each coordinate over a thousand points spread over the cloud.
Eigen::Vector3d sampled_median(const Cloud& cloud) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  const std::size_t step = std::max<std::size_t>(1, cloud.size() / 1000);
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<float> values;
    for (std::size_t i = 0; i < cloud.size(); i += step) values.push_back(cloud.points[i][axis]);
    middle[axis] = median(std::move(values));
  }
  return middle;
}

struct Item {
  std::uint64_t code;
  std::uint32_t index;
};

/// Codes of cells within 2^k of the centre along each axis, in 3 (k + 1) bits: the bits between the sign and the last k
/// of an axis are all the opposite of the sign, which is the code's highest bit.
struct ShortCodes {
  unsigned levels;  ///< k

  std::uint64_t mask() const { return (std::uint64_t{1} << (3 * levels)) - 1; }
  std::uint64_t shorten(std::uint64_t code) const {
    return (code >> (3 * (bits_per_axis - 1))) << (3 * levels) | (code & mask());
  }
  std::uint64_t lengthen(std::uint64_t code) const {
    const std::uint64_t signs = code >> (3 * levels);
    std::uint64_t result = signs;
    for (unsigned level = bits_per_axis - 1; level > levels; --level) result = result << 3U | (~signs & 7U);
    return result << (3 * levels) | (code & mask());
  }
};

unsigned bit_width(std::uint64_t v) { return v == 0 ? 0 : 64U - static_cast<unsigned>(__builtin_clzll(v)); }

/// How many levels the codes need below their signs.
ShortCodes short_codes(const std::vector<Item>& items, const Context& context) {
  constexpr std::size_t size = 65536;
  constexpr std::uint64_t signs = std::uint64_t{7} << (3 * (bits_per_axis - 1));
  std::vector<std::uint64_t> used((items.size() + size - 1) / size, 0);
  context.parallel_chunks(items.size(), size, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint64_t sign = items[i].code & signs;
      // The signs of the axes, repeated over all levels.
      const std::uint64_t repeated = sign >> (3 * (bits_per_axis - 1)) & 7U;
      used[chunk] |= (items[i].code ^ (0x1249249249249249ULL * (~repeated & 7U))) & ~signs;
    }
  });
  std::uint64_t all = 0;
  for (const std::uint64_t u : used) all |= u;
  return {(bit_width(all) + 2) / 3};
}

/// Sorts by code, then by index.
void sort(std::vector<Item>& items, const Context& context) {
  const ShortCodes codes = short_codes(items, context);
  const unsigned index_bits = bit_width(items.size());
  const unsigned code_bits = 3 * (codes.levels + 1);
  if (index_bits + code_bits > 64) {  // a large scene in small cells
    tbb::this_task_arena::isolate([&] {
      tbb::parallel_sort(items.begin(), items.end(), [](const Item& a, const Item& b) {
        return a.code != b.code ? a.code < b.code : a.index < b.index;
      });
    });
    return;
  }
  std::vector<std::uint64_t> packed(items.size());
  context.parallel_for(items.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) packed[i] = codes.shorten(items[i].code) << index_bits | items[i].index;
  });
  radix_sort(packed, index_bits, index_bits + code_bits, context);
  const std::uint64_t index_mask = (std::uint64_t{1} << index_bits) - 1;
  context.parallel_for(items.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      items[i] = {codes.lengthen(packed[i] >> index_bits), static_cast<std::uint32_t>(packed[i] & index_mask)};
  });
}

}  // namespace

void PointColumns::resize(std::size_t count, bool normals) {
  for (auto* column : {&x, &y, &z}) column->resize(count);
  for (auto* column : {&nx, &ny, &nz}) column->resize(normals ? count : 0);
}

void PointColumns::copy(std::size_t to, const PointColumns& other, std::size_t from) {
  x[to] = other.x[from];
  y[to] = other.y[from];
  z[to] = other.z[from];
  nx[to] = other.nx[from];
  ny[to] = other.ny[from];
  nz[to] = other.nz[from];
}

MortonOrder::MortonOrder(const Cloud& cloud, double cell, const Context& context, Normals normals, double back)
    : shift(back), centre(sampled_median(cloud)) {
  std::vector<Item> items(cloud.size());
  const Eigen::Vector3d corner = centre - Eigen::Vector3d::Constant(back);
  context.parallel_for(items.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      items[i] = {morton_code(cloud.points[i].cast<double>() - corner, cell), static_cast<std::uint32_t>(i)};
  });
  sort(items, context);
  codes.resize(items.size());
  index.resize(items.size());
  columns.resize(items.size(), normals == Normals::yes);
  context.parallel_for(items.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      codes[i] = items[i].code;
      index[i] = items[i].index;
      const Eigen::Vector3f p = (cloud.points[items[i].index].cast<double>() - centre).cast<float>();
      columns.x[i] = p.x();
      columns.y[i] = p.y();
      columns.z[i] = p.z();
      if (normals == Normals::no || !cloud.has_normals()) continue;
      const Eigen::Vector3f& n = cloud.normals[items[i].index];
      columns.nx[i] = n.x();
      columns.ny[i] = n.y();
      columns.nz[i] = n.z();
    }
  });
}

PointOctree::PointOctree(const PointColumns& columns, const std::vector<std::uint64_t>& codes, std::uint32_t leaf_size,
                         const Context& context) {
  if (codes.empty()) return;
  split(codes, leaf_size);
  measure(columns, context);
  for (std::uint32_t i = 0; i < nodes_.size();) {
    if (nodes_[i].leaf || nodes_[i].end - nodes_[i].begin <= block_points) {
      blocks_.push_back(i);
      i = nodes_[i].skip;
    } else {
      ++i;
    }
  }
}

struct PointOctree::Range {
  std::uint32_t begin, end, level, parent;
};

void PointOctree::split(const std::vector<std::uint64_t>& codes, std::uint32_t leaf_size) {
  std::vector<Range> open{{0, static_cast<std::uint32_t>(codes.size()), bits_per_axis, 0}};
  while (!open.empty()) {
    Range range = open.back();
    open.pop_back();
    // The level at which the first and the last code part: levels at which all points share a cell are skipped.
    const std::uint64_t difference = codes[range.begin] ^ codes[range.end - 1];
    range.level = difference == 0 ? 0 : (63U - static_cast<std::uint32_t>(__builtin_clzll(difference))) / 3 + 1;
    const auto id = static_cast<std::uint32_t>(nodes_.size());
    Node node;
    node.begin = range.begin;
    node.end = range.end;
    node.parent = range.parent;
    node.level = range.level;
    node.leaf = range.level == 0 || range.end - range.begin <= leaf_size;
    nodes_.push_back(node);
    if (node.leaf) continue;
    const std::uint32_t shift = 3 * (range.level - 1);
    std::array<std::uint32_t, 9> bounds{};
    const std::uint64_t prefix = codes[range.begin] >> shift >> 3U << 3U;
    for (std::uint32_t child = 0; child < 8; ++child)
      bounds[child] = static_cast<std::uint32_t>(
          std::lower_bound(codes.begin() + range.begin, codes.begin() + range.end, (prefix | child) << shift) -
          codes.begin());
    bounds[8] = range.end;
    for (std::uint32_t child = 8; child-- > 0;)
      if (bounds[child] < bounds[child + 1]) open.push_back({bounds[child], bounds[child + 1], 0, id});
  }
}

void PointOctree::measure(const PointColumns& columns, const Context& context) {
  const auto bound = [](const float* values, std::uint32_t begin, std::uint32_t end, float& centre, float& half) {
    float low = values[begin];
    float high = low;
    for (std::uint32_t i = begin; i < end; ++i) {
      low = std::min(low, values[i]);
      high = std::max(high, values[i]);
    }
    centre = 0.5F * (low + high);
    half = std::max(high - centre, centre - low);
  };
  context.parallel_for(
      nodes_.size(),
      [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
          Node& node = nodes_[i];
          if (!node.leaf) continue;
          bound(columns.x.data(), node.begin, node.end, node.centre.x(), node.half.x());
          bound(columns.y.data(), node.begin, node.end, node.centre.y(), node.half.y());
          bound(columns.z.data(), node.begin, node.end, node.centre.z(), node.half.z());
        }
      },
      1024);
  // Inner boxes from their children's, which stand behind them in preorder; `skip` is where the last child ends.
  std::vector<bool> seen(nodes_.size(), false);
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    Node& node = nodes_[i];
    if (node.leaf) node.skip = static_cast<std::uint32_t>(i) + 1;
    if (i == 0) break;
    Node& parent = nodes_[node.parent];
    if (!seen[node.parent]) {
      seen[node.parent] = true;
      parent.skip = node.skip;
      parent.centre = node.centre;
      parent.half = node.half;
      continue;
    }
    const Eigen::Vector3f low = (parent.centre - parent.half).cwiseMin(node.centre - node.half);
    const Eigen::Vector3f high = (parent.centre + parent.half).cwiseMax(node.centre + node.half);
    parent.centre = 0.5F * (low + high);
    parent.half = (high - parent.centre).cwiseMax(parent.centre - low);
  }
}

}  // namespace atrium::plane
