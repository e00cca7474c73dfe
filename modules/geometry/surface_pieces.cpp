#include "modules/geometry/surface_pieces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "modules/geometry/point_tree.hpp"
#include "modules/geometry/symmetric_eigen.hpp"

namespace atrium {
namespace {

constexpr std::size_t most_pieces = 150000;
constexpr int most_doublings = 4;

/// The cube that a place is in, as one number; 21 bits an axis, which is 100 km at 5 cm.
std::uint64_t cube_of(const Eigen::Vector3f& place, double size) {
  std::uint64_t key = 0;
  for (int k = 0; k < 3; ++k) {
    const double cell = std::clamp(std::floor(static_cast<double>(place[k]) / size), -1048575.0, 1048575.0);
    key = key << 21 | static_cast<std::uint64_t>(static_cast<std::int64_t>(cell) + 1048576);
  }
  return key;
}

/// The first point of each cube, in the order of the points.
std::vector<SurfacePiece> one_a_cube(const std::vector<SurfacePiece>& points, double size) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) keys[i] = {cube_of(points[i].place, size), i};
  std::sort(keys.begin(), keys.end());
  std::vector<SurfacePiece> result;
  // Within a cube a point on a plane comes before one on none.
  for (std::size_t i = 0; i < keys.size();) {
    std::size_t end = i, chosen = i;
    for (; end < keys.size() && keys[end].first == keys[i].first; ++end)
      if (points[keys[chosen].second].normal.isZero() && !points[keys[end].second].normal.isZero()) chosen = end;
    result.push_back(points[keys[chosen].second]);
    i = end;
  }
  return result;
}

/// The normal of the points around, or zero if they do not lie in a plane.
Eigen::Vector3f local_normal(const std::vector<Eigen::Vector3f>& points, const std::vector<Neighbour>& around) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& n : around) mean += points[n.index].cast<double>() / static_cast<double>(around.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const auto& n : around) {
    const Eigen::Vector3d d = points[n.index].cast<double>() - mean;
    spread += d * d.transpose();
  }
  const SymmetricEigen axes = symmetric_eigen(spread);
  constexpr double flat = 0.1;  // of the second variance: a thickness of a third of the width
  if (!(axes.values[0] < flat * axes.values[1])) return Eigen::Vector3f::Zero();
  return axes.vectors.col(0).cast<float>();
}

}  // namespace

SurfacePieces thin_to_pieces(const std::vector<SurfacePiece>& points, double smallest) {
  SurfacePieces result{one_a_cube(points, smallest), smallest};
  for (int i = 0; i < most_doublings; ++i) {
    auto coarser = one_a_cube(result.pieces, 2 * result.size);
    constexpr double full = 2.8;  // a surface without gaps has a quarter of the squares, and some more at its borders
    const bool gaps = static_cast<double>(result.pieces.size()) < full * static_cast<double>(coarser.size());
    if (!gaps && result.pieces.size() <= most_pieces) break;
    result = {std::move(coarser), 2 * result.size};
  }
  return result;
}

std::vector<SurfacePiece> pieces_with_normals(const std::vector<Eigen::Vector3f>& points, std::size_t most,
                                              const Context& context) {
  std::vector<Eigen::Vector3f> chosen;
  const std::size_t step = std::max<std::size_t>(1, (points.size() + most - 1) / std::max<std::size_t>(most, 1));
  for (std::size_t i = 0; i < points.size(); i += step) chosen.push_back(points[i]);
  const PointTree tree(chosen, context);
  std::vector<SurfacePiece> result(chosen.size());
  context.parallel_for(chosen.size(), [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbour> around;
    for (std::size_t k = begin; k < end; ++k) {
      const auto i = tree.order()[k];
      constexpr std::size_t neighbours = 12;
      tree.k_nearest(chosen[i], neighbours, around);
      result[i] = {chosen[i], around.size() < 4 ? Eigen::Vector3f::Zero().eval() : local_normal(chosen, around)};
    }
  });
  return result;
}

}  // namespace atrium
