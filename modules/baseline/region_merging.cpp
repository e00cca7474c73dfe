#include "modules/baseline/region_merging.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>
#include <utility>

namespace atrium::baseline {
namespace {

using Pair = std::pair<std::int32_t, std::int32_t>;

struct Merge {
  double residual;
  Pair pair;
  friend bool operator<(const Merge& a, const Merge& b) {
    return std::tie(a.residual, a.pair) < std::tie(b.residual, b.pair);
  }
};

std::vector<Pair> neighbouring(const FaceNeighbours& neighbours, const std::vector<std::int32_t>& region) {
  std::vector<Pair> pairs;
  for (std::size_t t = 0; t < region.size(); ++t)
    for (const auto n : neighbours.of[t])
      if (n < FaceNeighbours::several && region[t] >= 0 && region[t] < region[n])
        pairs.emplace_back(region[t], region[n]);
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

class Merging {
 public:
  Merging(const PartitionLimits& limits, std::vector<AreaMoments>& moments) : moments_(moments) {
    distance_ = limits.distance / 2;
    cosine_ = std::cos(limits.angle * std::numbers::pi / 180);
    root_.resize(moments.size());
    std::iota(root_.begin(), root_.end(), 0);
  }
  std::int32_t root(std::int32_t r) const {
    while (root_[at(r)] != r) r = root_[at(r)];
    return r;
  }
  // One sweep over the pairs that fit, best first; whether any was joined.
  bool sweep(const std::vector<Pair>& pairs) {
    std::vector<Merge> merges;
    for (const auto& [a, b] : pairs) consider(root(a), root(b), merges);
    std::sort(merges.begin(), merges.end());
    std::vector<char> changed(moments_.size(), 0);
    bool any = false;
    for (const auto& m : merges) {
      const auto [a, b] = m.pair;
      if (changed[at(a)] || changed[at(b)]) continue;  // looked at again in the next sweep
      changed[at(a)] = changed[at(b)] = 1;
      root_[at(b)] = a;
      moments_[at(a)] += moments_[at(b)];
      any = true;
    }
    return any;
  }

 private:
  static std::size_t at(std::int32_t r) { return static_cast<std::size_t>(r); }
  void consider(std::int32_t a, std::int32_t b, std::vector<Merge>& merges) const {
    if (a == b) return;
    if (a > b) std::swap(a, b);
    const auto& first = moments_[at(a)];
    const auto& second = moments_[at(b)];
    if (first.normals.normalized().dot(second.normals.normalized()) < cosine_) return;
    AreaMoments both = first;
    both += second;
    const Plane plane = both.plane();
    const double residual =
        std::max(first.mean_square(plane.normal, plane.offset), second.mean_square(plane.normal, plane.offset));
    if (residual <= distance_ * distance_) merges.push_back({residual, {a, b}});
  }

  std::vector<AreaMoments>& moments_;
  std::vector<std::int32_t> root_;
  double distance_ = 0, cosine_ = 0;
};

}  // namespace

void merge_regions(const FaceNeighbours& neighbours, const PartitionLimits& limits, std::vector<std::int32_t>& region,
                   std::vector<AreaMoments>& moments) {
  Merging merging(limits, moments);
  const auto pairs = neighbouring(neighbours, region);
  while (merging.sweep(pairs)) {
  }
  std::vector<std::int32_t> number(moments.size(), -1);
  std::vector<AreaMoments> left;
  for (std::size_t r = 0; r < moments.size(); ++r) {
    if (merging.root(static_cast<std::int32_t>(r)) != static_cast<std::int32_t>(r)) continue;
    number[r] = static_cast<std::int32_t>(left.size());
    left.push_back(moments[r]);
  }
  for (auto& r : region)
    if (r >= 0) r = number[static_cast<std::size_t>(merging.root(r))];
  moments = std::move(left);
}

}  // namespace atrium::baseline
