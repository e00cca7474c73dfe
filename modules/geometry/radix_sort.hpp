#pragma once
#include <cstdint>
#include <vector>

#include "graph/api/context.hpp"

namespace atrium {

/// Sorts by the bits [low, high) of each value, ascending, and keeps the order of values whose bits there are equal. A
/// parallel radix sort with the same result on any number of threads. Packing `key << index_bits | index` gives the
/// total order (key, index).
void radix_sort(std::vector<std::uint64_t>& values, unsigned low, unsigned high, const Context& context);

}  // namespace atrium
