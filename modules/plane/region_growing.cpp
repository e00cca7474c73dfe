#include "modules/plane/region_growing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "graph/api/text.hpp"
#include "modules/geometry/quantile.hpp"
#include "modules/plane/assignment.hpp"
#include "modules/plane/grow_regions.hpp"
#include "modules/plane/local_spacing.hpp"
#include "modules/plane/region_patches.hpp"
#include "modules/plane/seen_side.hpp"

namespace atrium::plane {
namespace {

constexpr std::uint32_t least_level = 2;  // of a voxel above the order's cells
constexpr std::uint32_t coarsest_level = 8;
constexpr double distance_per_residual = 2.5;
constexpr double voxel_per_noise = 4;  // a voxel's points must show which way its plane lies

struct Settings {
  std::uint32_t level = least_level;
  double cell = 0;  ///< edge of the order's cells, metres
  VoxelGrid::Planarity planarity;
  GrowthLimits limits;
};

/// The finest level, from voxels of the least size on, at which half of the points share their voxel with enough others
/// for a plane.
std::uint32_t automatic_level(const MortonOrder& order) {
  constexpr std::size_t enough = 5;
  for (std::uint32_t level = least_level; level < coarsest_level; ++level) {
    std::size_t together = 0;
    std::size_t begin = 0;
    for (std::size_t i = 1; i <= order.codes.size(); ++i) {
      if (i < order.codes.size() && (order.codes[i] ^ order.codes[begin]) >> (3 * level) == 0) continue;
      if (i - begin >= enough) together += i - begin;
      begin = i;
    }
    if (2 * together >= order.codes.size()) return level;
  }
  return coarsest_level;
}

/// The noise, as the neighbourhoods of flat voxels show it: a voxel alone can cut it in half. Their median residual
/// where voxels are fine. Where they are coarse, many such neighbourhoods hold both faces of a wall: their lower
/// quartile, or twice the voxels' own median residual where that is far less. (Noise that fills voxels shows in them,
/// too: in blurred maps the quartile is twice the voxels' own median; where walls are thin, 10 times or more.)
double noise_of(const VoxelGrid& grid, bool fine) {
  constexpr std::size_t samples = 1000;
  constexpr std::size_t enough = 6;     // points of a voxel
  constexpr double alone = 2, far = 4;  // times the voxels' own
  std::vector<std::uint32_t> flat;
  std::vector<double> own;
  for (std::uint32_t i = 0; i < grid.voxels().size(); ++i) {
    if (!grid.voxels()[i].planar) continue;
    flat.push_back(i);
    if (grid.voxels()[i].moments.count >= enough) own.push_back(grid.voxels()[i].residual);
  }
  if (flat.empty()) return 0;
  std::vector<double> residuals;
  residuals.reserve(2 * samples);
  for (std::size_t k = 0; k < flat.size(); k += std::max<std::size_t>(1, flat.size() / samples)) {
    Moments moments = grid.voxels()[flat[k]].moments;
    grid.visit_neighbours(flat[k], [&](std::uint32_t other) { moments += grid.voxels()[other].moments; });
    residuals.push_back(std::sqrt(fit_plane(moments).variances[0]));
  }
  if (fine) return ranked(residuals, residuals.size() / 2);
  const double around = ranked(residuals, residuals.size() / 4);
  if (4 * own.size() < flat.size() || own.empty()) return around;
  const double median_alone = ranked(own, own.size() / 2);
  return around > far * median_alone ? alone * median_alone : around;
}

/// Half of the points that a surface of this area holds where the scan is sparse.
std::size_t points_of(double area, const LocalSpacing& spacing) {
  constexpr double sparse = 0.75;
  constexpr std::size_t least = 50;
  const double step = std::max(0.001, spacing.quantile(sparse));
  return std::max(least, static_cast<std::size_t>(0.5 * area / (step * step)));
}

/// What is known of an order's voxels from one pass to the next.
struct KnownVoxels {
  std::optional<VoxelGrid> grid;
  std::vector<std::uint32_t> hopeless;
};

/// The patches among the points that have no owner yet.
std::vector<Patch> find_patches(const MortonOrder& order, const LocalSpacing& spacing,
                                const std::vector<std::int32_t>& owner, KnownVoxels& known, const Settings& settings,
                                double cluster_distance, const Context& context) {
  if (known.grid)
    known.grid->update(order, owner, settings.planarity, context);
  else
    known.grid.emplace(order, settings.cell, settings.level, owner, settings.planarity, context);
  const VoxelGrid& grid = *known.grid;
  const std::vector<Region> regions = grow_regions(grid, settings.limits, known.hopeless, context);
  const RegionPatches splitter{order, grid, owner, spacing, cluster_distance, settings.limits};
  std::vector<std::vector<Patch>> found(regions.size());
  context.parallel_chunks(regions.size(), 1, [&](std::size_t i, std::size_t, std::size_t) {
    found[i] = splitter.patches(regions[i], context);
  });
  std::vector<Patch> patches;
  for (auto& part : found) std::move(part.begin(), part.end(), std::back_inserter(patches));
  return patches;
}

/// The voxels moved by a share of their edge: the faces of a wall that share voxels at one place do not at another.
class Shifted {
 public:
  Shifted(const Cloud& cloud, const MortonOrder& order, const Settings& settings, double share, const Context& context)
      : order_(cloud, settings.cell, context, MortonOrder::Normals::no, settings.cell * (1U << settings.level) * share),
        spacing_(order_, context) {
    place_.resize(cloud.size());
    for (std::uint32_t i = 0; i < order.index.size(); ++i) place_[order.index[i]] = i;
  }

