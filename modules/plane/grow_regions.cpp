#include "modules/plane/grow_regions.hpp"

#include <tbb/parallel_sort.h>
#include <tbb/task_arena.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <span>
#include <utility>

namespace atrium::plane {
namespace {

constexpr std::uint32_t no_region = 0xffffffff;

Plane fit(const Moments& moments) { return fit_plane(moments).plane; }

/// RMS distance of points with these moments from a plane.
double rms_distance(const Moments& moments, const Plane& plane) {
  const auto n = static_cast<double>(moments.count);
  const double sum = plane.normal.dot(moments.sum);
  const double squares =
      plane.normal.dot(moments.products * plane.normal) + 2 * plane.offset * sum + n * plane.offset * plane.offset;
  return std::sqrt(std::max(0.0, squares) / n);
}

/// The neighbours with free points of each voxel that has such: growing asks for them many times.
class NeighbourLists {
 public:
  NeighbourLists(const VoxelGrid& grid, const Context& context)
      : begin_(grid.voxels().size()), end_(begin_.size()), lists_((begin_.size() + chunk_size - 1) / chunk_size) {
    const std::vector<Voxel>& voxels = grid.voxels();
    context.parallel_chunks(begin_.size(), chunk_size, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
      std::vector<std::uint32_t>& list = lists_[chunk];
      for (std::size_t v = begin; v < end; ++v) {
        begin_[v] = static_cast<std::uint32_t>(list.size());
        if (voxels[v].moments.count > 0)
          grid.visit_neighbours(static_cast<std::uint32_t>(v), [&](std::uint32_t other) {
            if (voxels[other].moments.count > 0) list.push_back(other);
          });
        end_[v] = static_cast<std::uint32_t>(list.size());
      }
    });
  }
  std::span<const std::uint32_t> operator[](std::uint32_t voxel) const {
    return {lists_[voxel / chunk_size].data() + begin_[voxel], end_[voxel] - begin_[voxel]};
  }

 private:
  static constexpr std::size_t chunk_size = 2048;
  std::vector<std::uint32_t> begin_, end_;         ///< per voxel, in its chunk's list
  std::vector<std::vector<std::uint32_t>> lists_;  ///< per chunk of voxels
};

class Growth {
 public:
  Growth(const VoxelGrid& grid, const GrowthLimits& limits, std::vector<std::uint32_t>& hopeless,
         const Context& context)
      : grid_(grid),
        neighbours_(grid, context),
        limits_(limits),
        context_(context),
        region_of_(grid.voxels().size(), no_region),
        hopeless_(hopeless) {
    hopeless_.resize(grid.voxels().size(), 0);
  }

  std::vector<Region> run() {
    for (const std::uint32_t seed : seeds()) {
      if (region_of_[seed] != no_region || hopeless_[seed] == grid_.voxels()[seed].moments.count) continue;
      Region region = grow(seed);
      if (region.moments.count >= limits_.min_points) {
        regions_.push_back(std::move(region));
      } else {
        // Seeds that are less flat would reach about the same.
        const bool small = region.moments.count < limits_.min_points / 2;
        for (const std::uint32_t v : region.voxels) {
          region_of_[v] = no_region;
          if (small) hopeless_[v] = static_cast<std::uint32_t>(grid_.voxels()[v].moments.count);
        }
      }
      if (++grown_ % 1024 == 0) context_.check_cancelled();
    }
    return merged();
  }

 private:
  std::vector<std::uint32_t> seeds() const {
    const std::vector<Voxel>& voxels = grid_.voxels();
    std::vector<std::pair<double, std::uint32_t>> order;
    // Few points can lie flat by chance: the residual's uncertainty counts against them.
    for (std::uint32_t i = 0; i < voxels.size(); ++i)
      if (voxels[i].planar)
        order.emplace_back(voxels[i].residual * (1 + 2 / std::sqrt(static_cast<double>(voxels[i].moments.count))), i);
    tbb::this_task_arena::isolate([&] { tbb::parallel_sort(order.begin(), order.end()); });
    std::vector<std::uint32_t> result(order.size());
    for (std::size_t k = 0; k < order.size(); ++k) result[k] = order[k].second;
    return result;
  }

  bool fits(const Voxel& voxel, const Plane& plane) const {
    if (voxel.planar && std::abs(voxel.normal.dot(plane.normal)) < limits_.min_cosine) return false;
    return rms_distance(voxel.moments, plane) <= limits_.distance;
  }

  void take(Region& region, std::uint32_t voxel, std::uint32_t number) {
    region_of_[voxel] = number;
    region.voxels.push_back(voxel);
    region.moments += grid_.voxels()[voxel].moments;
  }

