#include <algorithm>
#include <array>

#include "graph/api/error.hpp"
#include "modules/geometry/point_grid.hpp"
#include "modules/normal/local_plane.hpp"

namespace atrium::normal {
namespace {

constexpr std::size_t max_candidates = 8192;
using Lanes = float __attribute__((vector_size(16)));  // SSE2
using Mask = int __attribute__((vector_size(16)));

Lanes splat(float v) { return Lanes{v, v, v, v}; }
double total(Lanes v) {
  return (static_cast<double>(v[0]) + static_cast<double>(v[1])) +
         (static_cast<double>(v[2]) + static_cast<double>(v[3]));
}

/// The points of a cell's 27 cells, about its centre, as separate coordinates in groups of four.
struct Candidates {
  std::vector<Lanes> x, y, z;

  void gather(const PointGrid& grid, const PointGrid::Cell& cell) {
    const auto around = grid.neighbourhood(cell);
    std::size_t found = 0;
    for (const auto c : around) found += c == PointGrid::none ? 0 : grid.cells()[c].size();
    const std::size_t stride = (found + max_candidates - 1) / max_candidates;
    const Eigen::Vector3d centre = grid.centre(cell);
    const Lanes nowhere = splat(1e18F);  // fills the last group up
    const std::size_t groups = ((found + stride - 1) / stride + 3) / 4;
    x.assign(groups, nowhere);
    y.assign(groups, nowhere);
    z.assign(groups, nowhere);
    std::size_t seen = 0, next = 0;
    for (const auto c : around) {
      if (c == PointGrid::none) continue;
      for (std::uint32_t i = grid.cells()[c].begin; i < grid.cells()[c].end; ++i) {
        if (seen++ % stride != 0) continue;
        const Eigen::Vector3f p = (grid.points()[i].cast<double>() - centre).cast<float>();
        x[next / 4][static_cast<int>(next % 4)] = p.x();
        y[next / 4][static_cast<int>(next % 4)] = p.y();
        z[next / 4][static_cast<int>(next % 4)] = p.z();
        ++next;
      }
    }
  }

  /// Moments about `at` of the candidates within the radius.
  LocalMoments within(const Eigen::Vector3f& at, float radius) const {
    const Lanes limit = splat(radius * radius);
    const Lanes one = splat(1);
    Lanes n{}, sx{}, sy{}, sz{}, xx{}, xy{}, xz{}, yy{}, yz{}, zz{};
    const auto keep = [](Mask mask, Lanes v) { return reinterpret_cast<Lanes>(mask & reinterpret_cast<Mask>(v)); };
    for (std::size_t i = 0; i < x.size(); ++i) {
      Lanes dx = x[i] - at.x();
      Lanes dy = y[i] - at.y();
      Lanes dz = z[i] - at.z();
      const Mask near = dx * dx + dy * dy + dz * dz <= limit;
      dx = keep(near, dx);
      dy = keep(near, dy);
      dz = keep(near, dz);
      n += keep(near, one);
      sx += dx;
      sy += dy;
      sz += dz;
      xx += dx * dx;
      xy += dx * dy;
      xz += dx * dz;
      yy += dy * dy;
      yz += dy * dz;
      zz += dz * dz;
    }
    return {total(n), {total(sx), total(sy), total(sz)}, total(xx), total(xy), total(xz), total(yy), total(yz),
            total(zz)};
  }
};

}  // namespace

std::vector<Eigen::Vector3f> radius_normals(const std::vector<Eigen::Vector3f>& points, double radius,
                                            std::vector<std::uint32_t>& missing, const Context& context) {
  const PointGrid grid(points, radius, context);
  std::vector<Eigen::Vector3f> normals(points.size(), Eigen::Vector3f::UnitZ());
  constexpr std::size_t chunk = 256;
  std::vector<std::vector<std::uint32_t>> lost((grid.cells().size() + chunk - 1) / chunk);
  context.parallel_chunks(grid.cells().size(), chunk, [&](std::size_t c, std::size_t begin, std::size_t end) {
    Candidates candidates;
    for (std::size_t k = begin; k < end; ++k) {
      const PointGrid::Cell& cell = grid.cells()[k];
      candidates.gather(grid, cell);
      const Eigen::Vector3d centre = grid.centre(cell);
      for (std::uint32_t i = cell.begin; i < cell.end; ++i) {
        const Eigen::Vector3f at = (grid.points()[i].cast<double>() - centre).cast<float>();
        const LocalPlane plane = fit(candidates.within(at, static_cast<float>(radius)));
        if (plane.n == 0)
          lost[c].push_back(grid.order()[i]);
        else
          normals[grid.order()[i]] = plane.normal.cast<float>().normalized();
      }
    }
  });
  missing.assign(grid.order().begin() + static_cast<std::ptrdiff_t>(grid.inside()), grid.order().end());
  for (const auto& l : lost) missing.insert(missing.end(), l.begin(), l.end());
  std::sort(missing.begin(), missing.end());
  return normals;
}

}  // namespace atrium::normal
