#include "modules/metric/welded_mesh.hpp"

#include <tbb/parallel_sort.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "modules/geometry/box_tree.hpp"
#include "modules/geometry/exact_sign.hpp"

namespace atrium::metric {
namespace {

std::vector<std::uint32_t> weld_exactly(const std::vector<Eigen::Vector3d>& vertices) {
  std::vector<std::uint32_t> order(vertices.size()), place(vertices.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto before = [&](std::uint32_t a, std::uint32_t b) {
    const auto &p = vertices[a], &q = vertices[b];
    for (int k = 0; k < 3; ++k)
      if (p[k] != q[k]) return p[k] < q[k];
    return a < b;
  };
  tbb::parallel_sort(order.begin(), order.end(), before);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && vertices[order[i]] == vertices[order[i - 1]];
    place[order[i]] = same ? place[order[i - 1]] : order[i];
  }
  return place;
}

bool has_area(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  for (int k = 0; k < 3; ++k) {
    const int l = (k + 1) % 3;
    if (turn_sign({a[k], a[l]}, {b[k], b[l]}, {c[k], c[l]}) != 0) return true;
  }
  return false;
}

void find_duplicates(WeldedMesh& surface) {
  std::vector<std::pair<Triangle, std::uint32_t>> sorted;
  sorted.reserve(surface.triangles.size());
  for (std::uint32_t i = 0; i < surface.triangles.size(); ++i) {
    Triangle t = surface.triangles[i];
    std::sort(t.begin(), t.end());
    sorted.emplace_back(t, i);
  }
  std::sort(sorted.begin(), sorted.end());
  surface.duplicate.assign(sorted.size(), false);
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i].first != sorted[i - 1].first) continue;
    surface.duplicate[sorted[i].second] = true;
    ++surface.duplicates;
  }
}

}  // namespace

std::vector<std::uint32_t> weld(const std::vector<Eigen::Vector3d>& vertices, double tolerance,
                                const Context& context) {
  auto place = weld_exactly(vertices);
  if (!(tolerance > 0)) return place;
  std::vector<std::uint32_t> own;  // one vertex per place
  for (std::uint32_t i = 0; i < place.size(); ++i)
    if (place[i] == i) own.push_back(i);
  std::vector<Eigen::AlignedBox3d> boxes;
  boxes.reserve(own.size());
  for (const auto i : own) boxes.emplace_back(vertices[i]);
  const BoxTree tree(boxes, context);
  Groups groups(own.size());
  for (std::uint32_t i = 0; i < own.size(); ++i) {
    const Eigen::Vector3d& p = vertices[own[i]];
    const Eigen::Vector3d reach = Eigen::Vector3d::Constant(tolerance);
    tree.meeting({p - reach, p + reach}, [&](std::uint32_t k) {
      if (k < i && (vertices[own[k]] - p).norm() <= tolerance) groups.join(k, i);
    });
  }
  std::vector<std::uint32_t> least(own.size(), 0xffffffffU), joined(vertices.size());
  for (std::uint32_t i = 0; i < own.size(); ++i) {
    auto& l = least[groups.of(i)];
    l = std::min(l, own[i]);
    joined[own[i]] = l;
  }
  for (auto& p : place) p = joined[p];
  return place;
}

std::vector<EdgeUse> edge_uses(const std::vector<Triangle>& triangles) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * triangles.size());
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const auto& t = triangles[i];
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = t[k], b = t[(k + 1) % 3];
      uses.push_back({std::min(a, b), std::max(a, b), i, a < b});
    }
  }
  tbb::parallel_sort(uses.begin(), uses.end());
  return uses;
}

double WeldedMesh::area(std::size_t triangle) const {
  const auto& [a, b, c] = triangles[triangle];
  return (vertices[b] - vertices[a]).cross(vertices[c] - vertices[a]).norm() / 2;
}

WeldedMesh welded(const Mesh& mesh, double tolerance, const Context& context) {
  WeldedMesh surface;
  surface.vertices = mesh.vertices;
  const auto place = weld(mesh.vertices, tolerance, context);
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    const Triangle w{place[t[0]], place[t[1]], place[t[2]]};
    if (!has_area(mesh.vertices[w[0]], mesh.vertices[w[1]], mesh.vertices[w[2]])) {
      ++surface.degenerate;
      continue;
    }
    surface.triangles.push_back(w);
    surface.source.push_back(i);
  }
  find_duplicates(surface);
  return surface;
}

}  // namespace atrium::metric
