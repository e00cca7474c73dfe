#include "modules/layout/room_necks.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <deque>
#include <map>

#include "modules/layout/coverage.hpp"

namespace atrium::layout {
namespace {

constexpr double least_neck = 0.4;  // metres
constexpr double least_part = 0.5;  // square metres as far from the border as half a neck
constexpr double finest = 0.05;     // metres
constexpr double most_squares = 1e6;

constexpr std::int32_t none = -1;

/// Cells as squares, one square of border around them.
class RoomSquares {
 public:
  RoomSquares(const StoreyCells& storey, const std::vector<std::size_t>& cells) : storey_(storey), cells_(cells) {
    Eigen::AlignedBox2d box;
    for (const auto c : cells)
      for (const auto v : storey.cells[c].corners) box.extend(storey.vertices[v]);
    pixel_ = std::max(finest, std::sqrt(box.volume() / most_squares));
    low_ = box.min() - Eigen::Vector2d::Constant(pixel_);
    width_ = static_cast<std::size_t>(box.sizes().x() / pixel_) + 3;
    height_ = static_cast<std::size_t>(box.sizes().y() / pixel_) + 3;
    cell_.assign(width_ * height_, none);
    for (std::size_t k = 0; k < cells.size(); ++k) paint(static_cast<std::int32_t>(k));
  }

  /// Whether squares are small enough to see a neck.
  bool fine() const { return pixel_ <= least_neck / 4; }

  /// The parts' cells, as in parted_at_necks.
  std::vector<std::vector<std::size_t>> parts() {
    const std::vector<bool> core = eroded();
    std::vector<std::int32_t> part(cell_.size(), none);
    const std::size_t count = number_parts(core, part);
    if (count < 2) return {cells_};
    spread(part);
    std::vector<std::vector<std::size_t>> squares(cells_.size(), std::vector<std::size_t>(count, 0));
    std::vector<std::size_t> all(cells_.size(), 0);
    for (std::size_t i = 0; i < cell_.size(); ++i) {
      if (cell_[i] == none) continue;
      const auto k = static_cast<std::size_t>(cell_[i]);
      ++all[k];
      if (part[i] != none) ++squares[k][static_cast<std::size_t>(part[i])];
    }
    std::vector<std::int32_t> of_cell(cells_.size(), none);
    for (std::size_t k = 0; k < cells_.size(); ++k) {
      const auto most = std::max_element(squares[k].begin(), squares[k].end());
      constexpr std::size_t share = 4;  // of its squares
      if (*most > 0 && share * *most >= all[k]) of_cell[k] = static_cast<std::int32_t>(most - squares[k].begin());
    }
    give_corners(of_cell);
    std::vector<std::vector<std::size_t>> result(count);
    for (std::size_t k = 0; k < cells_.size(); ++k)
      if (of_cell[k] >= 0) result[static_cast<std::size_t>(of_cell[k])].push_back(cells_[k]);
    std::erase_if(result, [](const auto& part) { return part.empty(); });
    return result;
  }

 private:
  void paint(std::int32_t k) {
    const auto& corners = storey_.cells[cells_[static_cast<std::size_t>(k)]].corners;
    Eigen::AlignedBox2d box;
    for (const auto v : corners) box.extend(storey_.vertices[v]);
    const auto square = [&](double at, Eigen::Index axis) {
      return static_cast<std::size_t>(std::max(0.0, std::floor((at - low_[axis]) / pixel_)));
    };
    for (std::size_t y = square(box.min().y(), 1); y <= square(box.max().y(), 1); ++y)
      for (std::size_t x = square(box.min().x(), 0); x <= square(box.max().x(), 0); ++x)
        if (is_inside(storey_.vertices, corners,
                      low_ + Eigen::Vector2d(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5) * pixel_))
          cell_[y * width_ + x] = k;
  }

  /// Calls at(square) for the four beside one within the border.
  template <class At>
  void beside(std::size_t i, const At& at) const {
    for (const std::size_t k : {i - 1, i + 1, i - width_, i + width_}) at(k);
  }

