#include "modules/plane/random_subsets.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "graph/api/random.hpp"

namespace atrium::plane {
namespace {

constexpr double first_subset = 4096;
constexpr double growth = 8;
constexpr std::size_t subset_chunk = 65536;
constexpr std::uint8_t no_subset = 255;

/// Writes which points of the range support the plane; returns how many.
std::uint32_t collect(const PointColumns& c, std::uint32_t begin, std::uint32_t end, const FloatPlane& plane,
                      const Tolerance& tolerance, std::uint32_t* hits) {
  const Eigen::Vector3f n = plane.normal;
  std::uint32_t count = 0;
  for (std::uint32_t i = begin; i < end; ++i) {
    const float d = std::abs(n.x() * c.x[i] + n.y() * c.y[i] + n.z() * c.z[i] + plane.offset);
    const float cosine = n.x() * c.nx[i] + n.y() * c.ny[i] + n.z() * c.nz[i];
    hits[count] = i;
    count += static_cast<std::uint32_t>(d <= tolerance.distance) &
             static_cast<std::uint32_t>(cosine >= tolerance.min_cosine);
  }
  return count;
}

std::uint32_t count_range(const PointColumns& c, std::uint32_t begin, std::uint32_t end, const FloatPlane& plane,
                          const Tolerance& tolerance) {
  const float a = plane.normal.x();
  const float b = plane.normal.y();
  const float g = plane.normal.z();
  const float* x = c.x.data();
  const float* y = c.y.data();
  const float* z = c.z.data();
  const float* nx = c.nx.data();
  const float* ny = c.ny.data();
  const float* nz = c.nz.data();
  std::uint32_t sum = 0;
  for (std::uint32_t i = begin; i < end; ++i) {
    const float d = std::abs(a * x[i] + b * y[i] + g * z[i] + plane.offset);
    const float cosine = a * nx[i] + b * ny[i] + g * nz[i];
    sum += static_cast<std::uint32_t>(d <= tolerance.distance) &
           static_cast<std::uint32_t>(cosine >= tolerance.min_cosine);
  }
  return sum;
}

/// Cumulative shares of the free points up to each subset.
std::vector<double> subset_shares(double live) {
  std::vector<double> shares;
  for (double size = first_subset; 2 * size < live; size *= growth) shares.push_back(size / live);
  shares.push_back(1);
  return shares;
}

/// Which subset each free point goes to, and where each chunk of points writes its own in each subset.
struct Division {
  std::vector<std::uint8_t> target;                 ///< per point: its subset, or none
  std::vector<std::vector<std::uint32_t>> offsets;  ///< per chunk and subset
  std::vector<std::uint32_t> sizes;                 ///< per subset
};

template <class IsFree>
Division divide(std::size_t total, const std::vector<double>& shares, std::uint64_t seed, IsFree is_free,
                const Context& context) {
  Division d;
  d.target.assign(total, no_subset);
  d.offsets.assign((total + subset_chunk - 1) / subset_chunk, std::vector<std::uint32_t>(shares.size(), 0));
  d.sizes.assign(shares.size(), 0);
  context.parallel_chunks(total, subset_chunk, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!is_free(i)) continue;
      const double u = static_cast<double>(mix_seed(seed, i) >> 11U) * 0x1.0p-53;
      std::uint8_t k = 0;
      while (u >= shares[k] && k + 1U < shares.size()) ++k;
      d.target[i] = k;
      ++d.offsets[chunk][k];
    }
  });
  for (auto& chunk : d.offsets)
    for (std::size_t k = 0; k < d.sizes.size(); ++k) {
      const std::uint32_t count = chunk[k];
      chunk[k] = d.sizes[k];
      d.sizes[k] += count;
    }
  return d;
}

}  // namespace

std::uint32_t RandomSubset::count(const FloatPlane& plane, const Tolerance& tolerance) const {
  if (octree.nodes().empty()) return 0;
  std::uint32_t sum = 0;
  octree.visit_slab(0, plane, tolerance.distance, [&](std::uint32_t begin, std::uint32_t end) {
    sum += count_range(columns, begin, end, plane, tolerance);
  });
  return sum;
}

