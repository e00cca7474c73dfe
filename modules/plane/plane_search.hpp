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
  struct Fitted {
    FittedPatch found;
    double expected = 0;                  ///< of the candidate that led to it
    std::vector<Eigen::Vector3f> sample;  ///< some of its points; none when it is taken or has changed
  };

  bool confident(double points) const;
  void divide();
  void draw();
  void rescore(Candidate& candidate) const;
  std::optional<FittedPatch> extract();
  bool compete(Candidate& candidate, int& budget);
  bool fit(Candidate& candidate);
  void take_sample(Fitted& fitted) const;
  bool renew(Candidate& candidate);
  bool shadowed(Candidate& candidate) const;
  void take_out(const FittedPatch& found, std::int32_t number);

  /// Draws that could tell planes of `least_points` or more from chance: `sum` is that of 1 / (N d 2^(k-1)) over them,
  /// so that a plane of n points was missed with probability e^(-n sum).
  struct Coverage {
    double sum = 0;
    double least_points = 0;
  };
  struct Smaller {
    bool operator()(const Candidate& a, const Candidate& b) const { return a.expected < b.expected; }
  };
  using Queue = std::priority_queue<Candidate, std::vector<Candidate>, Smaller>;

  const MortonOrder& order_;
  const Connectivity& connectivity_;
  Settings settings_;
  double min_points_;
  const Context& context_;
  std::vector<std::int32_t> owner_;
  std::unique_ptr<RandomSubsets> subsets_;
  std::unique_ptr<LocalizedSampler> sampler_;
  Queue candidates_;
  std::vector<Fitted> fitted_;  ///< since the last division, those taken and those too small included
  std::uint32_t round_ = 0;
  std::uint64_t divisions_ = 0, batches_ = 0;
  std::size_t drawn_ = 0;
  int vain_fits_ = 0;               ///< in a row, since the last plane
  std::vector<Coverage> coverage_;  ///< one for each division
};

}  // namespace atrium::plane
