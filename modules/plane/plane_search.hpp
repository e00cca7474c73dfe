#pragma once
#include <memory>
#include <optional>
#include <queue>
#include <vector>

#include "modules/plane/assignment.hpp"
#include "modules/plane/candidates.hpp"
#include "modules/plane/plane_patches.hpp"
#include "modules/plane/random_subsets.hpp"

namespace atrium::plane {

/// The loop of efficient RANSAC: draws candidates, takes the best one when it is unlikely that a better one was missed,
/// takes its points out, and goes on until no plane of `min_points` is likely to be left.
class PlaneSearch {
 public:
  struct Settings {
    Tolerance tolerance;
    double probability = 0.01;
    std::size_t min_points = 50;
    std::size_t max_planes = 0;
  };
  PlaneSearch(const MortonOrder& order, const Connectivity& connectivity, const Settings& settings,
              const Context& context);

  /// The planes, in the order in which they were found: roughly the largest first.
  std::vector<Patch> run();

 private:
  bool confident(double points) const;
  void divide();
  void draw();
  void rescore(Candidate& candidate) const;
  std::optional<FittedPatch> extract();
  bool compete(Candidate& candidate, int& budget);
  std::optional<FittedPatch> fit(Candidate candidate);
  bool shadowed(Candidate& candidate) const;
  void take_out(const FittedPatch& found, std::int32_t number);

  struct Smaller {
    bool operator()(const Candidate& a, const Candidate& b) const { return a.expected < b.expected; }
  };

  const MortonOrder& order_;
  const Connectivity& connectivity_;
  Settings settings_;
  double min_points_;
  const Context& context_;
  std::vector<std::int32_t> owner_;
  std::unique_ptr<RandomSubsets> subsets_;
  std::unique_ptr<LocalizedSampler> sampler_;
  std::priority_queue<Candidate, std::vector<Candidate>, Smaller> candidates_;
  std::vector<FittedPatch> fitted_;  ///< of this round
  std::uint32_t round_ = 0;
  std::uint64_t divisions_ = 0, batches_ = 0;
  std::size_t drawn_ = 0;
  double coverage_ = 0;  ///< Σ over the draws of 1 / (N d 2^(k−1)): a plane of n points was missed with e^(−n·coverage)
};

}  // namespace atrium::plane