Moments RandomSubset::moments(const FloatPlane& plane, const Tolerance& tolerance) const {
  Moments sum;
  if (octree.nodes().empty()) return sum;
  std::array<std::uint32_t, octree_leaf_size> hits;
  octree.visit_slab(0, plane, tolerance.distance, [&](std::uint32_t begin, std::uint32_t end) {
    // Leaves of many points in one place can be larger than octree_leaf_size.
    for (; begin < end; begin += octree_leaf_size) {
      const std::uint32_t count =
          collect(columns, begin, std::min(begin + octree_leaf_size, end), plane, tolerance, hits.data());
      for (std::uint32_t k = 0; k < count; ++k) sum.add(columns.point(hits[k]).cast<double>());
    }
  });
  return sum;
}

RandomSubsets::RandomSubsets(const MortonOrder& order, const std::vector<std::int32_t>& owner, std::uint64_t seed,
                             const Context& context) {
  const std::size_t total = owner.size();
  std::size_t free = 0;
  const auto is_free = [&](std::size_t i) { return owner[i] < 0 && order.columns.is_live(i); };
  std::vector<std::size_t> counts((total + subset_chunk - 1) / subset_chunk, 0);
  context.parallel_chunks(total, subset_chunk, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) counts[chunk] += is_free(i) ? 1 : 0;
  });
  for (const std::size_t count : counts) free += count;
  const std::vector<double> shares = subset_shares(static_cast<double>(free));

  Division division = divide(total, shares, seed, is_free, context);
  subsets_.resize(shares.size());
  std::vector<std::vector<std::uint64_t>> codes(shares.size());
  for (std::size_t k = 0; k < subsets_.size(); ++k) {
    subsets_[k].columns.resize(division.sizes[k]);
    subsets_[k].place.resize(division.sizes[k]);
    subsets_[k].live = division.sizes[k];
    codes[k].resize(division.sizes[k]);
  }
  context.parallel_chunks(total, subset_chunk, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint8_t k = division.target[i];
      if (k == no_subset) continue;
      const std::uint32_t to = division.offsets[chunk][k]++;
      subsets_[k].columns.copy(to, order.columns, i);
      subsets_[k].place[to] = static_cast<std::uint32_t>(i);
      codes[k][to] = order.codes[i];
    }
  });
  for (std::size_t k = 0; k < subsets_.size(); ++k)
    subsets_[k].octree = PointOctree(subsets_[k].columns, codes[k], octree_leaf_size, context);
  live_ = built_ = free;
}

std::uint32_t RandomSubsets::count(std::size_t subset, const FloatPlane& plane, const Tolerance& tolerance,
                                   const Context& context) const {
  const RandomSubset& s = subsets_[subset];
  if (s.octree.nodes().empty()) return 0;
  std::vector<std::uint32_t> counts(s.octree.blocks().size(), 0);
  context.parallel_for(
      counts.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
          s.octree.visit_slab(s.octree.blocks()[i], plane, tolerance.distance, [&](std::uint32_t b, std::uint32_t e) {
            counts[i] += count_range(s.columns, b, e, plane, tolerance);
          });
      },
      8);
  std::uint32_t sum = 0;
  for (const std::uint32_t c : counts) sum += c;
  return sum;
}

Support RandomSubsets::support(const FloatPlane& plane, const Tolerance& tolerance, std::size_t subsets,
                               const Context& context) const {
  Support result(subsets);
  for (std::size_t k = 0; k < subsets; ++k) {
    const RandomSubset& s = subsets_[k];
    const std::vector<std::uint32_t>& blocks = s.octree.blocks();
    constexpr std::size_t group = 8;
    std::vector<std::vector<std::uint32_t>> found((blocks.size() + group - 1) / group);
    context.parallel_chunks(blocks.size(), group, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        s.octree.visit_slab(blocks[i], plane, tolerance.distance, [&](std::uint32_t b, std::uint32_t e) {
          auto& out = found[chunk];
          const std::size_t before = out.size();
          out.resize(before + (e - b));
          out.resize(before + collect(s.columns, b, e, plane, tolerance, out.data() + before));
        });
    });
    for (const auto& part : found) result[k].insert(result[k].end(), part.begin(), part.end());
  }
  return result;
}

void RandomSubsets::take_out(const Support& support, const Context& context) {
  for (std::size_t k = 0; k < support.size(); ++k) {
    context.parallel_for(support[k].size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) subsets_[k].columns.take_out(support[k][i]);
    });
    subsets_[k].live -= support[k].size();
    live_ -= support[k].size();
  }
}

}  // namespace atrium::plane
