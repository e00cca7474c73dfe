#include "modules/floorplan/surfaces.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <numeric>

namespace atrium::floorplan {
namespace {

constexpr double least_area = 1e-8;     // square metres: thinner than a tenth of a millimetre squared
constexpr double same_plane = 0.99985;  // cos 1°

Eigen::Vector3d area_of(const Mesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return 0.5 * (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
}

std::int32_t storey_of(const Mesh& mesh, std::size_t t) { return mesh.storeys.empty() ? 0 : mesh.storeys[t]; }
std::int32_t primitive_of(const Mesh& mesh, std::size_t t) { return mesh.primitives.empty() ? -1 : mesh.primitives[t]; }

// Sets of triangles that grow together.
class Groups {
 public:
  explicit Groups(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t of(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    a = of(a), b = of(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

// Groups triangles of no primitive: those that share an edge (by place, to a tenth of a millimetre) and lie in a plane.
Groups coplanar_groups(const Mesh& mesh, const std::vector<std::size_t>& triangles) {
  using Place = std::array<long long, 3>;
  const auto place = [&](std::uint32_t v) {
    const Eigen::Vector3d p = mesh.vertices[v] * 1e4;
    return Place{std::llround(p.x()), std::llround(p.y()), std::llround(p.z())};
  };
  Groups groups(mesh.triangles.size());
  std::map<std::pair<Place, Place>, std::vector<std::size_t>> edges;
  for (const std::size_t t : triangles) {
    const Eigen::Vector3d normal = area_of(mesh, t).normalized();
    for (int k = 0; k < 3; ++k) {
      const Place a = place(mesh.triangles[t][k]), b = place(mesh.triangles[t][(k + 1) % 3]);
      auto& others = edges[std::minmax(a, b)];
      for (const std::size_t other : others)
        if (mesh.classes[other] == mesh.classes[t] && storey_of(mesh, other) == storey_of(mesh, t) &&
            area_of(mesh, other).normalized().dot(normal) > same_plane)
          groups.join(other, t);
      if (others.size() < 8) others.push_back(t);
    }
  }
  return groups;
}

void finish(Surface& s) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& [a, b, c] : s.triangles) {
    const Eigen::Vector3d area = 0.5 * (b - a).cross(c - a);
    sum += area;
    s.area += area.norm();
    s.centre += area.norm() * (a + b + c) / 3;
  }
  s.centre /= s.area;
  s.normal = sum.norm() > 0 ? Eigen::Vector3d(sum.normalized()) : Eigen::Vector3d::UnitZ();
}

}  // namespace

Eigen::Vector3d up_of(const Mesh& mesh) {
  Eigen::Vector3d floors = Eigen::Vector3d::Zero(), ceilings = Eigen::Vector3d::Zero();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.classes[t] != SurfaceClass::floor && mesh.classes[t] != SurfaceClass::ceiling) continue;
    const Eigen::Vector3d area = area_of(mesh, t);
    (mesh.classes[t] == SurfaceClass::floor ? floors : ceilings) += area.z() < 0 ? Eigen::Vector3d(-area) : area;
  }
  for (const auto& sum : {floors, ceilings})
    if (sum.norm() > least_area) return sum.normalized();
  return Eigen::Vector3d::UnitZ();
}

std::vector<Surface> surfaces_of(const Mesh& mesh, const Eigen::Matrix3d& rotation, const Eigen::Vector3d& origin,
                                 std::size_t& dropped) {
  std::vector<std::size_t> structural, loose;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.classes[t] == SurfaceClass::object) continue;
    if (area_of(mesh, t).norm() < least_area) {
      ++dropped;
      continue;
    }
    structural.push_back(t);
    if (primitive_of(mesh, t) < 0) loose.push_back(t);
  }
  Groups groups = coplanar_groups(mesh, loose);
  using Key = std::tuple<std::int32_t, SurfaceClass, std::int32_t, std::size_t>;
  std::map<Key, Surface> surfaces;
  const Eigen::Vector3d shift = mesh.origin - origin;
  for (const std::size_t t : structural) {
    const std::int32_t storey = std::max(0, storey_of(mesh, t)), primitive = primitive_of(mesh, t);
    Surface& s = surfaces[{storey, mesh.classes[t], primitive, primitive < 0 ? groups.of(t) : 0}];
    s.surface = mesh.classes[t];
    s.storey = storey;
    s.primitive = std::max(-1, primitive);
    auto& corners = s.triangles.emplace_back();
    for (int k = 0; k < 3; ++k) corners[k] = rotation * (mesh.vertices[mesh.triangles[t][k]] + shift);
  }
  std::vector<Surface> result;
  for (auto& [key, surface] : surfaces) {
    finish(surface);
    result.push_back(std::move(surface));
  }
  return result;
}

}  // namespace atrium::floorplan