  std::vector<Patch> find(const std::vector<std::int32_t>& owner, const Settings& settings, double cluster_distance,
                          const Context& context) {
    std::vector<std::int32_t> moved(owner.size());
    for (std::size_t i = 0; i < moved.size(); ++i) moved[i] = owner[place_[order_.index[i]]];
    return find_patches(order_, spacing_, moved, known_, settings, cluster_distance, context);
  }

 private:
  MortonOrder order_;
  LocalSpacing spacing_;
  KnownVoxels known_;
  std::vector<std::uint32_t> place_;  ///< in the unshifted order, of each point of the cloud
};

/// The distance of points from their planes, and voxels wide enough to show which way a plane lies. Returns the voxels
/// that were measured for it, if they are.
std::optional<VoxelGrid> derive_from_noise(const MortonOrder& order, const std::vector<std::int32_t>& owner,
                                           const RegionGrowing::Params& params, Settings& settings,
                                           const Context& context) {
  const std::uint32_t level = settings.level;
  settings.planarity.max_residual = settings.cell * (1U << least_level);
  std::optional<VoxelGrid> grid(std::in_place, order, settings.cell, level, owner, settings.planarity, context);
  const double noise = noise_of(*grid, level == least_level);
  context.info(
      fmt::format("noise {:.1f} mm, voxels of {:.0f} mm", 1000 * noise, 1000 * settings.cell * (1U << settings.level)));
  settings.limits.distance = std::max({distance_per_residual * noise, params.min_distance, 1e-6});
  while (params.voxel_size == 0 && settings.level < coarsest_level &&
         settings.cell * (1U << settings.level) < voxel_per_noise * noise)
    ++settings.level;
  if (settings.level != level || settings.limits.distance > settings.planarity.max_residual) return {};
  grid->limit_residual(settings.limits.distance);
  return grid;
}

void report(const SeenSides& sides, std::size_t planes, const Context& context) {
  context.info(fmt::format("sides told by positions for {}, by free space for {}, by normals for {}",
                           counted(sides.by_positions, "plane"), sides.by_free_space, sides.by_normals));
  if (2 * sides.turned_against_normals > planes)
    context.warn(fmt::format(
        "the normals of {} of {} planes look to the side from which they were not seen: only their axes are used",
        sides.turned_against_normals, planes));
}

PlanePrimitives grown(const Input<Cloud>& input, const RegionGrowing::Params& params, const Context& context) {
  const Cloud& cloud = *input;
  Settings settings;
  settings.cell = (params.voxel_size > 0 ? params.voxel_size : params.min_voxel_size) / (1U << least_level);
  const MortonOrder order(cloud, settings.cell, context);
  const LocalSpacing spacing(order, context);
  if (params.voxel_size == 0) settings.level = automatic_level(order);
  Assignment assignment(cloud.size());
  const std::vector<std::int32_t>& owner = assignment.owner;
  GrowthLimits& limits = settings.limits;
  limits.distance = params.distance;
  KnownVoxels known_voxels;
  if (params.distance == 0) known_voxels.grid = derive_from_noise(order, owner, params, settings, context);
  settings.planarity.max_residual = limits.distance;
  limits.min_cosine = std::cos(params.angle * std::numbers::pi / 180);
  limits.min_area = params.min_area;
  limits.min_points = params.min_points > 0 ? static_cast<std::size_t>(std::max(3, params.min_points))
                                            : points_of(params.min_area, spacing);

  const PointOctree octree(order.columns, order.codes, octree_leaf_size, context);
  constexpr float any_normal = -2;
  const Tolerance tolerance{static_cast<float>(limits.distance), any_normal};
  std::vector<Patch> patches;
  const bool alternate = settings.level > least_level;  // finer voxels are thinner than walls
  // By half an edge first, then by quarters: the faces of a wall as thin as that stand in different voxels once.
  constexpr std::array<double, 5> shifts{0, 0.5, 0, 0.25, 0.75};
  std::array<std::optional<Shifted>, shifts.size()> shifted;
  const std::int64_t passes =
      alternate ? std::max<std::int64_t>(params.passes, static_cast<std::int64_t>(shifts.size())) : params.passes;
  for (std::int64_t pass = 0; pass < passes; ++pass) {
    const std::size_t turn = alternate ? static_cast<std::size_t>(pass) % shifts.size() : 0;
    if (shifts[turn] > 0 && !shifted[turn]) shifted[turn].emplace(cloud, order, settings, shifts[turn], context);
    std::vector<Patch> found = shifts[turn] > 0 ? shifted[turn]->find(owner, settings, params.cluster_distance, context)
                                                : find_patches(order, spacing, owner, known_voxels, settings,
                                                               params.cluster_distance, context);
    context.progress((static_cast<double>(pass) + 1) / (static_cast<double>(passes) + 1));
    if (found.empty() && !alternate) break;
    const std::size_t known = patches.size();
    std::move(found.begin(), found.end(), std::back_inserter(patches));
    assignment.add(order, octree, patches, known, tolerance, context);
  }
  return fit_primitives(input, order, owner, patches, limits.min_points, context);
}

}  // namespace

RegionGrowing::Out RegionGrowing::run(const In& in, const Params& params, Context& context) {
  if (in.cloud->size() < 3)
    throw Error("a plane needs at least 3 points, the cloud has " + std::to_string(in.cloud->size()),
                "look at what the nodes before this one have filtered away");
  PlanePrimitives planes = grown(in.cloud, params, context);
  if (params.max_planes > 0 && planes.primitives.size() > static_cast<std::size_t>(params.max_planes))
    planes.primitives.resize(static_cast<std::size_t>(params.max_planes));
  report(turn_to_seen_sides(planes, context), planes.primitives.size(), context);
  return {std::move(planes)};
}

}  // namespace atrium::plane
