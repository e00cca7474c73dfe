#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

namespace atrium::layout {

/// What is known of a square of a face.
enum class Square : std::uint8_t {
  outside,  ///< not of the face
  solid,    ///< points lie on it, or around it as densely as they do there
  hidden,   ///< no points, and nothing says why
  hole      ///< no points although it was in sight
};

/// A face as squares, in its own plane's coordinates.
class FaceMask {
 public:
  FaceMask() = default;
  FaceMask(const Eigen::AlignedBox2d& box, double pixel);

  int width() const { return width_; }
  int height() const { return height_; }
  double pixel() const { return pixel_; }
  const Eigen::AlignedBox2d& box() const { return box_; }
  Eigen::Vector2d centre(int x, int y) const { return box_.min() + Eigen::Vector2d(x + 0.5, y + 0.5) * pixel_; }
  Square& at(int x, int y) { return squares_[index(x, y)]; }
  Square at(int x, int y) const { return squares_[index(x, y)]; }
  /// Of the square that a place lies in.
  Square at(const Eigen::Vector2d& p) const;

  /// Turns hidden squares with points in or around them into solid ones. Around: as far as a square of the same size
  /// about a point must reach to hold a handful of points, so sparse surfaces are closed and dense ones keep sharp
  /// edges; at most `farthest`. Points with less than half of that around them as far as most points reach are strays:
  /// they cover their own square only. Returns how far most
  /// points reach, metres.
  double cover(const std::vector<Eigen::Vector2d>& points, double farthest);
  /// The mask without the solid squares at most `margin` away from hidden ones or holes: those become hidden.
  FaceMask eroded(double margin) const;
  /// Hidden squares that lie in no hidden block of this many squares a side (about) become solid.
  void drop_narrow(int side);
  /// The rectangle with the most hole squares and the fewest others: of all that lie in the given one, that with the
  /// largest sum of weights (1 for a hole). Nothing if no sum is above `least`.
  std::optional<Eigen::AlignedBox2i> best_rectangle(const Eigen::AlignedBox2i& within, double least) const;
  /// The bounds of the connected parts of the hole squares.
  std::vector<Eigen::AlignedBox2i> parts() const;
  /// Those whose middles lie in a box; the nearest if there are none.
  Eigen::AlignedBox2i squares_in(const Eigen::AlignedBox2d& box) const;
  std::size_t count(const Eigen::AlignedBox2i& squares, Square what) const;
  void fill(const Eigen::AlignedBox2i& squares, Square what);

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  std::optional<Eigen::Vector2i> square_of(const Eigen::Vector2d& p) const;

  Eigen::AlignedBox2d box_;
  double pixel_ = 1;
  int width_ = 0, height_ = 0;
  std::vector<Square> squares_;
};

}  // namespace atrium::layout
