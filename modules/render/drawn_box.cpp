#include "modules/render/drawn_box.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace atrium::render {
namespace {

constexpr double outlying_share = 0.001;

/// The value that `share` of the area lies below; the pairs are values and areas.
double area_quantile(std::vector<std::pair<double, double>> values, double share) {
  std::sort(values.begin(), values.end());
  double total = 0;
  for (const auto& [value, area] : values) total += area;
  double below = 0;
  for (const auto& [value, area] : values) {
    below += area;
    if (below > share * total) return value;
  }
  return values.back().first;
}

}  // namespace

Eigen::AlignedBox3d drawn_box(const std::vector<Eigen::Vector3f>& vertices,
                              const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  Eigen::AlignedBox3d whole;
  std::vector<Eigen::AlignedBox3d> boxes(triangles.size());
  std::vector<double> areas(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    std::array<Eigen::Vector3d, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) corner[k] = vertices[triangles[t][k]].cast<double>();
    for (const auto& place : corner) boxes[t].extend(place);
    whole.extend(boxes[t]);
    areas[t] = (corner[1] - corner[0]).cross(corner[2] - corner[0]).norm() / 2;
  }
  const double total = std::accumulate(areas.begin(), areas.end(), 0.0);
  if (!(total > 0)) return whole;

  Eigen::AlignedBox3d core;
  std::vector<std::pair<double, double>> values(triangles.size());
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t t = 0; t < boxes.size(); ++t) values[t] = {boxes[t].min()[axis], areas[t]};
    core.min()[axis] = area_quantile(values, outlying_share);
    for (std::size_t t = 0; t < boxes.size(); ++t) values[t] = {-boxes[t].max()[axis], areas[t]};
    core.max()[axis] = -area_quantile(values, outlying_share);
  }
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(core.diagonal().norm());
  const Eigen::AlignedBox3d near(core.min() - reach, core.max() + reach);
  Eigen::AlignedBox3d box;
  double far_area = 0;
  for (std::size_t t = 0; t < boxes.size(); ++t) {
    if (near.contains(boxes[t]))
      box.extend(boxes[t]);
    else
      far_area += areas[t];
  }
  return far_area < outlying_share * total ? box : whole;
}

}  // namespace atrium::render
