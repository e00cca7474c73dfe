#include "graph/api/helper_memory.hpp"

#include <algorithm>
#include <utility>

namespace atrium {
namespace {

thread_local std::uint64_t noted = 0;

}  // namespace

void note_helper_memory(std::uint64_t bytes) { noted = std::max(noted, bytes); }
std::uint64_t take_helper_memory() { return std::exchange(noted, 0); }

}  // namespace atrium
