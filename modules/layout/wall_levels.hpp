#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "modules/layout/face_evidence.hpp"

namespace atrium::layout {

/// How far a wall's surface lies before its face, in squares.
struct WallLevels {
  double pixel = 0;  ///< edge of a square, metres
  int width = 0, height = 0;
  std::vector<float> squares;  ///< how far before the face its surface lies, metres; NaN without points

  float at(int x, int y) const {
    return squares[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
};

/// Squares x0 ≤ x < x1, y0 ≤ y < y1.
struct LevelBlock {
  int x0, x1, y0, y1;
  double area() const { return static_cast<double>(std::max(0, x1 - x0)) * std::max(0, y1 - y0); }
  /// The common part, of the larger of both.
  double shared(const LevelBlock& other) const {
    const LevelBlock both{std::max(x0, other.x0), std::min(x1, other.x1), std::max(y0, other.y0),
                          std::min(y1, other.y1)};
    return both.area() / std::max(area(), other.area());
  }
  bool touches(const LevelBlock& other) const {
    return x0 <= other.x1 && other.x0 <= x1 && y0 <= other.y1 && other.y0 <= y1;
  }
};

/// The levels of a face from its evidence's `near` points: each square of 5 cm (10 cm at most where points are sparse)
/// has the middle of its foremost surface. No squares where points are sparser than that. Cost: a sort of the points.
WallLevels levels_of(const FaceEvidence& evidence);

/// Number, mean and scatter of levels.
struct Spread {
  double count = 0, sum = 0, squares = 0;
  double mean() const { return sum / count; }
  double scatter() const { return squares - sum * sum / count; }
  Spread& operator+=(const Spread& other) {
    count += other.count;
    sum += other.sum;
    squares += other.squares;
    return *this;
  }
};

/// Sums over all squares below and left of a corner.
class LevelSums {
 public:
  explicit LevelSums(const WallLevels& levels) : stride_(static_cast<std::size_t>(levels.width) + 1) {
    sums_.resize(stride_ * (static_cast<std::size_t>(levels.height) + 1));
    for (int y = 0; y < levels.height; ++y) {
      Spread row;
      for (int x = 0; x < levels.width; ++x) {
        if (const double d = levels.at(x, y); !std::isnan(d)) row += {1, d, d * d};
        Spread all = at(x + 1, y);
        all += row;
        sums_[index(x + 1, y + 1)] = all;
      }
    }
  }
  Spread in(const LevelBlock& b) const {
    const Spread &a = at(b.x1, b.y1), &left = at(b.x0, b.y1), &below = at(b.x1, b.y0), &both = at(b.x0, b.y0);
    return {a.count - left.count - below.count + both.count, a.sum - left.sum - below.sum + both.sum,
            a.squares - left.squares - below.squares + both.squares};
  }

 private:
  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * stride_ + static_cast<std::size_t>(x); }
  const Spread& at(int x, int y) const { return sums_[index(x, y)]; }

  std::size_t stride_;
  std::vector<Spread> sums_;
};

}  // namespace atrium::layout
