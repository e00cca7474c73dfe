#include "modules/geometry/radix_sort.hpp"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <tuple>

#include "graph/api/random.hpp"

namespace atrium::radix_sort_test {
namespace {

std::vector<std::uint64_t> numbers(std::size_t count, std::uint64_t mask) {
  Random random(count + 1);
  std::vector<std::uint64_t> result(count);
  for (auto& n : result) n = random.bits() & mask;
  return result;
}

std::uint64_t bits(std::uint64_t value, unsigned low, unsigned high) {
  return high - low >= 64 ? value : value >> low & ((std::uint64_t{1} << (high - low)) - 1);
}

class RadixSort : public testing::TestWithParam<std::tuple<std::size_t, std::pair<unsigned, unsigned>>> {};

/// Few and many, an even and an odd number of digits, ties by the thousand: always what a stable sort does.
TEST_P(RadixSort, IsAStableSortByTheBits) {
  const auto& [count, range] = GetParam();
  const auto [low, high] = range;
  for (const std::uint64_t mask : {~std::uint64_t{0}, std::uint64_t{0xf00f00f00f0ff}}) {
    auto values = numbers(count, mask);
    auto expected = values;
    std::stable_sort(expected.begin(), expected.end(), [low = low, high = high](std::uint64_t a, std::uint64_t b) {
      return bits(a, low, high) < bits(b, low, high);
    });
    for (const int threads : {1, 3}) {
      auto sorted = values;
      tbb::task_arena(threads).execute([&, low = low, high = high] { radix_sort(sorted, low, high, Context()); });
      ASSERT_EQ(sorted, expected);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, RadixSort,
                         testing::Combine(testing::Values(0, 1, 2, 4095, 4096, 131072, 300001),
                                          testing::Values(std::pair{0U, 64U}, std::pair{20U, 50U}, std::pair{7U, 27U},
                                                          std::pair{63U, 64U}, std::pair{5U, 5U})));

}  // namespace
}  // namespace atrium::radix_sort_test
