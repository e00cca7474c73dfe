#include "modules/geometry/radix_sort.hpp"

#include <algorithm>

namespace atrium {
namespace {

constexpr unsigned max_digit = 10;  // bits; more buckets than this outrun the write-combining and the TLB
constexpr std::size_t chunk_size = std::size_t{1} << 17U;

struct Digit {
  unsigned shift;
  std::uint64_t mask;
  std::size_t operator()(std::uint64_t value) const { return static_cast<std::size_t>((value >> shift) & mask); }
};

/// Where the values of each (chunk, bucket) go: counts, turned into running offsets with buckets as the outer loop.
std::vector<std::uint32_t> offsets(const std::vector<std::uint64_t>& values, Digit digit, const Context& context) {
  const std::size_t buckets = digit.mask + 1;
  const std::size_t chunks = (values.size() + chunk_size - 1) / chunk_size;
  std::vector<std::uint32_t> table(chunks * buckets, 0);
  context.parallel_chunks(values.size(), chunk_size, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    std::uint32_t* counts = table.data() + chunk * buckets;
    for (std::size_t i = begin; i < end; ++i) ++counts[digit(values[i])];
  });
  std::uint32_t running = 0;
  for (std::size_t b = 0; b < buckets; ++b)
    for (std::size_t c = 0; c < chunks; ++c) {
      const std::uint32_t n = table[c * buckets + b];
      table[c * buckets + b] = running;
      running += n;
    }
  return table;
}

}  // namespace

void radix_sort(std::vector<std::uint64_t>& values, unsigned low, unsigned high, const Context& context) {
  if (high <= low || values.size() < 2) return;
  if (values.size() < 4096) {
    const std::uint64_t mask = (high - low >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << (high - low)) - 1) << low;
    std::stable_sort(values.begin(), values.end(),
                     [mask](std::uint64_t a, std::uint64_t b) { return (a & mask) < (b & mask); });
    return;
  }
  const unsigned passes = (high - low + max_digit - 1) / max_digit;
  std::vector<std::uint64_t> target(values.size());
  for (unsigned pass = 0; pass < passes; ++pass) {
    const unsigned begin = low + (high - low) * pass / passes;
    const unsigned end = low + (high - low) * (pass + 1) / passes;
    const Digit digit{begin, (std::uint64_t{1} << (end - begin)) - 1};
    std::vector<std::uint32_t> table = offsets(values, digit, context);
    context.parallel_chunks(values.size(), chunk_size, [&](std::size_t chunk, std::size_t first, std::size_t last) {
      std::uint32_t* next = table.data() + chunk * (digit.mask + 1);
      for (std::size_t i = first; i < last; ++i) target[next[digit(values[i])]++] = values[i];
    });
    values.swap(target);
  }
}

}  // namespace atrium
