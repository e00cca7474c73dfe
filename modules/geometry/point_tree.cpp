#include "modules/geometry/point_tree.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "graph/api/error.hpp"
#include "modules/geometry/radix_sort.hpp"

namespace atrium {
namespace {

constexpr std::size_t fan = PointTree::fan;
constexpr unsigned axis_bits = 10;
constexpr std::size_t chunk_size = std::size_t{1} << 14U;
using Lanes = float __attribute__((vector_size(16)));  // SSE2

Lanes load(const float* p) { return Lanes{p[0], p[1], p[2], p[3]}; }
Lanes splat(float v) { return Lanes{v, v, v, v}; }

std::uint32_t spread(std::uint32_t v) {  // ten bits, two apart
  v = (v | v << 16U) & 0x030000ffU;
  v = (v | v << 8U) & 0x0300f00fU;
  v = (v | v << 4U) & 0x030c30c3U;
  return (v | v << 2U) & 0x09249249U;
}

/// Squared distances to the eight boxes of a node.
void box_distances(const PointTree::Node& node, const Eigen::Vector3f& p, float* result) {
  for (std::size_t half = 0; half < fan; half += 4) {
    Lanes sum = splat(0);
    for (int axis = 0; axis < 3; ++axis) {
      const Lanes at = splat(p[axis]);
      const Lanes below = load(node.low[axis] + half) - at;
      const Lanes above = at - load(node.high[axis] + half);
      Lanes d = below > above ? below : above;
      d = d > splat(0) ? d : splat(0);
      sum += d * d;
    }
    for (std::size_t i = 0; i < 4; ++i) result[half + i] = sum[static_cast<int>(i)];
  }
}

void point_distances(const PointTree::Leaf& leaf, const Eigen::Vector3f& p, float* result) {
  for (std::size_t half = 0; half < fan; half += 4) {
    const Lanes dx = load(leaf.x + half) - splat(p.x());
    const Lanes dy = load(leaf.y + half) - splat(p.y());
    const Lanes dz = load(leaf.z + half) - splat(p.z());
    const Lanes d = dx * dx + dy * dy + dz * dz;
    for (std::size_t i = 0; i < 4; ++i) result[half + i] = d[static_cast<int>(i)];
  }
}

/// Finite, because the boxes of missing children are infinitely far.
float square(float distance) { return std::min(distance * distance, std::numeric_limits<float>::max()); }

struct One {
  Eigen::Vector3f position;
  Neighbour best;
  // At distance 0 nothing better can come: points in one place stand by ascending index. Otherwise equals are looked
  // at.
  bool wanted(float d) const {
    return d < best.squared_distance || (d == best.squared_distance && (d > 0 || best.index == 0xffffffffU));
  }
  void offer(Neighbour n) {
    if (n < best) best = n;
  }
};

struct Several {
  Eigen::Vector3f position;
  std::size_t k;
  std::vector<Neighbour>& best;
  float limit;
  bool wanted(float d) const { return d < limit || (d == limit && (d > 0 || best.size() < k)); }
  void offer(Neighbour n) {
    if (best.size() == k) {
      if (!(n < best.back())) return;
      best.pop_back();
    }
    auto at = best.end();
    best.push_back(n);
    for (at = best.end() - 1; at != best.begin() && n < *(at - 1); --at) *at = *(at - 1);
    *at = n;
    if (best.size() == k) limit = best.back().squared_distance;
  }
};

struct All {
  Eigen::Vector3f position;
  float limit;
  std::vector<Neighbour>& found;
  bool wanted(float d) const { return d <= limit; }
  void offer(Neighbour n) { found.push_back(n); }
};

}  // namespace

PointTree::PointTree(const std::vector<Eigen::Vector3f>& points, const Context& context) {
  if (points.size() >= 0xffffffffU) throw Error("too many points for a tree: " + std::to_string(points.size()));
  if (points.empty()) return;
  order_.resize(points.size());
  for (std::size_t i = 0; i < order_.size(); ++i) order_[i] = static_cast<std::uint32_t>(i);
  sort(points, 0, points.size(), 0, context);
  build(points, context);
}

/// Sorts order_[begin, end) along the Morton curve of the range's own box; cells of the curve that hold many points are
/// sorted again by their own, so that clusters are resolved at any scale.
void PointTree::sort(const std::vector<Eigen::Vector3f>& points, std::size_t begin, std::size_t end, int depth,
                     const Context& context) {
  Eigen::Vector3f low = points[order_[begin]];
  Eigen::Vector3f high = low;
  for (std::size_t i = begin; i < end; ++i) {
    low = low.cwiseMin(points[order_[i]]);
    high = high.cwiseMax(points[order_[i]]);
  }
  const Eigen::Vector3d base = low.cast<double>();
  const double width = (high.cast<double>() - base).maxCoeff();
  if (!(width > 0) || depth > 24) return;  // all in one place: by index already
  const double scale = (1U << axis_bits) / width;
  std::vector<std::uint64_t> keys(end - begin);
  const auto index_bits = static_cast<unsigned>(std::bit_width(points.size()));
  context.parallel_for(
      keys.size(),
      [&](std::size_t first, std::size_t last) {
        constexpr std::int32_t top = (1 << axis_bits) - 1;
        for (std::size_t i = first; i < last; ++i) {
          const std::uint32_t index = order_[begin + i];
          const Eigen::Vector3d at = (points[index].cast<double>() - base) * scale;
          std::uint64_t key = 0;
          for (unsigned axis = 0; axis < 3; ++axis)
            key |= spread(static_cast<std::uint32_t>(std::min(static_cast<std::int32_t>(at[axis]), top))) << axis;
          keys[i] = key << index_bits | index;
        }
      },
      chunk_size);
  radix_sort(keys, index_bits, index_bits + 3 * axis_bits, context);
  const std::uint64_t mask = (std::uint64_t{1} << index_bits) - 1;
  for (std::size_t i = 0; i < keys.size(); ++i) order_[begin + i] = static_cast<std::uint32_t>(keys[i] & mask);
  for (std::size_t i = 0; i < keys.size();) {
    std::size_t j = i + 1;
    while (j < keys.size() && keys[j] >> index_bits == keys[i] >> index_bits) ++j;
    if (j - i > 4 * fan) sort(points, begin + i, begin + j, depth + 1, context);
    i = j;
  }
}

void PointTree::build(const std::vector<Eigen::Vector3f>& points, const Context& context) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  Node empty{};
  for (int axis = 0; axis < 3; ++axis) {
    std::fill_n(empty.low[axis], fan, inf);
    std::fill_n(empty.high[axis], fan, -inf);
  }
  const auto nodes_for = [](std::size_t children) { return (children + fan - 1) / fan; };
  leaves_.resize(nodes_for(points.size()));
  levels_.emplace_back(nodes_for(leaves_.size()), empty);
  context.parallel_for(leaves_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t l = begin; l < end; ++l) {
      Node& node = levels_[0][l / fan];  // chunks are multiples of eight leaves: no two share a node
      for (std::size_t i = 0; i < fan; ++i) {
        const bool there = l * fan + i < points.size();
        const Eigen::Vector3f p = there ? points[order_[l * fan + i]] : Eigen::Vector3f::Constant(inf);
        leaves_[l].x[i] = p.x();
        leaves_[l].y[i] = p.y();
        leaves_[l].z[i] = p.z();
        for (int axis = 0; there && axis < 3; ++axis) {
          node.low[axis][l % fan] = std::min(node.low[axis][l % fan], p[axis]);
          node.high[axis][l % fan] = std::max(node.high[axis][l % fan], p[axis]);
        }
      }
    }
  });
  while (levels_.back().size() > 1) {
    const std::vector<Node>& below = levels_.back();
    std::vector<Node> above(nodes_for(below.size()), empty);
    for (std::size_t n = 0; n < below.size(); ++n)
      for (int axis = 0; axis < 3; ++axis) {
        above[n / fan].low[axis][n % fan] = *std::min_element(below[n].low[axis], below[n].low[axis] + fan);
        above[n / fan].high[axis][n % fan] = *std::max_element(below[n].high[axis], below[n].high[axis] + fan);
      }
    levels_.push_back(std::move(above));
  }
}

