#include "modules/geometry/radix_sort.hpp"

#include <algorithm>
#include <memory>
#include <utility>

namespace atrium {
namespace {

constexpr unsigned max_digit = 10;  // bits; more buckets than this outrun the write-combining and the TLB
constexpr std::size_t sorted_chunk = std::size_t{1} << 17U;

struct Digit {
  unsigned shift;
  std::uint64_t mask;
  std::size_t operator()(std::uint64_t value) const { return static_cast<std::size_t>((value >> shift) & mask); }
};

/// Where the values of each (chunk, bucket) go: counts, turned into running offsets with buckets as the outer loop.
std::vector<std::uint32_t> offsets(const std::uint64_t* values, std::size_t size, Digit digit, const Context& context) {
  const std::size_t buckets = digit.mask + 1;
  const std::size_t chunks = (size + sorted_chunk - 1) / sorted_chunk;
  std::vector<std::uint32_t> table(chunks * buckets, 0);
  context.parallel_chunks(size, sorted_chunk, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
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

void sort_by(const std::uint64_t* from, std::uint64_t* to, std::size_t size, Digit digit, const Context& context) {
  std::vector<std::uint32_t> table = offsets(from, size, digit, context);
  context.parallel_chunks(size, sorted_chunk, [&](std::size_t chunk, std::size_t first, std::size_t last) {
    std::uint32_t* next = table.data() + chunk * (digit.mask + 1);
    for (std::size_t i = first; i < last; ++i) to[next[digit(from[i])]++] = from[i];
  });
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
  const auto spare = std::make_unique_for_overwrite<std::uint64_t[]>(values.size());
  std::uint64_t *from = values.data(), *to = spare.get();
  for (unsigned pass = 0; pass < passes; ++pass) {
    const unsigned begin = low + (high - low) * pass / passes;
    const unsigned end = low + (high - low) * (pass + 1) / passes;
    sort_by(from, to, values.size(), {begin, (std::uint64_t{1} << (end - begin)) - 1}, context);
    std::swap(from, to);
  }
  if (from != values.data())
    context.parallel_for(
        values.size(), [&](std::size_t begin, std::size_t end) { std::copy(from + begin, from + end, to + begin); },
        sorted_chunk);
}

}  // namespace atrium
