#include "modules/baseline/banded_queue.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <queue>
#include <tuple>
#include <vector>

#include "graph/api/random.hpp"

namespace atrium::baseline::banded_queue_test {
namespace {

struct Entry {
  double key;
  int number;
  friend bool operator<(const Entry& a, const Entry& b) {
    return std::tie(a.key, a.number) < std::tie(b.key, b.number);
  }
  friend bool operator>(const Entry& a, const Entry& b) { return b < a; }
};

RC_GTEST_PROP(BandedQueue, TakesInTheOrderOfAHeap, (std::uint32_t seed)) {
  // Pushes and pops mixed at random; some entries go out of date while they wait.
  Random random(seed);
  BandedQueue<Entry> queue(1 + random.index(40));
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> heap;
  std::vector<bool> current;
  const auto is_current = [&](const Entry& e) {
    return static_cast<bool>(current[static_cast<std::size_t>(e.number)]);
  };
  const auto push = [&] {
    const Entry entry{std::floor(random.uniform(0, 50)), static_cast<int>(current.size())};
    current.push_back(true);
    queue.push(entry);
    heap.push(entry);
  };
  const auto pop = [&] {
    Entry entry{};
    const bool found = queue.pop(entry, is_current);
    while (!heap.empty() && !is_current(heap.top())) heap.pop();
    RC_ASSERT(found == !heap.empty());
    if (!found) return;
    RC_ASSERT(entry.number == heap.top().number);
    heap.pop();
  };
  const std::uint64_t first = random.index(300);
  for (std::uint64_t i = 0; i < first; ++i) push();
  for (int i = 0; i < 600; ++i) {
    const double chance = random.uniform();
    if (chance < 0.4) push();
    if (chance >= 0.4 && chance < 0.9) pop();
    if (chance >= 0.9 && !current.empty()) current[random.index(current.size())] = false;
  }
  queue.clear();
  heap = {};
  push();
  pop();
  pop();
}

}  // namespace
}  // namespace atrium::baseline::banded_queue_test
