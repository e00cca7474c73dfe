#include "modules/layout/arrangement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace atrium::layout {

Arrangement::Arrangement(const Eigen::Vector2d& low, const Eigen::Vector2d& high, double tolerance)
    : vertices_{low, {high.x(), low.y()}, high, {low.x(), high.y()}},
      cells_{{{0, 1, 2, 3}, {-1, -1, -1, -1}}},
      tolerance_(tolerance) {
  for (std::uint32_t i = 0; i < 4; ++i) owner_[key(i, (i + 1) % 4)] = 0;
}

bool Arrangement::meets(const Cell& cell, const Line& line, double begin, double end) const {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  double low = least, high = most;  // where the line enters and leaves the cell
  const Eigen::Vector2d along = line.along();
  for (std::size_t i = 0; i < cell.corners.size(); ++i) {
    const Eigen::Vector2d& a = vertices_[cell.corners[i]];
    const Eigen::Vector2d& b = vertices_[cell.corners[(i + 1) % cell.corners.size()]];
    const double at_a = line.side(a);
    const double at_b = line.side(b);
    least = std::min(least, at_a);
    most = std::max(most, at_a);
    if ((at_a < 0) == (at_b < 0)) continue;
    const double t = along.dot(a + (b - a) * (at_a / (at_a - at_b)));
    low = std::min(low, t);
    high = std::max(high, t);
  }
  return least < -tolerance_ && most > tolerance_ && low < end && high > begin;
}

void Arrangement::insert_corner(std::size_t cell, std::uint32_t from, std::uint32_t to, std::uint32_t vertex) {
  Cell& c = cells_[cell];
  for (std::size_t i = 0; i < c.corners.size(); ++i) {
    if (c.corners[i] != from || c.corners[(i + 1) % c.corners.size()] != to) continue;
    const auto at = static_cast<std::ptrdiff_t>(i) + 1;
    c.corners.insert(c.corners.begin() + at, vertex);
    c.lines.insert(c.lines.begin() + at, c.lines[i]);
    break;
  }
  owner_.erase(key(from, to));
  owner_[key(from, vertex)] = cell;
  owner_[key(vertex, to)] = cell;
}

void Arrangement::split_edge(std::size_t cell, std::size_t side, const Line& line) {
  const std::uint32_t a = cells_[cell].corners[side];
  const std::uint32_t b = cells_[cell].corners[(side + 1) % cells_[cell].corners.size()];
  // In the same order from both sides: the same place to the last bit.
  const Eigen::Vector2d& p = vertices_[std::min(a, b)];
  const Eigen::Vector2d& q = vertices_[std::max(a, b)];
  const double at_p = line.side(p);
  const double at_q = line.side(q);
  const auto vertex = static_cast<std::uint32_t>(vertices_.size());
  vertices_.emplace_back(p + (q - p) * (at_p / (at_p - at_q)));
  const auto other = owner_.find(key(b, a));
  if (other != owner_.end()) insert_corner(other->second, b, a, vertex);
  insert_corner(cell, a, b, vertex);
}

int Arrangement::side_of(std::uint32_t vertex, const Line& line) const {
  const double side = line.side(vertices_[vertex]);
  return std::abs(side) <= tolerance_ ? 0 : side < 0 ? -1 : 1;
}

Arrangement::Cell Arrangement::part(const Cell& whole, std::size_t first, std::size_t last, std::int32_t id) {
  Cell result;
  for (std::size_t i = first; i != last; i = (i + 1) % whole.corners.size()) {
    result.corners.push_back(whole.corners[i]);
    result.lines.push_back(whole.lines[i]);
  }
  result.corners.push_back(whole.corners[last]);
  result.lines.push_back(id);
  return result;
}

void Arrangement::cut_cell(std::size_t cell, std::int32_t id, const Line& line) {
  for (std::size_t i = 0; i < cells_[cell].corners.size(); ++i) {
    const std::uint32_t a = cells_[cell].corners[i];
    const std::uint32_t b = cells_[cell].corners[(i + 1) % cells_[cell].corners.size()];
    if (side_of(a, line) * side_of(b, line) < 0) split_edge(cell, i++, line);
  }
  // The cell is convex but for the tolerance: the corners of one side stand together.
  const Cell& whole = cells_[cell];
  const std::size_t n = whole.corners.size();
  const auto side = [&](std::size_t i) { return side_of(whole.corners[i % n], line); };
  std::size_t first = 0;  // the first corner on the positive side
  while (first < n && !(side(first) > 0 && side(first + n - 1) <= 0)) ++first;
  if (first == n) return;
  std::size_t last = first;
  while (side(last + 1) > 0) last = (last + 1) % n;
  const std::size_t enter = (first + n - 1) % n;  // on the line
  const std::size_t leave = (last + 1) % n;
  if (enter == leave || side(enter) != 0 || side(leave) != 0) return;
  Cell positive = part(whole, enter, leave, id);
  Cell negative = part(whole, leave, enter, id);
  if (positive.corners.size() < 3 || negative.corners.size() < 3) return;
  const std::size_t other = cells_.size();
  cells_[cell] = std::move(positive);
  cells_.push_back(std::move(negative));
  for (const std::size_t c : {cell, other}) {
    const auto& corners = cells_[c].corners;
    for (std::size_t i = 0; i < corners.size(); ++i) owner_[key(corners[i], corners[(i + 1) % corners.size()])] = c;
  }
}

void Arrangement::cut(std::int32_t id, const Line& line, double begin, double end) {
  const std::size_t cells = cells_.size();
  for (std::size_t i = 0; i < cells; ++i)
    if (meets(cells_[i], line, begin, end)) cut_cell(i, id, line);
}

bool Arrangement::cut_one(std::size_t cell, std::int32_t id, const Line& line) {
  constexpr double far = std::numeric_limits<double>::infinity();
  const std::size_t before = cells_.size();
  if (meets(cells_[cell], line, -far, far)) cut_cell(cell, id, line);
  return cells_.size() > before;
}

}  // namespace atrium::layout
