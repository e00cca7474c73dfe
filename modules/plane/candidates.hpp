#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "graph/api/context.hpp"
#include "graph/api/random.hpp"
#include "modules/plane/random_subsets.hpp"

namespace atrium::plane {

/// A plane that may turn out to be a primitive, and what is known of its support.
struct Candidate {
  FloatPlane plane;
  std::uint32_t supporters = 0;  ///< in the first `scored` subsets
  std::uint32_t scored = 0;
  std::uint32_t round = 0;  ///< of the search, when it was scored; points taken out since make the score an upper bound
  std::int32_t patch = -1;  ///< its fitted component, where there is one: then `expected` is that component's size
  double expected = 0, lower = 0, upper = 0;  ///< support among all live points: mean and interval (4.5.1)
};

/// Sets a candidate's interval from its score on the first `scored` subsets: inference by the hypergeometric
/// distribution (Schnabel et al., 4.5.1).
void estimate_support(Candidate& candidate, const RandomSubsets& subsets);

/// Draws candidates: a random first point, then two more from a cell of the octree around it, on levels that are chosen
/// the more often the better the candidates were that came from them (Schnabel et al., 4.3).
class LocalizedSampler {
 public:
  /// Draws from the first subset that is large enough to hold every plane of interest some dozen times.
  LocalizedSampler(const RandomSubsets& subsets, std::uint32_t finest_level, const Tolerance& tolerance);

  /// Draws `count` times; returns the planes that are worth to be scored further, on the first subset. Deterministic:
  /// the random numbers come from streams of `context` numbered `stream` and up. Learns from the scores.
  std::vector<Candidate> draw(std::size_t count, double min_support, std::uint64_t stream, const Context& context);
  std::size_t levels() const { return weights_.size(); }

 private:
  struct Drawn {
    Candidate candidate;
    std::uint32_t level = 0;
  };
  std::optional<FloatPlane> triple(Random& random, std::uint32_t level) const;
  std::uint32_t pick_level(double u) const;
  void improve(Candidate& candidate) const;

  const RandomSubsets& subsets_;
  const RandomSubset& source_;
  std::vector<std::uint32_t> leaf_of_;
  std::uint32_t finest_;
  Tolerance tolerance_;
  std::vector<double> scores_;   ///< per level: sum of the candidates' support (σ_l)
  std::vector<double> weights_;  ///< probabilities P_l
};

}  // namespace atrium::plane
