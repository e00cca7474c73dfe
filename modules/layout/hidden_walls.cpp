#include "modules/layout/hidden_walls.hpp"

#include <algorithm>
#include <array>

namespace atrium::layout {
namespace {

Eigen::Vector2d to_the_left(const StoreyCells& storey, const CellEdge& edge) {
  const Eigen::Vector2d way = storey.vertices[edge.to] - storey.vertices[edge.from];
  return {-way.y(), way.x()};
}

/// Per line: whether a wall was seen on it that looks along its normal, and one that looks against it.
std::vector<std::array<bool, 2>> seen_sides(const StoreyCells& storey) {
  constexpr double least = 0.1;  // metres
  std::vector<std::array<double, 2>> lengths(storey.lines.size(), {0, 0});
  for (const auto& edge : storey.edges) {
    if (edge.line < 0) continue;
    const auto line = static_cast<std::size_t>(edge.line);
    const Eigen::Vector2d left = to_the_left(storey, edge);
    const bool along = storey.lines[line].normal.dot(left) > 0;
    lengths[line][along ? 0 : 1] += edge.wall_left * left.norm();
    lengths[line][along ? 1 : 0] += edge.wall_right * left.norm();
  }
  std::vector<std::array<bool, 2>> seen(lengths.size());
  for (std::size_t l = 0; l < seen.size(); ++l) seen[l] = {lengths[l][0] > least, lengths[l][1] > least};
  return seen;
}

/// A border of a cell on the line of a wall that looks out of it.
struct Face {
  std::uint32_t edge = 0;
  Eigen::Vector2d out;
};

std::vector<Face> faces_of(const StoreyCells& storey, const std::vector<std::array<bool, 2>>& seen, std::size_t cell) {
  std::vector<Face> result;
  for (const auto e : storey.cells[cell].edges) {
    const CellEdge& edge = storey.edges[e];
    if (edge.line < 0) continue;
    const auto line = static_cast<std::size_t>(edge.line);
    const Eigen::Vector2d left = to_the_left(storey, edge).normalized();
    const Eigen::Vector2d out = edge.left == static_cast<std::int32_t>(cell) ? Eigen::Vector2d(-left) : left;
    if (seen[line][storey.lines[line].normal.dot(out) > 0 ? 0 : 1]) result.push_back({e, out});
  }
  return result;
}

}  // namespace

double width_of(const StoreyCells& storey, const LayoutCell& cell) {
  double longest = 0;
  for (const auto e : cell.edges) longest = std::max(longest, to_the_left(storey, storey.edges[e]).norm());
  return longest > 0 ? cell.area / longest : 0;
}

HiddenWalls hidden_walls(const StoreyCells& storey, bool ceiling_scanned) {
  constexpr double thickest = 0.5, opposite = -0.98;
  constexpr double stray = 0.25, open = 0.75;  // covered by few points of the surroundings, or by its own ceiling
  const auto seen = seen_sides(storey);
  HiddenWalls result;
  result.cells.assign(storey.cells.size(), 0);
  result.left.assign(storey.edges.size(), 0);
  result.right.assign(storey.edges.size(), 0);
  for (std::size_t i = 0; i < storey.cells.size(); ++i) {
    const LayoutCell& cell = storey.cells[i];
    if (!cell.measured || width_of(storey, cell) > thickest) continue;
    const double cover = ceiling_scanned ? cell.ceiling_cover : cell.floor_cover;
    const double share = std::clamp((open - cover) / (open - stray), 0.0, 1.0);
    const std::vector<Face> faces = faces_of(storey, seen, i);
    for (const Face& face : faces) {
      if (std::none_of(faces.begin(), faces.end(), [&](const Face& f) { return f.out.dot(face.out) < opposite; }))
        continue;
      result.cells[i] = share;
      (storey.edges[face.edge].right == static_cast<std::int32_t>(i) ? result.left : result.right)[face.edge] = share;
    }
  }
  return result;
}

}  // namespace atrium::layout
