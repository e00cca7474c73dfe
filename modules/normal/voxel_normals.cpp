#include <algorithm>
#include <array>
#include <cmath>

#include "modules/geometry/point_grid.hpp"
#include "modules/geometry/quantile.hpp"
#include "modules/normal/local_plane.hpp"

namespace atrium::normal {
namespace {

// In units of the noise's variance.
constexpr double one_plane = 2.0;  ///< a neighbourhood that lies in one plane
constexpr double lies_in = 3.0;    ///< a voxel whose points lie in a plane
constexpr double mixed = 4.0;      ///< a voxel whose points do not

using Around = std::array<std::uint32_t, 27>;

class Voxels {
 public:
  Voxels(const PointGrid& grid, const Context& context)
      : grid_(grid), context_(context), moments_(grid.cells().size()) {
    each([&](std::size_t v) {
      const Eigen::Vector3d centre = grid_.centre(grid_.cells()[v]);
      for (std::uint32_t i = grid_.cells()[v].begin; i < grid_.cells()[v].end; ++i)
        moments_[v].add(grid_.points()[i].cast<double>() - centre);
    });
  }

  /// A plane per voxel over its 27 voxels.
  void fit_neighbourhoods() {
    planes_.resize(moments_.size());
    each([&](std::size_t v) {
      LocalMoments sum;
      const Around around = grid_.neighbourhood(grid_.cells()[v]);
      for (std::size_t u = 0; u < 27; ++u)
        if (around[u] != PointGrid::none) sum.add_shifted(moments_[around[u]], offset(u));
      planes_[v] = fit(sum);
    });
    noise_ = measure_noise();
  }

  /// Where a neighbourhood is not one plane, takes the neighbours' plane that fits the voxel best, refitted.
  void sharpen() {
    std::vector<LocalPlane> sharp = planes_;
    each([&](std::size_t v) {
      if (planes_[v].n > 0 && planes_[v].residual <= one_plane * noise_) return;
      const Around around = grid_.neighbourhood(grid_.cells()[v]);
      LocalPlane best = planes_[v];
      double least = best.n > 0 ? moments_[v].mean_square_distance(best.normal, best.offset) + best.residual
                                : std::numeric_limits<double>::infinity();
      for (std::size_t u = 0; u < 27; ++u) {
        if (around[u] == PointGrid::none || planes_[around[u]].n == 0) continue;
        const LocalPlane plane = seen_from_middle(planes_[around[u]], u);
        const double cost = moments_[v].mean_square_distance(plane.normal, plane.offset) + plane.residual;
        if (cost < least) {
          least = cost;
          best = plane;
        }
      }
      sharp[v] = refit(best, around);
    });
    planes_ = std::move(sharp);
  }

  /// The normal of each point of a voxel; false if there is none.
  bool assign(std::size_t v, std::vector<Eigen::Vector3f>& normals) const {
    const LocalPlane& own = planes_[v];
    const PointGrid::Cell& cell = grid_.cells()[v];
    if (own.n == 0) return false;
    const Eigen::Vector3f normal = unit(own);
    if (moments_[v].mean_square_distance(own.normal, own.offset) <= mixed * noise_) {
      for (std::uint32_t i = cell.begin; i < cell.end; ++i) normals[grid_.order()[i]] = normal;
      return true;
    }
    assign_mixed(v, normals);
    return true;
  }

 private:
  template <class Work>
  void each(const Work& work) const {
    context_.parallel_for(
        moments_.size(),
        [&](std::size_t begin, std::size_t end) {
          for (std::size_t v = begin; v < end; ++v) work(v);
        },
        1024);
  }

