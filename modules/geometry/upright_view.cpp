#include "modules/geometry/upright_view.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace atrium {
namespace {

constexpr double apart = 0.15;          // metres: what is nearer to a level is the level
constexpr double tolerance = 0.12;      // metres: half the thickness of a level
constexpr double block_size = 1.0;      // metres
constexpr double least_of_main = 0.25;  // share of the largest level's area

/// Numbers cells of a plan that need not be full: the cell's place in the sorted list of those in use.
template <class Key>
std::uint32_t number_of(const std::vector<Key>& sorted, Key key) {
  return static_cast<std::uint32_t>(std::lower_bound(sorted.begin(), sorted.end(), key) - sorted.begin());
}

}  // namespace

UprightView::UprightView(const SurfacePieces& pieces, const Eigen::Vector3d& axis, double scale)
    : piece_(pieces.size * scale) {
  place(pieces, axis, scale);
  find_levels();
  mark_levels();
}

void UprightView::place(const SurfacePieces& pieces, const Eigen::Vector3d& axis, double scale) {
  const Eigen::Vector3d across = axis.unitOrthogonal(), other = axis.cross(across);
  const double cell = std::max(0.15, 2 * piece_);
  const auto cells_a_block = static_cast<std::int64_t>(std::max(1.0, std::round(block_size / cell)));
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e300), high = -low;
  std::vector<Eigen::Vector3d> places;
  places.reserve(pieces.pieces.size());
  for (const auto& p : pieces.pieces) {
    const Eigen::Vector3d at = p.place.cast<double>() * scale;
    places.emplace_back(across.dot(at), other.dot(at), axis.dot(at));
    low = low.cwiseMin(places.back().head<2>());
    high = high.cwiseMax(places.back().head<2>());
  }
  if (places.empty()) return;
  const std::int64_t wide = static_cast<std::int64_t>((high.y() - low.y()) / cell) + 1;
  std::vector<std::int64_t> cells(places.size());
  std::vector<std::pair<std::int64_t, std::int64_t>> blocks(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto r = static_cast<std::int64_t>((places[i].x() - low.x()) / cell);
    const auto c = static_cast<std::int64_t>((places[i].y() - low.y()) / cell);
    cells[i] = r * wide + c;
    blocks[i] = {r / cells_a_block, c / cells_a_block};
  }
  std::vector<std::int64_t> used = cells;
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  constexpr std::int64_t most_blocks = 2048;  // a side; what lies further off shares the last one
  block_rows_ = static_cast<std::uint32_t>(
      std::min<std::int64_t>(most_blocks, static_cast<std::int64_t>((high.x() - low.x()) / cell) / cells_a_block + 1));
  block_columns_ = static_cast<std::uint32_t>(std::min<std::int64_t>(most_blocks, (wide - 1) / cells_a_block + 1));
  constexpr double level = 0.9781, wall = 0.2079;  // cosines of 12 and 78 degrees
  items_.resize(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double c = std::abs(axis.dot(pieces.pieces[i].normal.cast<double>()));
    const bool plane = !pieces.pieces[i].normal.isZero();
    const auto row = std::min<std::int64_t>(blocks[i].first, block_rows_ - 1);
    const auto column = std::min<std::int64_t>(blocks[i].second, block_columns_ - 1);
    items_[i] = {static_cast<std::uint32_t>(row * block_columns_ + column), number_of(used, cells[i]),
                 static_cast<float>(places[i].z()),
                 !plane      ? Kind::other
                 : c > level ? Kind::level
                 : c < wall  ? Kind::wall
                             : Kind::other,
                 false};
  }
  std::stable_sort(items_.begin(), items_.end(), [](const Item& a, const Item& b) {
    return a.column != b.column ? a.column < b.column : a.height < b.height;
  });
  for (std::uint32_t i = 0; i < items_.size(); ++i)
    if (i == 0 || items_[i].column != items_[i - 1].column) columns_.push_back(i);
  columns_.push_back(static_cast<std::uint32_t>(items_.size()));
}

