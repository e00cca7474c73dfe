#include "modules/layout/face_mask.hpp"

#include <algorithm>
#include <cmath>

#include "modules/geometry/quantile.hpp"

namespace atrium::layout {
namespace {

/// Sums of a picture over rectangles.
class Sums {
 public:
  Sums(int width, int height) : width_(width), height_(height) {
    sums_.assign((static_cast<std::size_t>(width) + 1) * (static_cast<std::size_t>(height) + 1), 0);
  }
  void add(int x, int y) { ++sums_[index(x + 1, y + 1)]; }
  void finish() {
    for (int y = 1; y <= height_; ++y)
      for (int x = 1; x <= width_; ++x)
        sums_[index(x, y)] += sums_[index(x - 1, y)] + sums_[index(x, y - 1)] - sums_[index(x - 1, y - 1)];
  }
  /// Of the squares at most `reach` away in x and in y.
  std::uint32_t around(int x, int y, int reach) const {
    const int x0 = std::max(0, x - reach), x1 = std::min(width_, x + reach + 1);
    const int y0 = std::max(0, y - reach), y1 = std::min(height_, y + reach + 1);
    return sums_[index(x1, y1)] - sums_[index(x0, y1)] - sums_[index(x1, y0)] + sums_[index(x0, y0)];
  }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * (static_cast<std::size_t>(width_) + 1) + static_cast<std::size_t>(x);
  }
  int width_, height_;
  std::vector<std::uint32_t> sums_;  // of all squares below and to the left
};

constexpr std::uint32_t handful = 6;  // a square with as many on average is empty once in e⁶ = 403 times

/// How far around each square a handful of points lies; −1: too few even at the farthest.
int reach_of(const Sums& sums, int x, int y, int farthest) {
  for (int reach = 0; reach <= farthest; ++reach)
    if (sums.around(x, y, reach) >= handful) return reach;
  return 2 * sums.around(x, y, farthest) >= handful ? farthest : -1;
}

}  // namespace

FaceMask::FaceMask(const Eigen::AlignedBox2d& box, double pixel) : box_(box), pixel_(pixel) {
  width_ = std::max(1, static_cast<int>(std::ceil(box.sizes().x() / pixel)));
  height_ = std::max(1, static_cast<int>(std::ceil(box.sizes().y() / pixel)));
  squares_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), Square::outside);
}

std::optional<Eigen::Vector2i> FaceMask::square_of(const Eigen::Vector2d& p) const {
  const Eigen::Vector2d at = (p - box_.min()) / pixel_;
  if (!(at.x() >= 0 && at.y() >= 0 && at.x() < width_ && at.y() < height_)) return std::nullopt;
  return Eigen::Vector2i(static_cast<int>(at.x()), static_cast<int>(at.y()));
}

Square FaceMask::at(const Eigen::Vector2d& p) const {
  const auto square = square_of(p);
  return square ? at(square->x(), square->y()) : Square::outside;
}

double FaceMask::cover(const std::vector<Eigen::Vector2d>& points, double farthest) {
  constexpr double most = 0.95;
  Sums sums(width_, height_);
  std::vector<Eigen::Vector2i> occupied;
  std::vector<bool> seen(squares_.size(), false);
  for (const auto& p : points)
    if (const auto square = square_of(p)) {
      sums.add(square->x(), square->y());
      const std::size_t i = index(square->x(), square->y());
      if (!seen[i]) occupied.push_back(*square);
      seen[i] = true;
    }
  if (occupied.empty()) return 0;
  sums.finish();
  std::vector<int> reaches, sorted;
  for (const auto& p : occupied)
    reaches.push_back(reach_of(sums, p.x(), p.y(), static_cast<int>(std::lround(farthest / pixel_))));
  for (const int reach : reaches)
    if (reach >= 0) sorted.push_back(reach);
  const int usual = sorted.empty() ? 0 : quantile(std::move(sorted), most);
  for (std::size_t i = 0; i < occupied.size(); ++i) {
    const Eigen::Vector2i& p = occupied[i];
    const bool dense = reaches[i] >= 0 && reaches[i] <= usual;
    const bool half_as_dense = 2 * sums.around(p.x(), p.y(), usual) >= handful;  // strays are not
    const int reach = dense ? reaches[i] : half_as_dense ? usual : 0;
    for (int y = std::max(0, p.y() - reach); y <= std::min(height_ - 1, p.y() + reach); ++y)
      for (int x = std::max(0, p.x() - reach); x <= std::min(width_ - 1, p.x() + reach); ++x)
        if (at(x, y) == Square::hidden) at(x, y) = Square::solid;
  }
  return usual * pixel_;
}