  /// From the middle of a neighbourhood to its u-th voxel.
  Eigen::Vector3d offset(std::size_t u) const {
    const auto n = static_cast<int>(u);
    return grid_.cell_size() * Eigen::Vector3i(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1).cast<double>();
  }
  LocalPlane seen_from_middle(LocalPlane plane, std::size_t u) const {
    plane.offset -= plane.normal.dot(offset(u));
    return plane;
  }
  static Eigen::Vector3f unit(const LocalPlane& plane) { return plane.normal.cast<float>().normalized(); }

  /// The variance of points about their plane: low among the neighbourhoods', most of which hold no edge.
  double measure_noise() const {
    std::vector<double> residuals;
    for (const auto& p : planes_)
      if (p.n >= 8) residuals.push_back(p.residual);
    const double least = std::pow(1e-3 * grid_.cell_size(), 2);
    if (residuals.empty()) return least;
    return std::max(least, ranked(residuals, residuals.size() / 3));
  }

  LocalPlane refit(const LocalPlane& plane, const Around& around) const {
    if (plane.n == 0) return plane;
    LocalMoments sum;
    for (std::size_t u = 0; u < 27; ++u) {
      if (around[u] == PointGrid::none) continue;
      const LocalMoments& m = moments_[around[u]];
      if (m.mean_square_distance(plane.normal, plane.offset + plane.normal.dot(offset(u))) <= lies_in * noise_)
        sum.add_shifted(m, offset(u));
    }
    const LocalPlane better = fit(sum);
    return better.n > 0 && better.residual <= plane.residual ? better : plane;
  }

  void assign_mixed(std::size_t v, std::vector<Eigen::Vector3f>& normals) const {
    const PointGrid::Cell& cell = grid_.cells()[v];
    const Around around = grid_.neighbourhood(cell);
    std::array<LocalPlane, 27> planes{planes_[v]};
    std::size_t count = 1;
    for (std::size_t u = 0; u < 27; ++u) {
      if (u == 13 || around[u] == PointGrid::none) continue;
      const LocalPlane& plane = planes_[around[u]];
      if (plane.n > 0 && plane.residual <= one_plane * noise_) planes[count++] = seen_from_middle(plane, u);
    }
    const Eigen::Vector3d centre = grid_.centre(cell);
    for (std::uint32_t i = cell.begin; i < cell.end; ++i) {
      const Eigen::Vector3d at = grid_.points()[i].cast<double>() - centre;
      std::size_t best = 0;
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < count; ++k) {
        const double distance = std::abs(planes[k].normal.dot(at) + planes[k].offset);
        if (distance >= least) continue;
        least = distance;
        best = k;
      }
      normals[grid_.order()[i]] = unit(planes[best]);
    }
  }

  const PointGrid& grid_;
  const Context& context_;
  std::vector<LocalMoments> moments_;  // about the voxels' centres
  std::vector<LocalPlane> planes_;     // likewise
  double noise_ = 0;                   // variance, metres²
};

}  // namespace

std::vector<Eigen::Vector3f> voxel_normals(const std::vector<Eigen::Vector3f>& points, double voxel,
                                           std::vector<std::uint32_t>& missing, const Context& context) {
  const PointGrid grid(points, voxel, context);
  Voxels voxels(grid, context);
  voxels.fit_neighbourhoods();
  voxels.sharpen();
  std::vector<Eigen::Vector3f> normals(points.size(), Eigen::Vector3f::UnitZ());
  std::vector<std::uint8_t> lost(grid.cells().size(), 0);
  context.parallel_for(
      grid.cells().size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) lost[v] = voxels.assign(v, normals) ? 0 : 1;
      },
      1024);
  missing.assign(grid.order().begin() + static_cast<std::ptrdiff_t>(grid.inside()), grid.order().end());
  for (std::size_t v = 0; v < lost.size(); ++v)
    if (lost[v] != 0)
      for (std::uint32_t i = grid.cells()[v].begin; i < grid.cells()[v].end; ++i) missing.push_back(grid.order()[i]);
  std::sort(missing.begin(), missing.end());
  return normals;
}

}  // namespace atrium::normal
