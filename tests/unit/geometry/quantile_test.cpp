#include "modules/geometry/quantile.hpp"

#include <gtest/gtest.h>

#include <array>
#include <span>

namespace atrium::quantile_test {
namespace {

TEST(Quantile, TheMedianOfAnEvenCountIsTheGreaterOfTheMiddleAndTheHalfQuantileTheSmaller) {
  EXPECT_EQ(median(std::vector{4, 1, 3, 2}), 3);
  EXPECT_EQ(quantile(std::vector{4, 1, 3, 2}, 0.5), 2);
  EXPECT_EQ(median(std::vector{5, 1, 9}), 5);
  EXPECT_EQ(quantile(std::vector{5, 1, 9}, 0.5), 5);
  EXPECT_EQ(median(std::vector{7}), 7);
}

TEST(Quantile, OfTheSharesZeroAndOneIsTheLeastAndTheGreatest) {
  const std::vector<float> values{3, -1, 8, 2};
  EXPECT_EQ(quantile(values, 0), -1);
  EXPECT_EQ(quantile(values, 1), 8);
  EXPECT_EQ(values, (std::vector<float>{3, -1, 8, 2})) << "a list that is not moved keeps its order";
}

TEST(Quantile, ARankCountsFromTheLeastAndStaysWithinASpan) {
  std::array<int, 5> values{9, 4, 6, 5, 0};
  EXPECT_EQ(ranked(std::span(values).first(4), 0), 4);
  EXPECT_EQ(ranked(std::span(values).first(4), 3), 9);
  EXPECT_EQ(values.back(), 0);
}

TEST(Quantile, ATrimmedRangeLeavesOutTheSameShareAtEachEnd) {
  const std::vector<int> values{50, 20, 10, 90, 40, 30, 80, 70, 60, 100};
  EXPECT_EQ(trimmed_range(values, 0), std::pair(10, 100));
  EXPECT_EQ(trimmed_range(values, 0.19), std::pair(20, 90));
}

TEST(Quantile, WeightsCountRatherThanValues) {
  EXPECT_EQ(weighted_quantile({{3, 1}, {1, 1}, {2, 2}}, 0.5), 2);
  EXPECT_EQ(weighted_quantile({{3, 10}, {1, 1}, {2, 1}}, 0.5), 3);
  EXPECT_EQ(weighted_quantile({{2, 1}, {1, 1}}, 0.5), 1) << "exactly the share is enough";
  EXPECT_EQ(weighted_quantile({{2, 1}, {1, 1}}, 1), 2);
}

}  // namespace
}  // namespace atrium::quantile_test
