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
  add_ends();
  std::sort(levels_.begin(), levels_.end(), [](const Level& a, const Level& b) { return a.height < b.height; });
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
  cell_ = cell;
  wide_ = wide;
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
    items_[i] = {static_cast<std::uint32_t>(row * block_columns_ + column),
                 number_of(used, cells[i]),
                 static_cast<float>(places[i].z()),
                 !plane      ? Kind::rough
                 : c > level ? Kind::level
                 : c < wall  ? Kind::wall
                             : Kind::other,
                 false,
                 false};
  }
  std::stable_sort(items_.begin(), items_.end(), [](const Item& a, const Item& b) {
    return a.column != b.column ? a.column < b.column : a.height < b.height;
  });
  for (std::uint32_t i = 0; i < items_.size(); ++i)
    if (i == 0 || items_[i].column != items_[i - 1].column) columns_.push_back(i);
  columns_.push_back(static_cast<std::uint32_t>(items_.size()));
  keys_ = std::move(used);
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
    levels_.push_back({sum / static_cast<double>(count), static_cast<double>(count) * piece_ * piece_, false, {}});
    constexpr std::size_t most_levels = 40;
    if (levels_.size() == most_levels) break;
  }
  std::sort(levels_.begin(), levels_.end(), [](const Level& a, const Level& b) { return a.height < b.height; });
}

/// Furniture hides most of the floor of a small room. Where the scan ends and something level is seen, there is a floor
/// or a ceiling, however little is seen of it.
void UprightView::add_ends() {
  if (levels_.empty()) return;
  std::vector<float> heights;
  heights.reserve(items_.size());
  for (const auto& item : items_) heights.push_back(item.height);
  constexpr double beyond = 0.005, near = 0.15, least = 0.3, headroom = 1.5;  // share, metres, square metres, metres
  const auto off = static_cast<std::ptrdiff_t>(beyond * static_cast<double>(heights.size()));
  for (const bool bottom : {true, false}) {
    const auto at = bottom ? heights.begin() + off : heights.end() - 1 - off;
    std::nth_element(heights.begin(), at, heights.end());
    const auto end = static_cast<double>(*at);
    const auto is_near = [&](const Level& level) { return std::abs(level.height - end) < headroom; };
    if (std::any_of(levels_.begin(), levels_.end(), is_near)) continue;
    double sum = 0, count = 0;
    for (const auto& item : items_)
      if (item.kind == Kind::level && std::abs(static_cast<double>(item.height) - end) < near)
        sum += static_cast<double>(item.height), ++count;
    if (count * piece_ * piece_ >= least) levels_.push_back({sum / count, count * piece_ * piece_, true, {}});
  }
}

void UprightView::mark_levels() {
  const std::size_t blocks = std::size_t{block_rows_} * block_columns_;
  constexpr double least_area = 0.1;  // square metres
  for (auto& level : levels_) {
    std::vector<std::uint16_t> count(blocks, 0);
    for (const auto& item : items_)
      if ((item.kind == Kind::level || level.hidden) &&
          std::abs(static_cast<double>(item.height) - level.height) < tolerance && count[item.block] < 60000)
        ++count[item.block];
    level.blocks.assign(blocks, 0);
    for (std::uint32_t r = 0; r < block_rows_; ++r)
      for (std::uint32_t c = 0; c < block_columns_; ++c) {
        if (static_cast<double>(count[r * block_columns_ + c]) * piece_ * piece_ <
            (level.hidden ? least_area / 10 : least_area))
          continue;
        for (std::uint32_t y = r > 0 ? r - 1 : 0; y <= std::min(r + 1, block_rows_ - 1); ++y)
          for (std::uint32_t x = c > 0 ? c - 1 : 0; x <= std::min(c + 1, block_columns_ - 1); ++x)
            level.blocks[y * block_columns_ + x] = 1;
      }
  }
  const auto mark = [&](bool Item::*flag) {
    for (auto& item : items_)
      for (const auto& level : levels_)
        if (std::abs(static_cast<double>(item.height) - level.height) < tolerance && level.blocks[item.block] != 0)
          item.*flag = true;
  };
  mark(&Item::large);
  drop_furniture();
  mark(&Item::main);
}

/// In a small room a bed is a main level. What has a larger level so near above or below that nobody can stand between
/// them is neither floor nor ceiling there.
void UprightView::drop_furniture() {
  constexpr double step = 0.3, headroom = 1.5;  // metres
  const std::vector<Level> all = levels_;
  const auto is_near = [&](const Level& level, std::uint32_t row, std::uint32_t column) {
    for (std::uint32_t y = row > 0 ? row - 1 : 0; y <= std::min(row + 1, block_rows_ - 1); ++y)
      for (std::uint32_t x = column > 0 ? column - 1 : 0; x <= std::min(column + 1, block_columns_ - 1); ++x)
        if (level.blocks[y * block_columns_ + x] != 0) return true;
    return false;
  };
  for (auto& level : levels_)
    for (const auto& other : all) {
      const double apart_by = std::abs(other.height - level.height);
      if (other.area <= level.area || apart_by <= step || apart_by >= headroom) continue;
      for (std::uint32_t r = 0; r < block_rows_; ++r)
        for (std::uint32_t c = 0; c < block_columns_; ++c)
          if (level.blocks[r * block_columns_ + c] != 0 && is_near(other, r, c))
            level.blocks[r * block_columns_ + c] = 0;
    }
}

std::int64_t UprightView::neighbour(std::uint32_t column, int rows, int columns) const {
  const std::int64_t at = keys_[column] % wide_ + columns, key = keys_[column] + rows * wide_ + columns;
  if (at < 0 || at >= wide_) return -1;
  const auto found = std::lower_bound(keys_.begin(), keys_.end(), key);
  return found == keys_.end() || *found != key ? -1 : found - keys_.begin();
}

Eigen::Vector2d UprightView::place_of(std::uint32_t column) const {
  const auto row = keys_[column] / wide_, place = keys_[column] % wide_;
  return cell_ * Eigen::Vector2d(static_cast<double>(row), static_cast<double>(place));
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
