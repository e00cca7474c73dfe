#include "modules/io/glb_groups.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <tuple>

#include "modules/types/turn_between.hpp"

namespace atrium::io {

std::vector<GlbGroup> glb_groups(const Mesh& mesh) {
  std::map<std::tuple<SurfaceClass, std::int32_t, std::int32_t>, GlbGroup> groups;
  GlbGroup* last = nullptr;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const SurfaceClass surface = mesh.classes.empty() ? SurfaceClass::object : mesh.classes[t];
    const std::int32_t storey = mesh.storeys.empty() ? -1 : std::max(mesh.storeys[t], -1);
    const std::int32_t primitive = mesh.primitives.empty() ? -1 : std::max(mesh.primitives[t], -1);
    if (last == nullptr || last->surface != surface || last->storey != storey || last->primitive != primitive) {
      last = &groups[{surface, storey, primitive}];
      last->surface = surface;
      last->storey = storey;
      last->primitive = primitive;
    }
    last->triangles.push_back(t);
  }
  std::vector<GlbGroup> result;
  result.reserve(groups.size());
  for (auto& [key, group] : groups) result.push_back(std::move(group));
  return result;
}

std::optional<Eigen::Vector3d> common_normal(const Mesh& mesh, const GlbGroup& group) {
  constexpr double most = 1e-3;  // of a triangle's normal against the common one, as a sine
  if (group.surface == SurfaceClass::object || group.primitive < 0) return {};
  const auto area = [&](std::uint32_t t) -> Eigen::Vector3d {
    const auto& [a, b, c] = mesh.triangles[t];
    return (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
  };
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto t : group.triangles) sum += area(t);
  if (!(sum.norm() > 0)) return {};
  const Eigen::Vector3d normal = sum.normalized();
  for (const auto t : group.triangles) {
    const Eigen::Vector3d own = area(t);
    if (own.dot(normal) < 0 || own.cross(normal).norm() > most * own.norm()) return {};
  }
  return normal;
}

GroupCorners::Used GroupCorners::gather(const Mesh& mesh, const std::vector<std::uint32_t>& triangles) {
  Used used;
  used.corners.reserve(triangles.size() * 3);
  for (const auto t : triangles)
    for (const auto v : mesh.triangles[t]) {
      if (numbers_[v] == none) {
        numbers_[v] = static_cast<std::uint32_t>(used.vertices.size());
        used.vertices.push_back(v);
      }
      used.corners.push_back(numbers_[v]);
    }
  for (const auto v : used.vertices) numbers_[v] = none;
  return used;
}

Eigen::Vector3d glb_offset(const Mesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const auto& v : mesh.vertices) box.extend(v);
  return glb_offset(mesh.origin, box);
}

Eigen::Vector3d glb_offset(const Eigen::Vector3d& origin, const Eigen::AlignedBox3d& box) {
  constexpr double near = 1000;  // metres
  if (box.isEmpty()) return Eigen::Vector3d::Zero();
  const auto within = [&](const Eigen::Vector3d& shift) {
    return (box.min() + shift).cwiseAbs().maxCoeff() <= near && (box.max() + shift).cwiseAbs().maxCoeff() <= near;
  };
  if (within(origin)) return Eigen::Vector3d::Zero();
  if (within(Eigen::Vector3d::Zero())) return origin;
  return (origin + box.center()).array().round();
}

Eigen::Matrix3d glb_rotation(const Eigen::Vector3d& up) {
  Eigen::Index largest = 0;
  up.cwiseAbs().maxCoeff(&largest);
  const bool positive = up[largest] > 0;
  Eigen::Matrix3d turn;
  if (largest == 2)
    turn << 1, 0, 0, 0, 0, positive ? 1 : -1, 0, positive ? -1 : 1, 0;
  else if (largest == 1)
    turn << 1, 0, 0, 0, positive ? 1 : -1, 0, 0, 0, positive ? 1 : -1;
  else
    turn << 0, positive ? -1 : 1, 0, positive ? 1 : -1, 0, 0, 0, 0, 1;
  constexpr double level = 0.99619;  // cosine of 5 degrees
  const Eigen::Vector3d left = turn * up;
  if (left.y() > level) return turn;
  return turn_between(left, Eigen::Vector3d::UnitY()).toRotationMatrix() * turn;
}

std::array<double, 3> linear(const Colour& colour) {
  std::array<double, 3> result{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double s = colour[i] / 255.0;  // IEC 61966-2-1
    result[i] = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
  }
  return result;
}

std::array<std::uint16_t, 4> linear16(const Colour& colour) {
  static const auto table = [] {
    std::array<std::uint16_t, 256> levels{};
    for (std::size_t i = 0; i < 256; ++i)
      levels[i] = static_cast<std::uint16_t>(std::lround(linear({static_cast<std::uint8_t>(i), 0, 0})[0] * 65535));
    return levels;
  }();
  return {table[colour[0]], table[colour[1]], table[colour[2]], 65535};
}

}  // namespace atrium::io
