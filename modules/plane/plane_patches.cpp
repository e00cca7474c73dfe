#include "modules/plane/plane_patches.hpp"

#include <algorithm>
#include <cmath>

#include "modules/plane/plane_cells.hpp"

namespace atrium::plane {
namespace {

/// Some places in the order of the points of this support.
std::vector<std::uint32_t> some_places(const Support& support, const RandomSubsets& subsets) {
  constexpr std::size_t samples = 64;
  std::size_t total = 0;
  for (const auto& part : support) total += part.size();
  const std::size_t step = std::max<std::size_t>(1, total / samples);
  std::vector<std::uint32_t> places;
  std::size_t next = 0;
  for (std::size_t k = 0; k < support.size(); ++k) {
    for (; next < support[k].size(); next += step) places.push_back(subsets[k].place[support[k][next]]);
    next -= support[k].size();
  }
  return places;
}

/// Reduces the support to its largest component; the cells are those of the component and what touches them.
CellSet keep_largest_component(Support& support, const RandomSubsets& subsets, const Eigen::Vector3d& normal,
                               double distance, const Context& context) {
  PlaneCells cells(normal, distance);
  std::vector<std::vector<std::uint32_t>> cell_of(support.size());
  std::vector<std::size_t> points;
  for (std::size_t k = 0; k < support.size(); ++k) {
    std::vector<Eigen::Vector2f> positions(support[k].size());
    context.parallel_for(positions.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t j = begin; j < end; ++j) positions[j] = cells.position(subsets[k].columns.point(support[k][j]));
    });
    cell_of[k].reserve(support[k].size());
    for (const Eigen::Vector2f& at : positions) {
      const std::uint32_t cell = cells.add(at);
      if (cell == points.size()) points.push_back(0);
      ++points[cell];
      cell_of[k].push_back(cell);
    }
  }
  const std::vector<std::uint32_t> component = cells.components(context);
  std::vector<std::size_t> sizes(component.size(), 0);
  for (std::size_t i = 0; i < component.size(); ++i) sizes[component[i]] += points[i];
  const auto largest = static_cast<std::uint32_t>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
  std::vector<bool> chosen(component.size());
  for (std::size_t i = 0; i < component.size(); ++i) chosen[i] = component[i] == largest;
  CellSet kept = cells.dilated(chosen);
  for (std::uint32_t i = 0; i < chosen.size(); ++i) chosen[i] = chosen[i] || kept.contains(cells.index(i));
  for (std::size_t k = 0; k < support.size(); ++k) {
    std::size_t to = 0;
    for (std::size_t j = 0; j < support[k].size(); ++j) {
      if (chosen[cell_of[k][j]]) support[k][to++] = support[k][j];
    }
    support[k].resize(to);
  }
  return kept;
}

Moments moments_of(const Support& support, const RandomSubsets& subsets) {
  Moments moments;
  for (std::size_t k = 0; k < support.size(); ++k)
    for (const std::uint32_t i : support[k]) moments.add(subsets[k].columns.point(i).cast<double>());
  return moments;
}

Plane refitted(const Moments& moments, const Eigen::Vector3d& side) {
  Plane plane = fit_plane(moments).plane;
  if (plane.normal.dot(side) < 0) plane = {-plane.normal, -plane.offset};
  return plane;
}

}  // namespace

std::optional<FittedPatch> fit_patch(const FloatPlane& plane, const RandomSubsets& subsets, std::size_t part,
                                     const Tolerance& tolerance, const Connectivity& connectivity,
                                     const Context& context) {
  FittedPatch result;
  result.support = subsets.support(plane, tolerance, part, context);
  if (std::all_of(result.support.begin(), result.support.end(), [](const auto& s) { return s.empty(); }))
    return std::nullopt;
  double reach = connectivity.cluster_distance;
  if (reach == 0) reach = connectivity.spacing.reach(some_places(result.support, subsets));
  // Fewer points lie further apart.
  double sampled = 0;
  for (std::size_t k = 0; k < part; ++k) sampled += static_cast<double>(subsets[k].live);
  reach *= std::sqrt(static_cast<double>(subsets.live()) / std::max(1.0, sampled));
  const Eigen::Vector3d normal = plane.normal.cast<double>().normalized();
  result.patch.cells = keep_largest_component(result.support, subsets, normal, reach, context);
  const Moments moments = moments_of(result.support, subsets);
  if (moments.count < 3) return std::nullopt;
  result.points = moments.count;
  result.mean = moments.mean();
  result.patch.plane = refitted(moments, normal);
  return result;
}

}  // namespace atrium::plane
