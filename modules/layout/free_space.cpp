#include "modules/layout/free_space.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "modules/geometry/quantile.hpp"

namespace atrium::layout {
namespace {

constexpr double outliers = 0.001;  // of the points on each side: they do not stretch the grid
constexpr std::size_t most_voxels = std::size_t{1} << 33U;

/// The box of the points but for the outermost.
Eigen::AlignedBox3d inner_box(const Cloud& cloud) {
  Eigen::AlignedBox3d box;
  if (cloud.points.empty()) return {Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones()};
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<float> values;
    values.reserve(cloud.points.size());
    for (const auto& p : cloud.points) values.push_back(p[axis]);
    std::tie(box.min()[axis], box.max()[axis]) = trimmed_range(std::move(values), outliers);
  }
  constexpr double margin = 1.0;
  box.min().array() -= margin;
  box.max().array() += margin;
  return box;
}

/// How many points there are in cubes of 10 cm, larger in a box that is large for its memory, and the 26 around each.
class Density {
 public:
  using Index = Eigen::Array<std::int64_t, 3, 1>;

  Density(const Cloud& cloud, const Eigen::AlignedBox3d& box) : low_(box.min()) {
    constexpr double most_cubes = 1 << 27;
    while ((box.sizes() / edge_).prod() > most_cubes) edge_ *= 2;
    size_ = (box.sizes() / edge_).array().ceil().cast<std::int64_t>() + 2;
    counts_.assign(static_cast<std::size_t>(size_.prod()), 0);
    for (const auto& p : cloud.points)
      if (const auto i = index(p.cast<double>()); i != none) ++counts_[i];
    for (const std::int64_t step : {std::int64_t{1}, size_[0], size_[0] * size_[1]}) add_neighbours(step);
  }
  double edge() const { return edge_; }
  /// 0 outside of the box.
  std::uint32_t around(const Eigen::Vector3d& p) const {
    const std::size_t i = index(p);
    return i == none ? 0 : counts_[i];
  }
  /// What most points have.
  std::uint32_t usual(const Cloud& cloud) const {
    std::vector<std::uint32_t> all;
    all.reserve(cloud.points.size());
    for (const auto& p : cloud.points) all.push_back(around(p.cast<double>()));
    return all.empty() ? 0 : median(std::move(all));
  }

 private:
  static constexpr std::size_t none = ~std::size_t{0};
  std::size_t index(const Eigen::Vector3d& p) const {
    const Index i = ((p - low_) / edge_).array().floor().cast<std::int64_t>() + 1;
    if ((i < 1).any() || (i >= size_ - 1).any()) return none;
    return static_cast<std::size_t>((i[2] * size_[1] + i[1]) * size_[0] + i[0]);
  }
  void add_neighbours(std::int64_t step) {
    std::uint32_t before = 0;
    const auto n = static_cast<std::int64_t>(counts_.size());
    std::vector<std::uint32_t> sums(counts_.size());
    for (std::int64_t i = 0; i < n; ++i) {
      before = i >= step ? counts_[static_cast<std::size_t>(i - step)] : 0;
      const std::uint32_t after = i + step < n ? counts_[static_cast<std::size_t>(i + step)] : 0;
      sums[static_cast<std::size_t>(i)] = before + counts_[static_cast<std::size_t>(i)] + after;
    }
    counts_ = std::move(sums);
  }

  double edge_ = 0.1;
  Eigen::Vector3d low_;
  Index size_{0, 0, 0};
  std::vector<std::uint32_t> counts_;
};

/// How far around a point its surface is to be taken for closed: as far as six points lie around it on average, on a
/// surface that crosses the cubes once. Nothing if the point is nearly alone.
double reach_of(std::uint32_t around, std::uint32_t usual, double edge) {
  constexpr double handful = 6, least_share = 0.1;
  if (around < 2 || around < least_share * usual) return -1;
  return 3 * edge * std::sqrt(handful / (std::numbers::pi * around));
}

}  // namespace