/// Depth first, the nearest child first.
template <class Search>
void PointTree::visit(Search& search, std::size_t level, std::size_t node) const {
  std::array<float, fan> distance;
  box_distances(levels_[level][node], search.position, distance.data());
  std::array<std::uint8_t, fan> queue;
  std::size_t count = 0;
  for (std::uint8_t c = 0; c < fan; ++c) {
    if (!search.wanted(distance[c])) continue;
    std::size_t at = count++;
    for (; at > 0 && distance[queue[at - 1]] > distance[c]; --at) queue[at] = queue[at - 1];
    queue[at] = c;
  }
  for (std::size_t q = 0; q < count; ++q) {
    if (!search.wanted(distance[queue[q]])) return;
    const std::size_t child = node * fan + queue[q];
    if (level > 0) {
      visit(search, level - 1, child);
      continue;
    }
    std::array<float, fan> d;
    point_distances(leaves_[child], search.position, d.data());
    const std::size_t here = std::min(fan, order_.size() - child * fan);
    for (std::size_t i = 0; i < here; ++i)
      if (search.wanted(d[i])) search.offer({order_[child * fan + i], d[i]});
  }
}

bool PointTree::nearest(const Eigen::Vector3f& position, Neighbour& result, float max_distance) const {
  if (order_.empty() || !(max_distance >= 0)) return false;
  One search{position, {0xffffffffU, square(max_distance)}};
  visit(search, levels_.size() - 1, 0);
  if (search.best.index == 0xffffffffU) return false;
  result = search.best;
  return true;
}

void PointTree::k_nearest(const Eigen::Vector3f& position, std::size_t k, std::vector<Neighbour>& result,
                          float max_distance) const {
  result.clear();
  if (order_.empty() || k == 0 || !(max_distance >= 0)) return;
  Several search{position, k, result, square(max_distance)};
  visit(search, levels_.size() - 1, 0);
}

void PointTree::within(const Eigen::Vector3f& position, float max_distance, std::vector<Neighbour>& result) const {
  result.clear();
  if (order_.empty() || !(max_distance >= 0)) return;
  All search{position, square(max_distance), result};
  visit(search, levels_.size() - 1, 0);
}

}  // namespace atrium
