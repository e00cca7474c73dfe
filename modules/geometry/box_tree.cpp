#include "modules/geometry/box_tree.hpp"

#include <algorithm>

#include "modules/geometry/radix_sort.hpp"

namespace atrium {
namespace {

// Spreads the lowest 10 bits so that two zeros stand between any two.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 16) & 0x30000ff;
  x = (x | x << 8) & 0x300f00f;
  x = (x | x << 4) & 0x30c30c3;
  return (x | x << 2) & 0x9249249;
}

}  // namespace

BoxTree::BoxTree(const std::vector<Eigen::AlignedBox3d>& boxes, const Context& context) {
  Eigen::AlignedBox3d all;
  for (const auto& b : boxes) all.extend(b.center());
  // One scale for all axes: the thickness of a flat surface is not to part its neighbours.
  const double scale = boxes.empty() ? 0 : 1023.0 / std::max(all.sizes().maxCoeff(), 1e-300);
  std::vector<std::uint64_t> keys(boxes.size());
  context.parallel_for(boxes.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3d place = (boxes[i].center() - all.min()) * scale;
      std::uint64_t key = 0;
      for (int k = 0; k < 3; ++k) key |= spread(static_cast<std::uint64_t>(std::clamp(place[k], 0.0, 1023.0))) << k;
      keys[i] = key << 32 | i;
    }
  });
  radix_sort(keys, 32, 62, context);
  order_.reserve(boxes.size());
  boxes_.reserve(boxes.size());
  for (const auto key : keys) {
    order_.push_back(static_cast<std::uint32_t>(key));
    boxes_.push_back(boxes[order_.back()]);
  }
  const auto* below = &boxes_;
  while (!boxes_.empty() && (levels_.empty() || below->size() > 1)) {
    std::vector<Eigen::AlignedBox3d> level((below->size() + fan - 1) / fan);
    for (std::size_t i = 0; i < below->size(); ++i) level[i / fan].extend((*below)[i]);
    levels_.push_back(std::move(level));
    below = &levels_.back();
  }
}

}  // namespace atrium
