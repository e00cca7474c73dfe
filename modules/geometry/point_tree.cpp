#include "modules/geometry/point_tree.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "graph/api/error.hpp"

namespace atrium {
namespace {

constexpr std::size_t fan = PointTree::fan;
using Lanes = float __attribute__((vector_size(16)));  // SSE2

Lanes load(const float* p) { return Lanes{p[0], p[1], p[2], p[3]}; }
Lanes splat(float v) { return Lanes{v, v, v, v}; }

/// Squared distances from the box between two corners to the eight boxes of a node.
inline void box_distances(const PointTree::Node& node, const Eigen::Vector3f& least, const Eigen::Vector3f& most,
                          float* result) {
  for (std::size_t half = 0; half < fan; half += 4) {
    Lanes sum = splat(0);
    for (int axis = 0; axis < 3; ++axis) {
      const Lanes below = load(node.low[axis] + half) - splat(most[axis]);
      const Lanes above = splat(least[axis]) - load(node.high[axis] + half);
      Lanes d = below > above ? below : above;
      d = d > splat(0) ? d : splat(0);
      sum += d * d;
    }
    for (std::size_t i = 0; i < 4; ++i) result[half + i] = sum[static_cast<int>(i)];
  }
}

inline void point_distances(const PointTree::Leaf& leaf, const Eigen::Vector3f& p, float* result) {
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

// A search sees the nearest child first if it is `ordered`: what it finds there makes it want less of the rest.
struct One {
  static constexpr bool ordered = true;
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
  static constexpr bool ordered = true;
  Eigen::Vector3f position;
  std::size_t k;
  float limit;
  Neighbour* best;  // room for k, ascending
  std::size_t count = 0;
  bool wanted(float d) const { return d < limit || (d == limit && (d > 0 || count < k)); }
  void offer(Neighbour n) {
    if (count == k) {
      if (!(n < best[k - 1])) return;
    } else {
      ++count;
    }
    std::size_t at = count - 1;
    for (; at > 0 && n < best[at - 1]; --at) best[at] = best[at - 1];
    best[at] = n;
    if (count == k) limit = best[k - 1].squared_distance;
  }
};

struct All {
  static constexpr bool ordered = false;
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
  sort(points, context);
  build(points, context);
}

namespace {

struct Item {
  float at[3];
  std::uint32_t index;
};

/// Orders by (coordinate, index): -0 and 0 are the same coordinate.
std::uint64_t key(const Item& item, int axis) {
  const auto bits = std::bit_cast<std::uint32_t>(item.at[axis] + 0.0F);
  const std::uint32_t ordered = bits ^ ((bits >> 31U) != 0 ? 0xffffffffU : 0x80000000U);
  return static_cast<std::uint64_t>(ordered) << 32U | item.index;
}

/// Puts the items whose key is below the pivot first; returns where they end. Without branches that depend on data.
Item* partition(Item* begin, Item* end, int axis, std::uint64_t pivot) {
  Item* next = begin;
  for (Item* i = begin; i != end; ++i) {
    const Item item = *i;
    *i = *next;
    *next = item;
    next += key(item, axis) < pivot ? 1 : 0;
  }
  return next;
}

/// What std::nth_element does, with pivots from a sample on both sides of the target (Floyd & Rivest, 1975).
void select(Item* begin, Item* middle, Item* end, int axis) {
  std::array<std::uint64_t, 512> sample;
  while (end - begin > 64) {
    const std::ptrdiff_t n = end - begin;
    const std::ptrdiff_t samples = n > 8192 ? 512 : n > 512 ? 64 : 16;
    const std::ptrdiff_t margin = n > 8192 ? 32 : n > 512 ? 8 : 3;
    for (std::ptrdiff_t i = 0; i < samples; ++i)
      sample[static_cast<std::size_t>(i)] = key(begin[i * n / samples], axis);
    std::sort(sample.begin(), sample.begin() + samples);
    const std::ptrdiff_t rank = (middle - begin) * samples / n;
    const bool upper = rank + margin < samples && (rank - margin < 0 || rank <= samples / 2);
    const std::ptrdiff_t chosen = upper ? rank + margin : std::max<std::ptrdiff_t>(rank - margin, 1);
    Item* cut = partition(begin, end, axis, sample[static_cast<std::size_t>(chosen)]);
    (middle < cut ? end : begin) = cut;
  }
  std::nth_element(begin, middle, end, [axis](const Item& a, const Item& b) { return key(a, axis) < key(b, axis); });
}

struct Range {
  std::size_t begin, end;
  std::size_t capacity;  ///< points below one child of the node that is being filled
};

/// Cuts a range at its widest axis so that both parts fill whole children. Returns false once it fits into a leaf.
bool split(std::vector<Item>& items, Range range, Range& left, Range& right) {
  while (range.capacity >= fan && range.end - range.begin <= range.capacity) range.capacity /= fan;
  if (range.capacity < fan) return false;
  Lanes low = splat(PointTree::everywhere), high = splat(-PointTree::everywhere);
  for (std::size_t i = range.begin; i < range.end; ++i) {
    const Lanes p{items[i].at[0], items[i].at[1], items[i].at[2], 0};
    low = p < low ? p : low;
    high = p > high ? p : high;
  }
  const Lanes width = high - low;
  const int axis = width[0] >= width[1] && width[0] >= width[2] ? 0 : width[1] >= width[2] ? 1 : 2;
  const std::size_t children = (range.end - range.begin + range.capacity - 1) / range.capacity;
  const std::size_t middle = range.begin + (children + 1) / 2 * range.capacity;
  select(items.data() + range.begin, items.data() + middle, items.data() + range.end, axis);
  left = {range.begin, middle, range.capacity};
  right = {middle, range.end, range.capacity};
  return true;
}

void split_all(std::vector<Item>& items, Range range) {
  Range left{}, right{};
  if (split(items, range, left, right)) {
    split_all(items, left);
    split_all(items, right);
  } else {
    std::sort(items.begin() + static_cast<std::ptrdiff_t>(range.begin),
              items.begin() + static_cast<std::ptrdiff_t>(range.end),
              [](const Item& a, const Item& b) { return a.index < b.index; });
  }
}

}  // namespace

/// Orders the points as the leaves of a balanced k-d tree (Bentley 1975) whose every third cut is a node's border.
void PointTree::sort(const std::vector<Eigen::Vector3f>& points, const Context& context) {
  std::vector<Item> items(points.size());
  for (std::size_t i = 0; i < items.size(); ++i)
    items[i] = {{points[i].x(), points[i].y(), points[i].z()}, static_cast<std::uint32_t>(i)};
  std::size_t capacity = fan;
  while (capacity < items.size()) capacity *= fan;
  std::vector<Range> ranges{{0, items.size(), capacity}};
  for (int level = 0; level < 6 && items.size() > 10000; ++level) {
    std::vector<Range> next(2 * ranges.size());
    context.parallel_for(
        ranges.size(), [&](std::size_t r, std::size_t) { split(items, ranges[r], next[2 * r], next[2 * r + 1]); }, 1);
    ranges.swap(next);
  }
  context.parallel_for(
      ranges.size(), [&](std::size_t r, std::size_t) { split_all(items, ranges[r]); }, 1);
  order_.resize(items.size());
  for (std::size_t i = 0; i < items.size(); ++i) order_[i] = items[i].index;
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

template <class Search>
void PointTree::visit(Search& search, std::size_t level, std::size_t node) const {
  std::array<float, fan> distance;
  box_distances(levels_[level][node], search.position, search.position, distance.data());
  std::array<std::uint8_t, fan> queue;
  std::size_t count = 0;
  for (std::uint8_t c = 0; c < fan; ++c) {
    if (!search.wanted(distance[c])) continue;
    std::size_t at = count++;
    for (; Search::ordered && at > 0 && distance[queue[at - 1]] > distance[c]; --at) queue[at] = queue[at - 1];
    queue[at] = c;
  }
  for (std::size_t q = 0; q < count; ++q) {
    if (Search::ordered && !search.wanted(distance[queue[q]])) return;
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

bool PointTree::gather(const Eigen::AlignedBox3f& box, float limit, std::size_t most, std::size_t level,
                       std::size_t node, std::vector<std::uint32_t>& result) const {
  if (level == 0) {
    result.push_back(static_cast<std::uint32_t>(node));
    return result.size() <= most;
  }
  std::array<float, fan> distance;
  box_distances(levels_[level][node], box.min(), box.max(), distance.data());
  for (std::size_t c = 0; c < fan; ++c)
    if (distance[c] <= limit && !gather(box, limit, most, level - 1, node * fan + c, result)) return false;
  return true;
}

bool PointTree::nodes_near(const Eigen::AlignedBox3f& box, float max_distance, std::size_t most,
                           std::vector<std::uint32_t>& result) const {
  result.clear();
  if (order_.empty() || !(max_distance >= 0)) return true;
  return gather(box, square(max_distance), most, levels_.size() - 1, 0, result);
}

void PointTree::squared_distances(const Eigen::Vector3f& position, float max_distance,
                                  const std::vector<std::uint32_t>& nodes, std::vector<float>& result) const {
  result.resize(nodes.size() * fan * fan);
  const float limit = square(max_distance);
  std::size_t count = 0;
  for (const std::size_t node : nodes) {
    std::array<float, fan> distance;
    box_distances(levels_[0][node], position, position, distance.data());
    for (std::size_t c = 0; c < fan; ++c) {
      if (!(distance[c] <= limit)) continue;
      std::array<float, fan> d;
      point_distances(leaves_[node * fan + c], position, d.data());
      for (std::size_t i = 0; i < fan; ++i) {  // without branches; behind the last point they are infinite
        result[count] = d[i];
        count += d[i] <= limit ? 1 : 0;
      }
    }
  }
  result.resize(count);
}

std::size_t PointTree::count_in(std::size_t leaf, const Eigen::Vector3f& position, float limit) const {
  std::array<float, fan> d;
  point_distances(leaves_[leaf], position, d.data());
  std::size_t count = 0;
  for (const float squared : d) count += squared <= limit ? 1 : 0;  // behind the last point they are infinite
  return count;
}

/// Points within reach below a node, but for those below the node `but` of the lowest level; stops at `enough`.
std::size_t PointTree::count_below(std::size_t level, std::size_t node, const Eigen::Vector3f& position, float limit,
                                   std::size_t enough, std::size_t but) const {
  if (level == 0 && node == but) return 0;
  std::array<float, fan> distance;
  box_distances(levels_[level][node], position, position, distance.data());
  std::size_t count = 0;
  for (std::size_t c = 0; c < fan && count < enough; ++c) {
    if (!(distance[c] <= limit)) continue;
    count += level > 0 ? count_below(level - 1, node * fan + c, position, limit, enough - count, but)
                       : count_in(node * fan + c, position, limit);
  }
  return count;
}

bool PointTree::has_within(const Eigen::Vector3f& position, float max_distance, std::size_t count,
                           std::size_t near) const {
  if (count == 0) return true;
  if (order_.size() < count || !(max_distance >= 0)) return false;
  const float limit = square(max_distance);
  std::size_t found = 0;
  for (std::size_t c = 0; c < fan; ++c) {
    const std::size_t leaf = near ^ c;  // the others of its node
    if (leaf >= leaves_.size()) continue;
    found += count_in(leaf, position, limit);
    if (found >= count) return true;
  }
  return found + count_below(levels_.size() - 1, 0, position, limit, count - found, near / fan) >= count;
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
  result.resize(order_.empty() || !(max_distance >= 0) ? 0 : std::min(k, order_.size()));
  if (result.empty()) return;
  Several search{position, result.size(), square(max_distance), result.data()};
  visit(search, levels_.size() - 1, 0);
  result.resize(search.count);
}

void PointTree::within(const Eigen::Vector3f& position, float max_distance, std::vector<Neighbour>& result) const {
  result.clear();
  if (order_.empty() || !(max_distance >= 0)) return;
  All search{position, square(max_distance), result};
  visit(search, levels_.size() - 1, 0);
}

}  // namespace atrium