FaceMask FaceMask::eroded(double margin) const {
  const int reach = static_cast<int>(std::ceil(margin / pixel_));
  Sums free(width_, height_);
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x)
      if (at(x, y) == Square::hidden || at(x, y) == Square::hole) free.add(x, y);
  free.finish();
  FaceMask result = *this;
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x)
      if (at(x, y) == Square::solid && free.around(x, y, reach) > 0) result.at(x, y) = Square::hidden;
  return result;
}

void FaceMask::drop_narrow(int side) {
  constexpr double most = 0.7;
  const int reach = std::max(0, side / 2 - 1);
  if (reach == 0) return;
  Sums hidden(width_, height_), kept(width_, height_);
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x)
      if (at(x, y) == Square::hidden) hidden.add(x, y);
  hidden.finish();
  const int block = 2 * reach + 1;
  for (int y = reach; y < height_ - reach; ++y)
    for (int x = reach; x < width_ - reach; ++x)
      if (at(x, y) == Square::hidden && hidden.around(x, y, reach) >= most * block * block) kept.add(x, y);
  kept.finish();
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x)
      if (at(x, y) == Square::hidden && kept.around(x, y, reach + 1) == 0) at(x, y) = Square::solid;
}

std::vector<Eigen::AlignedBox2i> FaceMask::parts() const {
  std::vector<Eigen::AlignedBox2i> result;
  std::vector<bool> seen(squares_.size(), false);
  std::vector<Eigen::Vector2i> part;
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      part.assign(1, {x, y});
      Eigen::AlignedBox2i box;
      for (std::size_t i = 0; i < part.size(); ++i) {
        const Eigen::Vector2i p = part[i];
        if (p.x() < 0 || p.y() < 0 || p.x() >= width_ || p.y() >= height_) continue;
        if (at(p.x(), p.y()) != Square::hole || seen[index(p.x(), p.y())]) continue;
        seen[index(p.x(), p.y())] = true;
        box.extend(p);
        for (const auto& way : {Eigen::Vector2i(1, 0), {-1, 0}, {0, 1}, {0, -1}}) part.emplace_back(p + way);
      }
      if (!box.isEmpty()) result.push_back(box);
    }
  return result;
}

std::optional<Eigen::AlignedBox2i> FaceMask::best_rectangle(const Eigen::AlignedBox2i& within, double least) const {
  const auto weight = [&](int x, int y) {
    switch (at(x, y)) {
      case Square::hole: return 1.0;
      case Square::hidden: return -0.5;
      case Square::solid: return -2.0;
      default: return -1e6;
    }
  };
  double most = std::max(0.0, least);
  std::optional<Eigen::AlignedBox2i> result;
  std::vector<double> columns(static_cast<std::size_t>(within.sizes().x()) + 1);
  for (int y0 = within.min().y(); y0 <= within.max().y(); ++y0) {
    std::fill(columns.begin(), columns.end(), 0);
    for (int y1 = y0; y1 <= within.max().y(); ++y1) {
      // The run of columns with the largest sum (Kadane).
      double sum = 0;
      int first = within.min().x();
      for (int x = within.min().x(); x <= within.max().x(); ++x) {
        double& column = columns[static_cast<std::size_t>(x - within.min().x())];
        column += weight(x, y1);
        if (sum <= 0) {
          sum = 0;
          first = x;
        }
        sum += column;
        if (sum <= most) continue;
        most = sum;
        result = Eigen::AlignedBox2i(Eigen::Vector2i(first, y0), Eigen::Vector2i(x, y1));
      }
    }
  }
  return result;
}

Eigen::AlignedBox2i FaceMask::squares_in(const Eigen::AlignedBox2d& box) const {
  const auto nearest = [&](const Eigen::Vector2d& p) -> Eigen::Vector2i {
    const Eigen::Array2d at = ((p - box_.min()) / pixel_).array().floor();
    return at.max(0).min(Eigen::Array2d(width_ - 1, height_ - 1)).cast<int>().matrix();
  };
  const Eigen::Vector2d half = Eigen::Vector2d::Constant(0.499 * pixel_);
  const Eigen::Vector2i low = nearest(box.min() + half), high = nearest(box.max() - half);
  return {low, low.cwiseMax(high)};
}

std::size_t FaceMask::count(const Eigen::AlignedBox2i& squares, Square what) const {
  std::size_t result = 0;
  for (int y = squares.min().y(); y <= squares.max().y(); ++y)
    for (int x = squares.min().x(); x <= squares.max().x(); ++x) result += at(x, y) == what ? 1 : 0;
  return result;
}

void FaceMask::fill(const Eigen::AlignedBox2i& squares, Square what) {
  for (int y = squares.min().y(); y <= squares.max().y(); ++y)
    for (int x = squares.min().x(); x <= squares.max().x(); ++x) at(x, y) = what;
}

}  // namespace atrium::layout