FreeSpace::FreeSpace(const Cloud& cloud, double voxel, const Eigen::AlignedBox3d& region)
    : cloud_(cloud), voxel_(voxel) {
  Eigen::AlignedBox3d box = inner_box(cloud).intersection(region);
  if (box.isEmpty()) box = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones()};
  low_ = box.min();
  const auto cells = [&](double edge) -> Eigen::Array<std::int64_t, 3, 1> {
    return (box.sizes() / edge).array().ceil().cast<std::int64_t>() + 1;
  };
  while (cells(voxel_).cast<double>().prod() > static_cast<double>(most_voxels)) voxel_ *= 2;
  size_ = cells(voxel_);
  buckets_ = cells(bucket_edge);
  occupied_.assign(static_cast<std::size_t>(size_.prod()) / 64 + 1, 0);
  begin_.assign(static_cast<std::size_t>(buckets_.prod()) + 1, 0);
  std::vector<std::uint32_t> inside;
  std::vector<std::size_t> place;
  const Density density(cloud, box);
  const std::uint32_t usual = density.usual(cloud);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Eigen::Vector3d p = cloud.points[i].cast<double>() - low_;
    const Eigen::Array<std::int64_t, 3, 1> v = (p / voxel_).array().floor().cast<std::int64_t>();
    if ((v < 0).any() || (v >= size_).any()) continue;
    if (const double reach = reach_of(density.around(p + low_), usual, density.edge()); reach >= 0)
      occupy(p / voxel_, reach / voxel_);
    const Eigen::Array<std::int64_t, 3, 1> b = (p / bucket_edge).array().floor().cast<std::int64_t>();
    inside.push_back(static_cast<std::uint32_t>(i));
    place.push_back(bucket(b[0], b[1], b[2]));
    ++begin_[place.back() + 1];
  }
  for (std::size_t b = 1; b < begin_.size(); ++b) begin_[b] += begin_[b - 1];
  std::vector<std::uint32_t> next = begin_;
  order_.resize(inside.size());
  for (std::size_t i = 0; i < inside.size(); ++i) order_[next[place[i]]++] = inside[i];
}

/// Place and reach in voxels.
void FreeSpace::occupy(const Eigen::Vector3d& place, double reach) {
  const double half = reach < 1 ? 0 : reach;
  const Eigen::Array<std::int64_t, 3, 1> first = (place.array() - half).floor().cast<std::int64_t>().max(0);
  const Eigen::Array<std::int64_t, 3, 1> last = (place.array() + half).floor().cast<std::int64_t>().min(size_ - 1);
  for (std::int64_t z = first[2]; z <= last[2]; ++z)
    for (std::int64_t y = first[1]; y <= last[1]; ++y)
      for (std::int64_t x = first[0]; x <= last[0]; ++x) {
        if (half > 0 && (Eigen::Array3d(x + 0.5, y + 0.5, z + 0.5) - place.array()).square().sum() > half * half)
          continue;
        const auto index = static_cast<std::size_t>((z * size_[1] + y) * size_[0] + x);
        occupied_[index / 64] |= std::uint64_t{1} << (index % 64);
      }
}

bool FreeSpace::is_occupied(const Eigen::Vector3d& place) const {
  const Eigen::Array<std::int64_t, 3, 1> v = ((place - low_) / voxel_).array().floor().cast<std::int64_t>();
  if ((v < 0).any() || (v >= size_).any()) return false;
  const auto index = static_cast<std::size_t>((v[2] * size_[1] + v[1]) * size_[0] + v[0]);
  return ((occupied_[index / 64] >> (index % 64)) & 1U) != 0;
}

bool FreeSpace::is_free(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
  // In voxels; a step is one voxel long, so that a way passes corners only.
  const Eigen::Vector3d begin = (from - low_) / voxel_;
  const Eigen::Vector3d way = (to - from) / voxel_;
  const int steps = static_cast<int>(std::ceil(way.norm()));
  const Eigen::Vector3d step = way / steps;
  Eigen::Vector3d at = begin;
  for (int i = 0; i < steps; ++i, at += step) {
    const auto x = static_cast<std::int64_t>(at.x()), y = static_cast<std::int64_t>(at.y()),
               z = static_cast<std::int64_t>(at.z());
    if (x < 0 || y < 0 || z < 0 || x >= size_[0] || y >= size_[1] || z >= size_[2]) continue;
    const auto index = static_cast<std::size_t>((z * size_[1] + y) * size_[0] + x);
    if (((occupied_[index / 64] >> (index % 64)) & 1U) != 0) return false;
  }
  return true;
}

}  // namespace atrium::layout