  /// RoomSquares that a disc of half a neck around them has no other than squares of cells in.
  std::vector<bool> eroded() const {
    std::vector<bool> core(cell_.size());
    for (std::size_t i = 0; i < cell_.size(); ++i) core[i] = cell_[i] != none;
    // Crosses and squares in turn: an octagon.
    const int steps = static_cast<int>(std::lround(least_neck / 2 / pixel_));
    for (int step = 0; step < steps; ++step) {
      std::vector<bool> next = core;
      for (std::size_t y = 1; y + 1 < height_; ++y)
        for (std::size_t x = 1; x + 1 < width_; ++x) {
          const std::size_t i = y * width_ + x;
          if (core[i]) continue;
          beside(i, [&](std::size_t k) { next[k] = false; });
          if (step % 2 == 0) continue;
          for (const std::size_t k : {i - 1 - width_, i + 1 - width_, i - 1 + width_, i + 1 + width_}) next[k] = false;
        }
      core = std::move(next);
    }
    return core;
  }

  /// Numbers the connected pieces of the core that are large enough; how many there are.
  std::size_t number_parts(const std::vector<bool>& core, std::vector<std::int32_t>& part) const {
    std::vector<bool> met(core.size(), false);
    std::int32_t count = 0;
    for (std::size_t first = 0; first < core.size(); ++first) {
      if (!core[first] || met[first]) continue;
      std::vector<std::size_t> piece{first};
      met[first] = true;
      for (std::size_t n = 0; n < piece.size(); ++n)
        beside(piece[n], [&](std::size_t k) {
          if (!core[k] || met[k]) return;
          met[k] = true;
          piece.push_back(k);
        });
      if (static_cast<double>(piece.size()) * pixel_ * pixel_ < least_part) continue;
      for (const auto i : piece) part[i] = count;
      ++count;
    }
    return static_cast<std::size_t>(count);
  }

  /// Gives cells of no part, in corners, to the one part that they touch; what touches two is the neck.
  void give_corners(std::vector<std::int32_t>& part) const {
    constexpr std::int32_t several = -2;
    std::map<std::size_t, std::size_t> place;  // of a cell of the storey in cells_
    for (std::size_t k = 0; k < cells_.size(); ++k) place[cells_[k]] = k;
    for (bool changed = true; changed;) {
      changed = false;
      std::vector<std::int32_t> beside(part.size(), none);
      const auto touch = [&](std::size_t k, std::size_t other) {
        if (part[k] != none || part[other] < 0) return;
        beside[k] = beside[k] == none || beside[k] == part[other] ? part[other] : several;
      };
      for (const auto& edge : storey_.edges) {
        constexpr double mostly = 0.5;  // a wall
        if (edge.left < 0 || edge.right < 0 || std::max(edge.wall_left, edge.wall_right) > mostly) continue;
        const auto a = place.find(static_cast<std::size_t>(edge.left));
        const auto b = place.find(static_cast<std::size_t>(edge.right));
        if (a == place.end() || b == place.end()) continue;
        touch(a->second, b->second);
        touch(b->second, a->second);
      }
      for (std::size_t k = 0; k < part.size(); ++k) {
        if (part[k] != none || beside[k] == none) continue;
        part[k] = beside[k];
        changed = true;
      }
    }
  }

  /// Gives the squares around a part to it, as far as the core was taken back.
  void spread(std::vector<std::int32_t>& part) const {
    std::deque<std::pair<std::size_t, int>> front;
    for (std::size_t i = 0; i < part.size(); ++i)
      if (part[i] != none) front.emplace_back(i, 0);
    const int steps = static_cast<int>(std::lround(least_neck / 2 / pixel_));
    while (!front.empty()) {
      const auto [i, step] = front.front();
      front.pop_front();
      if (step == steps) continue;
      beside(i, [&, i = i, step = step](std::size_t k) {
        if (cell_[k] == none || part[k] != none) return;
        part[k] = part[i];
        front.emplace_back(k, step + 1);
      });
    }
  }

  const StoreyCells& storey_;
  const std::vector<std::size_t>& cells_;
  double pixel_ = finest;
  Eigen::Vector2d low_ = Eigen::Vector2d::Zero();
  std::size_t width_ = 0, height_ = 0;
  std::vector<std::int32_t> cell_;  // place in cells_
};

}  // namespace

std::vector<std::vector<std::size_t>> parted_at_necks(const StoreyCells& storey,
                                                      const std::vector<std::size_t>& cells) {
  if (cells.empty()) return {};
  double area = 0;
  for (const auto c : cells) area += storey.cells[c].area;
  if (area < 2 * least_part) return {cells};
  RoomSquares squares(storey, cells);
  return squares.fine() ? squares.parts() : std::vector<std::vector<std::size_t>>{cells};
}

}  // namespace atrium::layout
