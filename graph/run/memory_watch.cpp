#include "graph/run/memory_watch.hpp"

#include <algorithm>

#include "graph/api/clocks.hpp"

namespace atrium {

std::size_t MemoryWatch::begin() {
  const std::lock_guard lock(mutex_);
  ++number_;
  alone_ = running_++ == 0 ? number_ : 0;
  if (alone_ != 0) {
    peak_ = std::max(peak_, peak_memory());
    reset_peak_memory();  // a peak of earlier nodes would hide this one's
    before_ = resident_memory();
  }
  return number_;
}

std::optional<std::uint64_t> MemoryWatch::end(std::size_t node) {
  const std::lock_guard lock(mutex_);
  --running_;
  if (alone_ != node) return std::nullopt;
  const std::uint64_t peak = peak_memory();
  return peak > before_ ? peak - before_ : 0;
}

void MemoryWatch::disturb() {
  const std::lock_guard lock(mutex_);
  alone_ = 0;
}

std::uint64_t MemoryWatch::peak_before() {
  const std::lock_guard lock(mutex_);
  return peak_;
}

}  // namespace atrium
