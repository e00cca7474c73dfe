#include "modules/plane/candidates.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace atrium::plane {
namespace {

constexpr std::size_t enough_to_draw_from = 65536;
constexpr std::size_t draws_per_chunk = 32;
constexpr double learned_share = 0.9;  // x of equation (11)

const RandomSubset& choose_source(const RandomSubsets& subsets) {
  for (std::size_t i = 0; i < subsets.size(); ++i)
    if (subsets[i].live >= enough_to_draw_from / 2) return subsets[i];
  return subsets[subsets.size() - 1];
}

}  // namespace

void estimate_support(Candidate& candidate, const RandomSubsets& subsets) {
  double sampled = 0;
  for (std::size_t i = 0; i < candidate.scored; ++i) sampled += static_cast<double>(subsets[i].live);
  const auto all = static_cast<double>(subsets.live());
  const double n = candidate.supporters;
  candidate.patch = -1;
  if (candidate.scored == subsets.size()) {
    candidate.expected = candidate.lower = candidate.upper = n;
    return;
  }
  const double mean = (2 + all) * (1 + n) / (2 + sampled);
  const double spread =
      std::sqrt((2 + all) * (1 + n) * (all - sampled) * (sampled + 1 - n) / (3 + sampled)) / (2 + sampled);
  candidate.expected = mean - 1;
  candidate.lower = mean - 1 - spread;
  candidate.upper = mean - 1 + spread;
}

LocalizedSampler::LocalizedSampler(const RandomSubsets& subsets, std::uint32_t finest_level, const Tolerance& tolerance)
    : subsets_(subsets), source_(choose_source(subsets)), finest_(finest_level), tolerance_(tolerance) {
  leaf_of_.resize(source_.columns.size());
  const auto& nodes = source_.octree.nodes();
  std::uint32_t coarsest = finest_;
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    if (!nodes[i].leaf) continue;
    std::fill(leaf_of_.begin() + nodes[i].begin, leaf_of_.begin() + nodes[i].end, i);
  }
  // Cells that hold most of the points are of no use: the scene's size is that of the middle half of its leaves.
  if (!nodes.empty()) coarsest = std::clamp(nodes[0].level, finest_, finest_ + 5);
  scores_.assign(coarsest - finest_ + 1, 0.0);
  weights_.assign(scores_.size(), 1.0 / static_cast<double>(scores_.size()));
}

std::uint32_t LocalizedSampler::pick_level(double u) const {
  std::uint32_t level = 0;
  while (level + 1 < weights_.size() && u >= weights_[level]) u -= weights_[level++];
  return level;
}

std::optional<FloatPlane> LocalizedSampler::triple(Random& random, std::uint32_t level) const {
  constexpr int attempts = 8;
  const PointColumns& c = source_.columns;
  const auto live_in = [&](std::size_t begin, std::size_t end) -> std::size_t {
    for (int i = 0; i < attempts; ++i) {
      const std::size_t p = begin + random.index(end - begin);
      if (c.is_live(p)) return p;
    }
    return c.size();
  };
  const std::size_t a = live_in(0, c.size());
  if (a == c.size()) return std::nullopt;
  const auto& nodes = source_.octree.nodes();
  std::uint32_t node = leaf_of_[a];
  while (node != 0 && nodes[nodes[node].parent].level <= finest_ + level) node = nodes[node].parent;
  const std::size_t b = live_in(nodes[node].begin, nodes[node].end);
  const std::size_t d = live_in(nodes[node].begin, nodes[node].end);
  if (b == c.size() || d == c.size()) return std::nullopt;
  const Eigen::Vector3f ab = c.point(b) - c.point(a);
  const Eigen::Vector3f ad = c.point(d) - c.point(a);
  Eigen::Vector3f normal = ab.cross(ad);
  const float area = normal.norm();
  // Points nearly in one line or in one place say nothing.
  if (!(area > 0.05F * std::max(ab.squaredNorm(), ad.squaredNorm())) || area == 0) return std::nullopt;
  normal /= area;
  if (normal.dot(c.normal(a) + c.normal(b) + c.normal(d)) < 0) normal = -normal;
  for (const std::size_t i : {a, b, d})
    if (normal.dot(c.normal(i)) < tolerance_.min_cosine) return std::nullopt;
  return FloatPlane{normal, -normal.dot(c.point(a))};
}

void LocalizedSampler::improve(Candidate& candidate) const {
  // A triple's plane is tilted by the noise; the plane fitted to its support is closer to the surface, and finds more.
  constexpr int most_steps = 3;
  Moments moments = subsets_[0].moments(candidate.plane, tolerance_);
  for (int step = 0; step < most_steps && moments.count >= 3; ++step) {
    const Plane fit = fit_plane(moments).plane;
    const double sign = fit.normal.dot(candidate.plane.normal.cast<double>()) < 0 ? -1 : 1;
    const FloatPlane better{(sign * fit.normal).cast<float>(), static_cast<float>(sign * fit.offset)};
    moments = subsets_[0].moments(better, tolerance_);
    if (moments.count <= candidate.supporters) return;
    const bool converged = moments.count < candidate.supporters + candidate.supporters / 16;
    candidate.plane = better;
    candidate.supporters = static_cast<std::uint32_t>(moments.count);
    if (converged) return;
  }
}

std::vector<Candidate> LocalizedSampler::draw(std::size_t count, double min_support, std::uint64_t stream,
                                              const Context& context) {
  std::vector<std::vector<Drawn>> chunks((count + draws_per_chunk - 1) / draws_per_chunk);
  context.parallel_chunks(count, draws_per_chunk, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    Random random = context.random(stream + chunk);
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t level = pick_level(random.uniform());
      const auto plane = triple(random, level);
      if (!plane) continue;
      Drawn drawn;
      drawn.level = level;
      Candidate& c = drawn.candidate;
      c.plane = *plane;
      c.scored = 1;
      c.supporters = subsets_[0].count(c.plane, tolerance_);
      estimate_support(c, subsets_);
      if (c.expected < 0.5 * min_support) continue;
      improve(c);
      estimate_support(c, subsets_);
      if (c.upper >= min_support) chunks[chunk].push_back(drawn);
    }
  });
  std::vector<Candidate> result;
  for (const auto& chunk : chunks)
    for (const Drawn& drawn : chunk) {
      scores_[drawn.level] += drawn.candidate.expected;
      result.push_back(drawn.candidate);
    }
  double sum = 0;
  for (const double s : scores_) sum += s;
  const auto levels_count = static_cast<double>(scores_.size());
  for (std::size_t i = 0; i < weights_.size(); ++i)
    weights_[i] = sum > 0 ? learned_share * scores_[i] / sum + (1 - learned_share) / levels_count : 1 / levels_count;
  return result;
}

}  // namespace atrium::plane
