#include "modules/plane/region_patches.hpp"

#include <algorithm>
#include <cmath>

#include "modules/plane/plane_cells.hpp"

namespace atrium::plane {

RegionPatches::Support RegionPatches::support(const Region& region) const {
  std::vector<std::uint32_t> near = region.voxels;
  near.insert(near.end(), region.border.begin(), region.border.end());
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  Support support;
  std::size_t band = 0;
  for (const std::uint32_t v : near) {
    const Voxel& voxel = grid.voxels()[v];
    for (std::uint32_t i = voxel.begin; i < voxel.end; ++i) {
      if (owner[i] >= 0) continue;
      const double d = std::abs(region.plane.signed_distance(order.columns.point(i).cast<double>()));
      if (d <= 3 * limits.distance) ++band;
      if (d <= limits.distance) support.places.push_back(i);
    }
  }
  support.share = static_cast<double>(support.places.size()) / static_cast<double>(std::max<std::size_t>(1, band));
  return support;
}

std::vector<Patch> RegionPatches::patches(const Region& region, const Context& context) const {
  const auto [places, share] = support(region);
  // Spread evenly through space, a third would lie in the slab, at an RMS distance of 0.58 of its half width.
  const bool diffuse = share < 0.6;
  const double reach = cluster_distance > 0 ? cluster_distance : spacing.reach(places);
  PlaneCells cells(region.plane.normal, reach);
  std::vector<std::uint32_t> cell_of;
  cell_of.reserve(places.size());
  for (const std::uint32_t i : places) cell_of.push_back(cells.add(order.columns.point(i)));
  const std::vector<std::uint32_t> component = cells.components(context);

  std::vector<std::size_t> size(component.size(), 0);  // in cells
  for (const std::uint32_t c : component) ++size[c];
  std::vector<std::vector<std::uint32_t>> members(component.size());
  for (std::size_t k = 0; k < places.size(); ++k) members[component[cell_of[k]]].push_back(places[k]);
  std::vector<Patch> result;
  for (std::uint32_t c = 0; c < members.size(); ++c) {
    if (members[c].size() < limits.min_points) continue;
    if (static_cast<double>(size[c]) * cells.cell_area() < limits.min_area) continue;
    Moments moments;
    for (const std::uint32_t i : members[c]) moments.add(order.columns.point(i).cast<double>());
    const PlaneFit fit = fit_plane(moments);
    if (fit.variances[1] < 4 * fit.variances[0]) continue;  // a strip as narrow as the noise is no surface
    if (diffuse && std::sqrt(fit.variances[0]) > 0.5 * limits.distance) continue;
    std::vector<bool> chosen(component.size());
    for (std::size_t k = 0; k < chosen.size(); ++k) chosen[k] = component[k] == c;
    result.push_back({fit.plane, cells.dilated(chosen)});
  }
  return result;
}

}  // namespace atrium::plane
