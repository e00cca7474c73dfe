#include "modules/geometry/triangle_tree.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

namespace atrium {
namespace {

constexpr std::uint32_t leaf_bit = 0x80000000U;
constexpr std::uint32_t leaf_size = 4;  // at most 7: three bits of a leaf's code
constexpr int bins = 12;
// Deeper splits halve the number of triangles, which bounds the depth and with it the stack of the walks.
constexpr int free_depth = 40;
constexpr std::size_t stack_size = std::size_t{4} * (free_depth + 32);

struct Entry {
  float key;
  std::uint32_t child;
};

}  // namespace

// --- Building --------------------------------------------------------------------------------------------------------

struct TriangleTree::Builder {
  using Box = Eigen::AlignedBox3f;
  struct Range {
    std::uint32_t begin, end;
    Box box;
    std::uint32_t size() const { return end - begin; }
  };
  std::vector<Box> boxes;  // per triangle
  std::vector<std::uint32_t> order;
  std::vector<Node>& nodes;

  Range range(std::uint32_t begin, std::uint32_t end) const {
    Range r{begin, end, Box()};
    for (std::uint32_t i = begin; i < end; ++i) r.box.extend(boxes[order[i]]);
    return r;
  }
  static float area(const Box& box) {
    if (box.isEmpty()) return 0;
    const Eigen::Vector3f d = box.sizes();
    return d.x() * d.y() + d.y() * d.z() + d.z() * d.x();
  }

  std::uint32_t halve(const Range& r, int axis) {
    const std::uint32_t middle = r.begin + r.size() / 2;
    std::nth_element(order.begin() + r.begin, order.begin() + middle, order.begin() + r.end,
                     [&](std::uint32_t i, std::uint32_t k) {
                       const float a = boxes[i].center()[axis], b = boxes[k].center()[axis];
                       return a != b ? a < b : i < k;
                     });
    return middle;
  }

  // The cheapest of `bins` planes across the longest axis of the centres.
  std::uint32_t split(const Range& r, int depth) {
    Box centres;
    for (std::uint32_t i = r.begin; i < r.end; ++i) centres.extend(boxes[order[i]].center());
    int axis = 0;
    const float extent = centres.sizes().maxCoeff(&axis);
    if (!(extent > 0) || depth >= free_depth) return halve(r, axis);
    const float low = centres.min()[axis], scale = static_cast<float>(bins) / extent;
    const auto bin_of = [&](std::uint32_t t) {
      return std::clamp(static_cast<int>((boxes[t].center()[axis] - low) * scale), 0, bins - 1);
    };
    std::array<Box, bins> box;
    std::array<std::uint32_t, bins> count{};
    for (std::uint32_t i = r.begin; i < r.end; ++i) {
      const int b = bin_of(order[i]);
      box[b].extend(boxes[order[i]]);
      ++count[b];
    }
    std::array<float, bins> right_cost{};
    Box sum;
    std::uint32_t n = 0;
    for (int b = bins - 1; b > 0; --b) {
      sum.extend(box[b]);
      n += count[b];
      right_cost[b] = area(sum) * static_cast<float>(n);
    }
    sum.setEmpty();
    n = 0;
    int best = 0;
    float best_cost = std::numeric_limits<float>::infinity();
    for (int b = 1; b < bins; ++b) {
      sum.extend(box[b - 1]);
      n += count[b - 1];
      const float cost = area(sum) * static_cast<float>(n) + right_cost[b];
      if (n > 0 && n < r.size() && cost < best_cost) {
        best_cost = cost;
        best = b;
      }
    }
    if (best == 0) return halve(r, axis);
    const auto middle = std::partition(order.begin() + r.begin, order.begin() + r.end,
                                       [&](std::uint32_t t) { return bin_of(t) < best; });
    return static_cast<std::uint32_t>(middle - order.begin());
  }