  Region grow(std::uint32_t seed) {
    const auto number = static_cast<std::uint32_t>(regions_.size());
    Region region;
    take(region, seed, number);
    region.plane = {grid_.voxels()[seed].normal, 0};
    region.plane.offset = -region.plane.normal.dot(region.moments.mean());
    // A seed's plane is tilted by the noise: what it turned down may fit the plane of the grown region.
    for (bool settled = false; !settled;) {
      const std::size_t before = region.voxels.size();
      const Plane used = spread(region, number);
      region.plane = fit(region.moments);
      settled = region.voxels.size() == before || nearly_same(region, used);
    }
    return region;
  }

  /// Whether the region's plane and an earlier one differ by much less than the limit, all over the region.
  bool nearly_same(const Region& region, const Plane& used) const {
    const PlaneFit now = fit_plane(region.moments);
    const double radius = 2 * std::sqrt(now.variances[2]);
    const double sine = now.plane.normal.cross(used.normal).norm();
    return sine * radius + std::abs(used.signed_distance(now.mean)) < limits_.distance / 8;
  }

  /// Takes all voxels that can be reached; returns the last plane that was used for it.
  Plane spread(Region& region, std::uint32_t number) {
    std::size_t next_fit = std::max<std::size_t>(4, region.voxels.size() + region.voxels.size() / 2);
    const auto look_at = [&](std::uint32_t v) {
      if (region_of_[v] == number) return;
      if (region_of_[v] == no_region && fits(grid_.voxels()[v], region.plane))
        take(region, v, number);
      else
        region.border.push_back(v);
    };
    const auto refit = [&] {
      if (region.voxels.size() < next_fit) return;
      region.plane = fit(region.moments);
      next_fit = region.voxels.size() + region.voxels.size() / 2;
    };
    // What was reached before has no other neighbours than what stands at the border.
    for (const std::uint32_t v : std::exchange(region.border, {})) {
      look_at(v);
      refit();
    }
    for (; region.spread < region.voxels.size(); ++region.spread) {
      for (const std::uint32_t v : neighbours_[region.voxels[region.spread]]) look_at(v);
      refit();
    }
    return region.plane;
  }

  /// Joins regions that touch and are one plane: growing from one seed can stop where another region was first.
  std::vector<Region> merged() {
    std::set<std::pair<std::uint32_t, std::uint32_t>> touching;
    for (std::uint32_t a = 0; a < regions_.size(); ++a) {
      std::vector<bool> met(regions_.size(), false);
      for (const std::uint32_t v : regions_[a].border)
        if (region_of_[v] != no_region) met[region_of_[v]] = true;
      for (std::uint32_t b = 0; b < regions_.size(); ++b)
        if (met[b] && a != b) touching.emplace(std::min(a, b), std::max(a, b));
    }
    std::vector<std::uint32_t> into(regions_.size());
    std::iota(into.begin(), into.end(), 0U);
    const auto root = [&](std::uint32_t i) {
      while (into[i] != i) i = into[i] = into[into[i]];
      return i;
    };
    for (const auto& [a, b] : touching) {
      const std::uint32_t i = std::min(root(a), root(b));
      const std::uint32_t j = std::max(root(a), root(b));
      if (i != j && one_plane(regions_[i], regions_[j])) absorb(i, j, into);
    }
    std::vector<Region> result;
    for (std::uint32_t i = 0; i < regions_.size(); ++i)
      if (into[i] == i) result.push_back(std::move(regions_[i]));
    std::stable_sort(result.begin(), result.end(),
                     [](const Region& a, const Region& b) { return a.moments.count > b.moments.count; });
    return result;
  }

  bool one_plane(const Region& a, const Region& b) const {
    if (std::abs(a.plane.normal.dot(b.plane.normal)) < limits_.min_cosine) return false;
    Moments both = a.moments;
    both += b.moments;
    const Plane plane = fit(both);
    const auto still_fits = [&](const Region& r) {
      return rms_distance(r.moments, plane) <= 1.3 * rms_distance(r.moments, r.plane) + 0.1 * limits_.distance;
    };
    return still_fits(a) && still_fits(b);
  }

  void absorb(std::uint32_t i, std::uint32_t j, std::vector<std::uint32_t>& into) {
    into[j] = i;
    Region& a = regions_[i];
    Region& b = regions_[j];
    a.voxels.insert(a.voxels.end(), b.voxels.begin(), b.voxels.end());
    a.border.insert(a.border.end(), b.border.begin(), b.border.end());
    a.moments += b.moments;
    a.plane = fit(a.moments);
    b.voxels.clear();
  }

  const VoxelGrid& grid_;
  NeighbourLists neighbours_;
  GrowthLimits limits_;
  const Context& context_;
  std::vector<std::uint32_t> region_of_;
  std::vector<std::uint32_t>& hopeless_;
  std::vector<Region> regions_;
  std::size_t grown_ = 0;
};

}  // namespace

std::vector<Region> grow_regions(const VoxelGrid& grid, const GrowthLimits& limits,
                                 std::vector<std::uint32_t>& hopeless, const Context& context) {
  return Growth(grid, limits, hopeless, context).run();
}

}  // namespace atrium::plane
