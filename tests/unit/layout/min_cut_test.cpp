#include "modules/layout/min_cut.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "graph/api/random.hpp"

namespace atrium::layout::min_cut_test {
namespace {

/// The same problem, solved by trying everything.
struct Problem {
  struct Pair {
    std::size_t a, b;
    double cost_01, cost_10;
  };
  std::vector<std::pair<double, double>> costs;
  std::vector<Pair> pairs;

  double cost(const std::vector<bool>& labels) const {
    double sum = 0;
    for (std::size_t i = 0; i < costs.size(); ++i) sum += labels[i] ? costs[i].second : costs[i].first;
    for (const auto& p : pairs)
      if (labels[p.a] != labels[p.b]) sum += labels[p.b] ? p.cost_01 : p.cost_10;
    return sum;
  }
  std::vector<bool> solved() const {
    MinCut cut(costs.size());
    for (std::size_t i = 0; i < costs.size(); ++i) cut.add(i, costs[i].first, costs[i].second);
    for (const auto& p : pairs) cut.add_pair(p.a, p.b, p.cost_01, p.cost_10);
    return cut.solve();
  }
  double least() const {
    double best = 1e300;
    for (std::size_t bits = 0; bits < (std::size_t{1} << costs.size()); ++bits) {
      std::vector<bool> labels;
      for (std::size_t i = 0; i < costs.size(); ++i) labels.push_back(((bits >> i) & 1U) != 0);
      best = std::min(best, cost(labels));
    }
    return best;
  }
};

RC_GTEST_PROP(MinCut, IsTheBestOfAllLabellings, (std::uint32_t seed)) {
  Random random(seed);
  Problem problem;
  const auto n = 1 + random.index(11);
  for (std::uint64_t i = 0; i < n; ++i) problem.costs.emplace_back(random.uniform(-3, 3), random.uniform(-3, 3));
  for (std::uint64_t i = 0; n > 1 && i < random.index(3 * n); ++i) {
    const auto a = random.index(n), b = (a + 1 + random.index(n - 1)) % n;
    problem.pairs.push_back({a, b, random.uniform() < 0.3 ? 0 : random.uniform(0, 2), random.uniform(0, 2)});
  }
  RC_ASSERT(std::abs(problem.cost(problem.solved()) - problem.least()) < 1e-9);
}

// Whole numbers: many labellings cost the same.
RC_GTEST_PROP(MinCut, TiesAreZeroWhereTheyCanBe, (std::uint32_t seed)) {
  Random random(seed);
  Problem problem;
  const auto n = 2 + random.index(8);
  for (std::uint64_t i = 0; i < n; ++i)
    problem.costs.emplace_back(static_cast<double>(random.index(4)), static_cast<double>(random.index(4)));
  for (std::uint64_t i = 0; i < 2 * n; ++i) {
    const auto a = random.index(n), b = (a + 1 + random.index(n - 1)) % n;
    problem.pairs.push_back({a, b, static_cast<double>(random.index(3)), static_cast<double>(random.index(3))});
  }
  const auto labels = problem.solved();
  const double least = problem.least();
  RC_ASSERT(problem.cost(labels) == least);
  for (std::size_t bits = 0; bits < (std::size_t{1} << n); ++bits) {
    std::vector<bool> other;
    for (std::size_t i = 0; i < n; ++i) other.push_back(((bits >> i) & 1U) != 0);
    if (problem.cost(other) != least) continue;
    // Of all best labellings the one with the fewest ones: its ones are ones in each of them.
    for (std::size_t i = 0; i < n; ++i) RC_ASSERT(!labels[i] || other[i]);
  }
}

TEST(MinCut, PairsPayInTheirDirection) {
  // 0 wants 1 and 1 wants 0; it costs 3 that (0, 1) are (1, 0), nothing the other way round.
  const Problem apart{{{2, 0}, {0, 2}}, {{0, 1, 0, 3}}};
  EXPECT_EQ(apart.cost(apart.solved()), 2);
  const Problem free{{{2, 0}, {0, 2}}, {{0, 1, 3, 0}}};
  EXPECT_EQ(free.solved(), (std::vector<bool>{true, false}));
}

TEST(MinCut, CostsAddUp) {
  MinCut cut(1);
  cut.add(0, 1, 0);
  cut.add(0, 0, 3);
  cut.add(0, 0, -1.5);
  EXPECT_EQ(cut.solve(), std::vector<bool>{false});
  cut.add(0, 0.75, 0);
  EXPECT_EQ(cut.solve(), std::vector<bool>{true});
}

TEST(MinCut, NothingToDecide) {
  EXPECT_TRUE(MinCut(0).solve().empty());
  EXPECT_EQ(MinCut(3).solve(), (std::vector<bool>{false, false, false}));
  MinCut cut(2);
  cut.add_pair(0, 1, 1, 1);
  cut.add_pair(1, 1, 5, 5);  // with itself: never differs
  EXPECT_EQ(cut.solve(), (std::vector<bool>{false, false}));
}

// A chain of a hundred thousand, as large as a storey gets: deep trees, no recursion.
TEST(MinCut, AChainHoldsTogether) {
  constexpr std::size_t n = 100000;
  MinCut cut(n);
  cut.add(0, 2, 0);
  for (std::size_t i = 0; i + 1 < n; ++i) cut.add_pair(i, i + 1, 3, 3);
  const auto labels = cut.solve();
  EXPECT_EQ(std::count(labels.begin(), labels.end(), true), static_cast<std::ptrdiff_t>(n));
}

}  // namespace
}  // namespace atrium::layout::min_cut_test