  std::uint32_t build(const Range& whole, int depth) {
    std::vector<Range> parts{whole};
    while (parts.size() < 4) {
      const auto widest = std::max_element(parts.begin(), parts.end(), [](const Range& a, const Range& b) {
        const auto weight = [](const Range& r) {
          return r.size() > leaf_size ? 1 + area(r.box) * static_cast<float>(r.size()) : 0;
        };
        return weight(a) < weight(b);
      });
      if (widest->size() <= leaf_size) break;
      const Range r = *widest;
      const std::uint32_t middle = split(r, depth);
      *widest = range(r.begin, middle);
      parts.push_back(range(middle, r.end));
    }
    const auto id = static_cast<std::uint32_t>(nodes.size());
    nodes.emplace_back();
    for (int i = 0; i < 4; ++i) {
      nodes[id].child[i] = none;
      for (int k = 0; k < 3; ++k) {
        nodes[id].low[k][i] = std::numeric_limits<float>::infinity();
        nodes[id].high[k][i] = -std::numeric_limits<float>::infinity();
      }
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const Range& part = parts[i];
      const std::uint32_t child =
          part.size() <= leaf_size ? leaf_bit | part.begin << 3U | part.size() : build(part, depth + 1);
      nodes[id].child[i] = child;
      for (int k = 0; k < 3; ++k) {
        nodes[id].low[k][static_cast<Eigen::Index>(i)] = part.box.min()[k];
        nodes[id].high[k][static_cast<Eigen::Index>(i)] = part.box.max()[k];
      }
    }
    return id;
  }
};

TriangleTree::TriangleTree(const std::vector<Eigen::Vector3d>& vertices,
                           const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  if (triangles.empty()) return;
  Eigen::AlignedBox3d bounds;
  for (const auto& t : triangles)
    for (const auto v : t) bounds.extend(vertices[v]);
  centre_ = bounds.center();
  // Boxes are padded by more than single precision loses in coordinates of the bounds' size.
  const double pad = 1e-5 * bounds.sizes().maxCoeff();
  Builder builder{{}, {}, nodes_};
  builder.boxes.resize(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    Eigen::AlignedBox3d box;
    for (const auto v : triangles[i]) box.extend((vertices[v] - centre_).eval());
    builder.boxes[i] = {(box.min().array() - pad).cast<float>().matrix(),
                        (box.max().array() + pad).cast<float>().matrix()};
  }
  builder.order.resize(triangles.size());
  std::iota(builder.order.begin(), builder.order.end(), 0U);
  nodes_.reserve(triangles.size() / 2 + 1);
  builder.build(builder.range(0, static_cast<std::uint32_t>(triangles.size())), 0);
  triangles_.reserve(triangles.size());
  slots_.resize(triangles.size());
  for (const auto i : builder.order) {
    const auto& [a, b, c] = triangles[i];
    slots_[i] = static_cast<std::uint32_t>(triangles_.size());
    const Eigen::Vector3d ab = vertices[b] - vertices[a], ac = vertices[c] - vertices[a];
    const double longest = std::max({ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()});
    const bool thin = !(ab.cross(ac).squaredNorm() > 1e-24 * longest * longest);
    triangles_.push_back({vertices[a], ab, ac, i, thin});
  }
}

// --- Rays ------------------------------------------------------------------------------------------------------------

struct TriangleTree::Ray {
  std::array<float, 3> from, inverse;
  Ray(const Eigen::Vector3d& start, const Eigen::Vector3d& direction, const Eigen::Vector3d& centre) {
    for (int k = 0; k < 3; ++k) {
      from[k] = static_cast<float>(start[k] - centre[k]);
      // A direction of nearly 0 would give infinity, and infinity · 0 is no number.
      const double d = std::abs(direction[k]) < 1e-18 ? std::copysign(1e-18, direction[k]) : direction[k];
      inverse[k] = static_cast<float>(1 / d);
    }
  }
};

bool TriangleTree::Triangle::hit(const Eigen::Vector3d& from, const Eigen::Vector3d& direction, Hit& best) const {
  // Möller and Trumbore 1997; the tolerance closes the seam between triangles that share an edge.
  constexpr double seam = 1e-12;
  const Eigen::Vector3d p = direction.cross(ac);
  const double determinant = ab.dot(p);
  if (determinant == 0) return false;
  const double inverse = 1 / determinant;
  const Eigen::Vector3d s = from - a;
  const double u = s.dot(p) * inverse;
  if (!(u >= -seam && u <= 1 + seam)) return false;
  const Eigen::Vector3d q = s.cross(ab);
  const double v = direction.dot(q) * inverse;
  if (!(v >= -seam && u + v <= 1 + seam)) return false;
  const double t = ac.dot(q) * inverse;
  if (!(t > 0) || t > best.distance || (t == best.distance && index >= best.triangle)) return false;
  best = {index, t, determinant > 0};
  return true;
}

template <class Visit>
void TriangleTree::walk_ray(const Ray& ray, double& limit, Visit visit) const {
  if (nodes_.empty()) return;
  std::array<Entry, stack_size> stack;
  std::size_t top = 0;
  stack[top++] = {0, 0};
  while (top > 0) {
    const Entry entry = stack[--top];
    if (static_cast<double>(entry.key) > limit) continue;
    if ((entry.child & leaf_bit) != 0) {
      const std::uint32_t first = (entry.child & ~leaf_bit) >> 3U, count = entry.child & 7U;
      for (std::uint32_t i = first; i < first + count; ++i)
        if (visit(triangles_[i])) return;
      continue;
    }
    const Node& node = nodes_[entry.child];
    Lane near = Lane::Zero(), far = Lane::Constant(std::numeric_limits<float>::max());
    for (int k = 0; k < 3; ++k) {
      const Lane t1 = (node.low[k] - ray.from[k]) * ray.inverse[k], t2 = (node.high[k] - ray.from[k]) * ray.inverse[k];
      near = near.max(t1.min(t2));
      far = far.min(t1.max(t2));
    }
    near *= 1 - 4e-7F;
    far *= 1 + 4e-7F;
    // The nearest child ends on top of the stack.
    const std::size_t base = top;
    for (int i = 0; i < 4; ++i) {
      if (node.child[i] == none || !(near[i] <= far[i]) || static_cast<double>(near[i]) > limit) continue;
      std::size_t place = top++;
      for (; place > base && stack[place - 1].key < near[i]; --place) stack[place] = stack[place - 1];
      stack[place] = {near[i], node.child[i]};
    }
  }
}

TriangleTree::Hit TriangleTree::cast(const Eigen::Vector3d& from, const Eigen::Vector3d& direction,
                                     double limit) const {
  Hit best;
  best.distance = limit;
  walk_ray(Ray(from, direction, centre_), best.distance, [&](const Triangle& t) {
    t.hit(from, direction, best);
    return false;
  });
  if (!best) best.distance = std::numeric_limits<double>::infinity();
  return best;
}

bool TriangleTree::blocked(const Eigen::Vector3d& from, const Eigen::Vector3d& direction, double limit) const {
  Hit best;
  best.distance = limit;
  double bound = limit;
  walk_ray(Ray(from, direction, centre_), bound, [&](const Triangle& t) { return t.hit(from, direction, best); });
  return static_cast<bool>(best);
}

// --- Nearest points --------------------------------------------------------------------------------------------------

namespace {
double squared_distance_to_segment(const Eigen::Vector3d& from_start, const Eigen::Vector3d& along) {
  const double length = along.squaredNorm();
  const double t = length > 0 ? std::clamp(from_start.dot(along) / length, 0.0, 1.0) : 0.0;
  return (from_start - t * along).squaredNorm();
}
}  // namespace

double TriangleTree::Triangle::squared_distance(const Eigen::Vector3d& p) const {
  const Eigen::Vector3d ap = p - a;
  if (thin)
    return std::min({squared_distance_to_segment(ap, ab), squared_distance_to_segment(ap, ac),
                     squared_distance_to_segment(ap - ab, ac - ab)});
  // Ericson, Real-Time Collision Detection (2005), 5.1.5: the region of the triangle that is nearest.
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return ap.squaredNorm();
  const Eigen::Vector3d bp = ap - ab;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return bp.squaredNorm();
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return (ap - (d1 - d3 > 0 ? d1 / (d1 - d3) : 0.0) * ab).squaredNorm();
  const Eigen::Vector3d cp = ap - ac;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return cp.squaredNorm();
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return (ap - (d2 - d6 > 0 ? d2 / (d2 - d6) : 0.0) * ac).squaredNorm();
  const double va = d3 * d6 - d5 * d4;
  const double e = d4 - d3, f = d5 - d6;
  if (va <= 0 && e >= 0 && f >= 0) return (bp - (e + f > 0 ? e / (e + f) : 0.0) * (ac - ab)).squaredNorm();
  const double sum = va + vb + vc;
  return (ap - (vb / sum) * ab - (vc / sum) * ac).squaredNorm();
}

template <class Visit>
void TriangleTree::walk_near(const Eigen::Vector3d& point, double& limit, Visit visit) const {
  if (nodes_.empty()) return;
  const Eigen::Vector3f local = (point - centre_).cast<float>();
  std::array<Entry, stack_size> stack;
  std::size_t top = 0;
  stack[top++] = {0, 0};
  while (top > 0) {
    const Entry entry = stack[--top];
    if (static_cast<double>(entry.key) > limit) continue;
    if ((entry.child & leaf_bit) != 0) {
      const std::uint32_t first = (entry.child & ~leaf_bit) >> 3U, count = entry.child & 7U;
      for (std::uint32_t i = first; i < first + count; ++i) visit(triangles_[i]);
      continue;
    }
    const Node& node = nodes_[entry.child];
    Lane squared = Lane::Zero();
    for (int k = 0; k < 3; ++k) {
      const Lane d = (node.low[k] - local[k]).max(local[k] - node.high[k]).max(0.0F);
      squared += d * d;
    }
    squared *= 1 - 2e-6F;
    const std::size_t base = top;
    for (int i = 0; i < 4; ++i) {
      if (node.child[i] == none || static_cast<double>(squared[i]) > limit) continue;
      std::size_t place = top++;
      for (; place > base && stack[place - 1].key < squared[i]; --place) stack[place] = stack[place - 1];
      stack[place] = {squared[i], node.child[i]};
    }
  }
}

TriangleTree::Nearest TriangleTree::nearest(const Eigen::Vector3d& point, double limit, std::uint32_t hint) const {
  Nearest best{none, limit};
  const auto offer = [&](const Triangle& t) {
    const double d = t.squared_distance(point);
    if (d < best.squared_distance) best = {t.index, d};
  };
  if (hint < slots_.size()) offer(triangles_[slots_[hint]]);
  walk_near(point, best.squared_distance, offer);
  return best;
}

TriangleTree::Nearest TriangleTree::nearest_of(const Eigen::Vector3d& point, double limit,
                                               const std::function<bool(std::uint32_t)>& accept) const {
  Nearest best{none, limit};
  walk_near(point, best.squared_distance, [&](const Triangle& t) {
    const double d = t.squared_distance(point);
    if (d < best.squared_distance && accept(t.index)) best = {t.index, d};
  });
  return best;
}

void TriangleTree::within(const Eigen::Vector3d& point, double limit, std::vector<std::uint32_t>& found) const {
  walk_near(point, limit, [&](const Triangle& t) {
    if (t.squared_distance(point) <= limit) found.push_back(t.index);
  });
}

}  // namespace atrium
