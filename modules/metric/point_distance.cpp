#include "modules/metric/point_distance.hpp"

#include <algorithm>
#include <cmath>

namespace atrium::metric {
namespace {

constexpr std::size_t cells_per_chunk = 64;
constexpr std::size_t max_candidates = 24;  // above this, a search per point is faster
constexpr std::uint32_t few_points = 4;

}  // namespace

std::vector<float> distances_to_mesh(const PointGrid& grid, const TriangleTree& tree, const Context& context) {
  const auto& points = grid.points();
  std::vector<float> distances(points.size());
  const auto search = [&](std::size_t begin, std::size_t end, std::uint32_t hint) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto found = tree.nearest(points[i].cast<double>(), std::numeric_limits<double>::infinity(), hint);
      hint = found.triangle;
      distances[i] = static_cast<float>(std::sqrt(found.squared_distance));
    }
  };
  // A point of the cell is at most `half` from its middle: the nearest triangle of any is within two halves more. The
  // points were rounded to their cell in single precision, hence a little more.
  const double half = std::sqrt(0.75) * grid.cell_size() * 1.001;
  const auto& cells = grid.cells();
  context.parallel_chunks(cells.size(), cells_per_chunk, [&](std::size_t, std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t> candidates;
    std::uint32_t hint = TriangleTree::none;
    for (std::size_t c = begin; c < end; ++c) {
      const auto& cell = cells[c];
      const Eigen::Vector3d centre = grid.centre(cell);
      const auto nearest = tree.nearest(centre, std::numeric_limits<double>::infinity(), hint);
      hint = nearest.triangle;
      if (cell.size() < few_points) {
        search(cell.begin, cell.end, hint);
        continue;
      }
      candidates.clear();
      tree.within(centre, std::pow(std::sqrt(nearest.squared_distance) + 2 * half, 2), candidates);
      if (candidates.size() > max_candidates) {
        search(cell.begin, cell.end, hint);
        continue;
      }
      for (std::uint32_t i = cell.begin; i < cell.end; ++i) {
        const Eigen::Vector3d p = points[i].cast<double>();
        double best = std::numeric_limits<double>::infinity();
        for (const auto t : candidates) best = std::min(best, tree.squared_distance(t, p));
        distances[i] = static_cast<float>(std::sqrt(best));
      }
    }
  });
  context.parallel_for(points.size() - grid.inside(), [&](std::size_t begin, std::size_t end) {
    search(grid.inside() + begin, grid.inside() + end, TriangleTree::none);
  });
  return distances;
}

CloudSearch::CloudSearch(const PointGrid& grid, const Context& context) : grid_(grid) {
  const auto& cells = grid.cells();
  buckets_.resize(cells.size() + grid.points().size() - grid.inside());
  context.parallel_for(
      buckets_.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t b = begin; b < end; ++b) {
          // What lies in no cell is a bucket of its own.
          const auto lone = static_cast<std::uint32_t>(grid.inside() + b - std::min(b, cells.size()));
          Bucket bucket{{}, {}, b < cells.size() ? cells[b].begin : lone, b < cells.size() ? cells[b].end : lone + 1};
          bucket.low = bucket.high = grid.points()[bucket.begin];
          for (std::uint32_t i = bucket.begin; i < bucket.end; ++i) {
            bucket.low = bucket.low.cwiseMin(grid.points()[i]);
            bucket.high = bucket.high.cwiseMax(grid.points()[i]);
          }
          buckets_[b] = bucket;
        }
      },
      256);
  std::vector<Eigen::Vector3f> middles;
  middles.reserve(buckets_.size());
  for (const auto& b : buckets_) {
    middles.emplace_back((b.low + b.high) / 2);
    reach_ = std::max(reach_, (b.high - middles.back()).norm());
  }
  reach_ *= 1.0001F;
  middles_ = PointTree(middles, context);
}

double CloudSearch::nearest(const Eigen::Vector3d& position) const {
  const Eigen::Vector3f p = position.cast<float>();
  thread_local std::vector<Neighbour> found;
  Neighbour first{};
  if (!middles_.nearest(p, first)) return std::numeric_limits<double>::infinity();
  double best = std::numeric_limits<double>::infinity();
  const auto scan = [&](const Bucket& bucket) {
    const double box = ((bucket.low - p).cwiseMax(p - bucket.high).cwiseMax(0.0F)).cast<double>().squaredNorm();
    if (box * (1 - 1e-5) > best) return;
    for (std::uint32_t i = bucket.begin; i < bucket.end; ++i)
      best = std::min(best, (grid_.points()[i].cast<double>() - position).squaredNorm());
  };
  scan(buckets_[first.index]);
  // A bucket with a nearer point has its middle within that distance and its own reach.
  middles_.within(p, (static_cast<float>(std::sqrt(best)) + reach_) * 1.0001F, found);
  std::sort(found.begin(), found.end());
  for (const auto& f : found)
    if (f.index != first.index) scan(buckets_[f.index]);
  return std::sqrt(best);
}

}  // namespace atrium::metric
