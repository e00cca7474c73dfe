#pragma once
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "graph/api/random.hpp"
#include "modules/layout/arrangement.hpp"
#include "modules/layout/room_cells.hpp"
#include "modules/layout/room_surface.hpp"
#include "modules/types/cell_complex.hpp"

namespace atrium::test {

inline layout::Arrangement::Line line_through(const Eigen::Vector2d& p, double heading) {
  const Eigen::Vector2d normal(std::cos(heading), std::sin(heading));
  return {normal, -normal.dot(p)};
}

/// The cells of a box cut along lines, as layout.partition hands them on, with one floor at 0 and one ceiling at 2.5 m.
inline StoreyCells cells_of(const Eigen::Vector2d& low, const Eigen::Vector2d& high,
                            const std::vector<layout::Arrangement::Line>& lines) {
  layout::Arrangement arrangement(low, high, 1e-3);
  StoreyCells storey;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    arrangement.cut(static_cast<std::int32_t>(i), lines[i], -1e9, 1e9);
    storey.lines.push_back({lines[i].normal, lines[i].offset, {}});
  }
  storey.vertices = arrangement.vertices();
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> edges;
  for (const auto& source : arrangement.cells()) {
    const auto index = static_cast<std::int32_t>(storey.cells.size());
    LayoutCell cell;
    cell.corners = source.corners;
    cell.floor = cell.ceiling = 0;
    for (std::size_t i = 0; i < source.corners.size(); ++i) {
      const std::uint32_t a = source.corners[i], b = source.corners[(i + 1) % source.corners.size()];
      const Eigen::Vector2d p = storey.vertices[a], q = storey.vertices[b];
      cell.area += (p.x() * q.y() - p.y() * q.x()) / 2;
      const auto [it, added] = edges.emplace(std::minmax(a, b), static_cast<std::uint32_t>(storey.edges.size()));
      if (added) {
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
  for (int side = 0; side < 4; ++side) {
    const int axis = side / 2;
    const double at = (side % 2 == 0 ? low : high)[axis];
    for (auto& edge : storey.edges)
      if (edge.line < 0 && storey.vertices[edge.from][axis] == at && storey.vertices[edge.to][axis] == at)
        edge.line = static_cast<std::int32_t>(storey.lines.size());
    storey.lines.push_back({Eigen::Vector2d::Unit(axis), -at, {}});
  }
  storey.low = -1;
  storey.high = 4;
  storey.ceiling_height = 2.5;
  storey.floors.push_back({{{0, 0, 1}, 0}, 0});
  storey.ceilings.push_back({{{0, 0, -1}, 2.5}, 1});
  return storey;
}

/// Squares of 1 m, `columns` × `rows`; the cell at (x, y) is grid_cell(storey, x, y).
inline StoreyCells grid_cells(int columns, int rows) {
  std::vector<layout::Arrangement::Line> lines;
  for (int x = 1; x < columns; ++x) lines.push_back({Eigen::Vector2d::UnitX(), -static_cast<double>(x)});
  for (int y = 1; y < rows; ++y) lines.push_back({Eigen::Vector2d::UnitY(), -static_cast<double>(y)});
  return cells_of({0, 0}, {static_cast<double>(columns), static_cast<double>(rows)}, lines);
}
inline Eigen::Vector2d middle_of(const StoreyCells& storey, const LayoutCell& cell) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const auto c : cell.corners) sum += storey.vertices[c];
  return sum / static_cast<double>(cell.corners.size());
}
inline LayoutCell& grid_cell(StoreyCells& storey, int x, int y) {
  const auto it = std::find_if(storey.cells.begin(), storey.cells.end(), [&](const LayoutCell& cell) {
    return (middle_of(storey, cell) - Eigen::Vector2d(x + 0.5, y + 0.5)).norm() < 1e-6;
  });
  return *it;
}
/// Rooms from a picture, the first line at the top: '.' is outside, 'a' room 0, 'b' room 1 …
inline StoreyCells grid_cells(const std::vector<std::string>& picture) {
  const int rows = static_cast<int>(picture.size()), columns = static_cast<int>(picture[0].size());
  StoreyCells storey = grid_cells(columns, rows);
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const char c = picture[static_cast<std::size_t>(rows - 1 - y)][static_cast<std::size_t>(x)];
      grid_cell(storey, x, y).room = c == '.' ? -1 : c - 'a';
    }
  return storey;
}

inline CellSurface level(double height, bool up) { return {{{0, 0, up ? 1.0 : -1.0}, up ? -height : height}, 0}; }
/// z = height + slope · (x, y).
inline CellSurface slanted(double height, const Eigen::Vector2d& slope, bool up) {
  const Eigen::Vector3d n = (up ? 1.0 : -1.0) * Eigen::Vector3d(-slope.x(), -slope.y(), 1).normalized();
  return {{n, -n.z() * height}, 0};
}

/// Area vector of a ring: normal times area.
inline Eigen::Vector3d area_vector(const std::vector<Eigen::Vector3d>& vertices,
                                   const std::vector<std::uint32_t>& ring) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector3d& a = vertices[ring[i]];
    const Eigen::Vector3d& b = vertices[ring[(i + 1) % ring.size()]];
    sum += Eigen::Vector3d(a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x());
  }
  return sum / 2;
}

/// How often each directed side is run along by rings of indices.
class Sides {
 public:
  void add(const std::vector<std::uint32_t>& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) ++uses_[{ring[i], ring[(i + 1) % ring.size()]}];
  }
  /// Each side as often as its opposite.
  bool closed() const {
    return std::all_of(uses_.begin(), uses_.end(), [&](const auto& use) { return use.second == reverse(use.first); });
  }
  /// Closed, and sides that are used more than once stand upright.
  bool manifold(const std::vector<Eigen::Vector3d>& vertices, bool upright_too = false) const {
    return closed() && std::all_of(uses_.begin(), uses_.end(), [&](const auto& use) {
             const Eigen::Vector3d way = vertices[use.first.second] - vertices[use.first.first];
             return use.second == 1 || (!upright_too && way.head<2>().norm() < 1e-9);
           });
  }
  std::size_t count() const { return uses_.size() / 2; }  ///< undirected

 private:
  int reverse(const std::pair<std::uint32_t, std::uint32_t>& side) const {
    const auto it = uses_.find({side.second, side.first});
    return it == uses_.end() ? 0 : it->second;
  }
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses_;
};

inline Sides sides_of(const layout::RoomSurface& surface) {
  Sides sides;
  for (const auto& face : surface.faces) {
    sides.add(face.outline);
    for (const auto& hole : face.holes) sides.add(hole);
  }
  return sides;
}
/// By the divergence theorem, positive where faces look inside.
inline double volume_of(const layout::RoomSurface& surface) {
  double volume = 0;
  const auto add = [&](const std::vector<std::uint32_t>& ring) {
    volume -= area_vector(surface.vertices, ring).dot(surface.vertices[ring[0]]) / 3;
  };
  for (const auto& face : surface.faces) {
    add(face.outline);
    for (const auto& hole : face.holes) add(hole);
  }
  return volume;
}
/// 2 for a ball, 0 for a ring (a room around a column), −2 with two columns; the sum over the parts.
inline int euler(const layout::RoomSurface& surface) {
  int holes = 0;
  for (const auto& face : surface.faces) holes += static_cast<int>(face.holes.size());
  return static_cast<int>(surface.vertices.size()) - static_cast<int>(sides_of(surface).count()) +
         static_cast<int>(surface.faces.size()) - holes;
}

}  // namespace atrium::test
