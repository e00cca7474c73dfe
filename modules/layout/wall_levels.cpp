#include "modules/layout/wall_levels.hpp"

#include <cstdint>
#include <limits>
#include <utility>

namespace atrium::layout {
namespace {

using SquarePoints = std::vector<std::pair<std::uint32_t, float>>;  // a point's square, and how far before the face

/// The middle of the foremost surface of a square, of its points from back to front. What shows behind it was seen from
/// the other side of the wall.
float front_level(SquarePoints::const_iterator begin, SquarePoints::const_iterator end) {
  constexpr float thickness = 0.03F;          // metres: of a surface's points
  constexpr std::ptrdiff_t few = 2, all = 7;  // a surface has at least two points, and a seventh of them all
  const std::ptrdiff_t enough = std::max(few, (end - begin) / all);
  for (auto front = end; front - begin >= enough; --front) {
    auto back = front - 1;
    while (back != begin && (front - 1)->second - (back - 1)->second <= thickness) --back;
    if (front - back >= enough) return (back + (front - back) / 2)->second;
  }
  return (begin + (end - begin) / 2)->second;
}

}  // namespace

WallLevels levels_of(const FaceEvidence& evidence) {
  constexpr double least = 0.05, most = 0.1;  // metres
  constexpr double points_per_square = 3;
  const Eigen::AlignedBox2d& box = evidence.mask.box();
  WallLevels levels;
  const double spacing = std::sqrt(box.volume() / std::max<double>(1, static_cast<double>(evidence.near.size())));
  levels.pixel = std::max(least, std::sqrt(points_per_square) * spacing);
  if (levels.pixel > most) return levels;
  levels.width = std::max(1, static_cast<int>(std::ceil(box.sizes().x() / levels.pixel)));
  levels.height = std::max(1, static_cast<int>(std::ceil(box.sizes().y() / levels.pixel)));
  const auto squares = static_cast<std::size_t>(levels.width) * static_cast<std::size_t>(levels.height);
  SquarePoints points;
  points.reserve(evidence.near.size());
  for (const auto& p : evidence.near) {
    const int x = static_cast<int>((p.x() - box.min().x()) / levels.pixel);
    const int y = static_cast<int>((p.y() - box.min().y()) / levels.pixel);
    if (x < 0 || y < 0 || x >= levels.width || y >= levels.height) continue;
    points.emplace_back(
        static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(levels.width) + static_cast<std::uint32_t>(x),
        p.z());
  }
  std::sort(points.begin(), points.end());
  levels.squares.assign(squares, std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 0, end = 0; i < points.size(); i = end) {
    for (end = i; end < points.size() && points[end].first == points[i].first;) ++end;
    levels.squares[points[i].first] =
        front_level(points.begin() + static_cast<std::ptrdiff_t>(i), points.begin() + static_cast<std::ptrdiff_t>(end));
  }
  return levels;
}

}  // namespace atrium::layout
