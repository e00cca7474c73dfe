#pragma once
#include <cstddef>
#include <vector>

namespace atrium::layout {

/// A binary labelling of least cost: each element is 0 or 1, each pair pays when its elements differ (Boykov and
/// Kolmogorov, An experimental comparison of min-cut/max-flow algorithms, PAMI 26(9), 2004; Boost's implementation).
class MinCut {
 public:
  explicit MinCut(std::size_t elements) : zero_(elements, 0), one_(elements, 0) {}

  /// What it costs that `element` is 0, and that it is 1. Adds up; negative costs are allowed.
  void add(std::size_t element, double cost_of_zero, double cost_of_one);
  /// What it costs that a is 0 and b is 1, and that a is 1 and b is 0. Not negative.
  void add_pair(std::size_t a, std::size_t b, double cost_01, double cost_10);
  /// The labels of least cost; elements that cost the same either way are 0.
  std::vector<bool> solve() const;

 private:
  struct Pair {
    std::size_t a, b;
    double cost_01, cost_10;
  };
  std::vector<double> zero_, one_;
  std::vector<Pair> pairs_;
};

}  // namespace atrium::layout