// NOLINTNEXTLINE(readability-function-size)
void UprightView::find_levels() {
  std::vector<float> heights;
  for (const auto& item : items_)
    if (item.kind == Kind::level) heights.push_back(item.height);
  level_area_ = static_cast<double>(heights.size()) * piece_ * piece_;
  if (heights.empty()) return;
  std::sort(heights.begin(), heights.end());
  // Entropy over steps of 10 cm, and windows of ±tolerance whose area is the largest around.
  double entropy = 0;
  for (std::size_t i = 0; i < heights.size();) {
    std::size_t end = i;
    const double step = std::floor(static_cast<double>(heights[i]) / 0.1);
    while (end < heights.size() && std::floor(static_cast<double>(heights[end]) / 0.1) == step) ++end;
    const double share = static_cast<double>(end - i) / static_cast<double>(heights.size());
    entropy -= share * std::log(share);
    i = end;
  }
  spread_ = std::exp(entropy);
  std::vector<std::pair<std::size_t, std::size_t>> windows;  // first and last + 1, by rising height
  const auto bound = [&](float h) { return std::lower_bound(heights.begin(), heights.end(), h) - heights.begin(); };
  std::vector<char> taken(heights.size(), 0);
  std::size_t largest = 0;
  for (;;) {
    std::size_t best = 0, best_begin = 0;
    for (float h = heights.front(); h <= heights.back() + 0.05F; h += 0.05F) {
      const auto begin = static_cast<std::size_t>(bound(h - static_cast<float>(tolerance)));
      const auto end = static_cast<std::size_t>(bound(h + static_cast<float>(tolerance)));
      std::size_t count = 0;
      if (end - begin <= best) continue;
      for (std::size_t i = begin; i < end; ++i) count += taken[i] ? 0 : 1;
      if (count > best) best = count, best_begin = begin;
    }
    if (best == 0 || static_cast<double>(best) < least_of_main * static_cast<double>(largest)) break;
    largest = std::max(largest, best);
    double sum = 0;
    std::size_t count = 0;
    const float top = heights[best_begin] + 2 * static_cast<float>(tolerance);
    for (std::size_t i = best_begin; i < heights.size() && heights[i] < top; ++i) {
      if (taken[i]) continue;
      taken[i] = 1;
      sum += static_cast<double>(heights[i]);
      ++count;
    }
    levels_.push_back({sum / static_cast<double>(count), static_cast<double>(count) * piece_ * piece_, {}});
    constexpr std::size_t most_levels = 40;
    if (levels_.size() == most_levels) break;
  }
  std::sort(levels_.begin(), levels_.end(), [](const Level& a, const Level& b) { return a.height < b.height; });
}

void UprightView::mark_levels() {
  const std::size_t blocks = std::size_t{block_rows_} * block_columns_;
  constexpr double least_area = 0.1;  // square metres
  for (auto& level : levels_) {
    std::vector<std::uint16_t> count(blocks, 0);
    for (const auto& item : items_)
      if (item.kind == Kind::level && std::abs(static_cast<double>(item.height) - level.height) < tolerance &&
          count[item.block] < 60000)
        ++count[item.block];
    level.blocks.assign(blocks, 0);
    for (std::uint32_t r = 0; r < block_rows_; ++r)
      for (std::uint32_t c = 0; c < block_columns_; ++c) {
        if (static_cast<double>(count[r * block_columns_ + c]) * piece_ * piece_ < least_area) continue;
        for (std::uint32_t y = r > 0 ? r - 1 : 0; y <= std::min(r + 1, block_rows_ - 1); ++y)
          for (std::uint32_t x = c > 0 ? c - 1 : 0; x <= std::min(c + 1, block_columns_ - 1); ++x)
            level.blocks[y * block_columns_ + x] = 1;
      }
  }
  for (auto& item : items_)
    for (const auto& level : levels_)
      if (std::abs(static_cast<double>(item.height) - level.height) < tolerance && level.blocks[item.block] != 0)
        item.main = true;
}

const UprightView::Level* UprightView::below(std::uint32_t block, double height) const {
  for (auto level = levels_.rbegin(); level != levels_.rend(); ++level)
    if (level->height < height - apart && level->blocks[block] != 0) return &*level;
  return nullptr;
}

const UprightView::Level* UprightView::above(std::uint32_t block, double height) const {
  for (const auto& level : levels_)
    if (level.height > height + apart && level.blocks[block] != 0) return &level;
  return nullptr;
}

}  // namespace atrium
