#include "modules/layout/plan_cells.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace atrium::layout {
namespace {

double area_of(const std::vector<Eigen::Vector2d>& vertices, const std::vector<std::uint32_t>& corners) {
  double twice = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d a = vertices[corners[i]] - vertices[corners[0]];
    const Eigen::Vector2d b = vertices[corners[(i + 1) % corners.size()]] - vertices[corners[0]];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

}  // namespace

Eigen::AlignedBox2d extent_of(const std::vector<const std::vector<CellSurface>*>& levels,
                              const std::vector<WallLine>& walls, const std::vector<Footprint>& footprints) {
  Eigen::AlignedBox2d box;
  for (const auto* surfaces : levels)
    for (const auto& s : *surfaces)
      for (const auto p : primitives_of(s)) {
        const Raster& r = footprints[static_cast<std::size_t>(p)].raster;
        box.extend(r.low);
        box.extend(r.high());
      }
  for (const auto& wall : walls) {
    const Eigen::Vector2d foot = -wall.line.offset * wall.line.normal;
    box.extend(foot + wall.begin * wall.line.along());
    box.extend(foot + wall.end * wall.line.along());
  }
  return box;
}

void take_cells(const Arrangement& arrangement, StoreyCells& storey) {
  storey.vertices = arrangement.vertices();
  std::unordered_map<std::uint64_t, std::uint32_t> edges;  // by their vertices
  for (const auto& source : arrangement.cells()) {
    const auto index = static_cast<std::int32_t>(storey.cells.size());
    LayoutCell cell;
    cell.corners = source.corners;
    cell.area = area_of(storey.vertices, cell.corners);
    for (std::size_t i = 0; i < source.corners.size(); ++i) {
      const std::uint32_t a = source.corners[i];
      const std::uint32_t b = source.corners[(i + 1) % source.corners.size()];
      const std::uint64_t key = (std::uint64_t{std::min(a, b)} << 32U) | std::max(a, b);
      const auto [it, is_new] = edges.emplace(key, static_cast<std::uint32_t>(storey.edges.size()));
      if (is_new) {
        storey.edges.push_back({a, b, index, -1, source.lines[i]});
      } else {
        CellEdge& edge = storey.edges[it->second];
        (edge.from == a ? edge.left : edge.right) = index;
        edge.line = std::max(edge.line, source.lines[i]);
      }
      cell.edges.push_back(it->second);
    }
    storey.cells.push_back(std::move(cell));
  }
}

/// The sides of the box are lines too, for rooms that nothing ends before.
void add_border(const Eigen::AlignedBox2d& box, StoreyCells& storey) {
  const auto first = static_cast<std::int32_t>(storey.lines.size());
  for (int side = 0; side < 4; ++side)
    storey.lines.push_back({Eigen::Vector2d::Unit(side / 2), -(side % 2 == 0 ? box.min() : box.max())[side / 2], {}});
  for (auto& edge : storey.edges) {
    if (edge.line >= 0) continue;
    const Eigen::Vector2d middle = (storey.vertices[edge.from] + storey.vertices[edge.to]) / 2;
    const auto off = [&](std::int32_t line) {
      const CellLine& l = storey.lines[static_cast<std::size_t>(line)];
      return std::abs(l.normal.dot(middle) + l.offset);
    };
    edge.line = first;
    for (std::int32_t line = first + 1; line < first + 4; ++line)
      if (off(line) < off(edge.line)) edge.line = line;
  }
}

}  // namespace atrium::layout
