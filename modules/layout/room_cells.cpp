#include "modules/layout/room_cells.hpp"

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <cmath>
#include <functional>
#include <tuple>

namespace atrium::layout {

double floor_at(const StoreyCells& storey, const LayoutCell& cell, const Eigen::Vector2d& p) {
  return storey.floors[static_cast<std::size_t>(cell.floor)].height_at(p);
}
double ceiling_at(const StoreyCells& storey, const LayoutCell& cell, const Eigen::Vector2d& p) {
  return std::max(storey.ceilings[static_cast<std::size_t>(cell.ceiling)].height_at(p), floor_at(storey, cell, p));
}

namespace {

/// A vertex on an edge, which ends there; a new edge takes the rest of it.
void split_edge(StoreyCells& storey, std::size_t edge, const Eigen::Vector2d& place) {
  const auto vertex = static_cast<std::uint32_t>(storey.vertices.size());
  const auto rest = static_cast<std::uint32_t>(storey.edges.size());
  storey.vertices.push_back(place);
  CellEdge second = storey.edges[edge];
  second.from = vertex;
  storey.edges[edge].to = vertex;
  storey.edges.push_back(second);
  const auto insert = [&](std::int32_t index, bool forward) {
    if (index < 0) return;
    LayoutCell& cell = storey.cells[static_cast<std::size_t>(index)];
    const auto it = std::find(cell.edges.begin(), cell.edges.end(), edge);
    const auto i = it - cell.edges.begin();
    cell.edges.insert(it + (forward ? 1 : 0), rest);
    cell.corners.insert(cell.corners.begin() + i + 1, vertex);
  };
  insert(second.left, true);
  insert(second.right, false);
}

/// How far the ceiling of a cell is above its floor, as planes.
double clearance_at(const StoreyCells& storey, const LayoutCell& cell, std::uint32_t vertex) {
  const Eigen::Vector2d& p = storey.vertices[vertex];
  const double off = storey.ceilings[static_cast<std::size_t>(cell.ceiling)].height_at(p) - floor_at(storey, cell, p);
  return std::abs(off) <= one_height ? 0 : off;
}

/// The line over which a cell's ceiling meets its floor.
CellLine meeting_line(const StoreyCells& storey, const LayoutCell& cell) {
  const auto height = [&](double x, double y) {
    const Eigen::Vector2d p(x, y);
    return storey.ceilings[static_cast<std::size_t>(cell.ceiling)].height_at(p) - floor_at(storey, cell, p);
  };
  const Eigen::Vector2d slope(height(1, 0) - height(0, 0), height(0, 1) - height(0, 0));
  return {slope.normalized(), height(0, 0) / slope.norm(), {}};
}

double area_of(const StoreyCells& storey, const LayoutCell& cell) {
  const Eigen::Vector2d& origin = storey.vertices[cell.corners[0]];
  double twice = 0;
  for (std::size_t i = 1; i + 1 < cell.corners.size(); ++i) {
    const Eigen::Vector2d a = storey.vertices[cell.corners[i]] - origin;
    const Eigen::Vector2d b = storey.vertices[cell.corners[i + 1]] - origin;
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

/// Parts a cell between two of its corners: it keeps corners[first] … corners[last], a new cell of no room takes the
/// rest.
void part_cell(StoreyCells& storey, std::size_t index, std::size_t first, std::size_t last) {
  LayoutCell& cell = storey.cells[index];
  const auto other = static_cast<std::int32_t>(storey.cells.size());
  const auto border = static_cast<std::uint32_t>(storey.edges.size());
  const std::size_t n = cell.corners.size();
  LayoutCell inner = cell, outer = cell;
  outer.room = outer.floor = outer.ceiling = -1;
  inner.corners.clear(), inner.edges.clear(), outer.corners.clear(), outer.edges.clear();
  const auto take = [&](LayoutCell& part, std::size_t from, std::size_t to) {
    for (std::size_t i = from; i != to; i = (i + 1) % n) {
      part.corners.push_back(cell.corners[i]);
      part.edges.push_back(cell.edges[i]);
    }
    part.corners.push_back(cell.corners[to]);
    part.edges.push_back(border);
  };
  take(inner, first, last);
  take(outer, last, first);
  inner.area = area_of(storey, inner);
  outer.area = area_of(storey, outer);
  for (std::size_t i = last; i != first; i = (i + 1) % n) {
    CellEdge& edge = storey.edges[cell.edges[i]];
    (edge.left == static_cast<std::int32_t>(index) ? edge.left : edge.right) = other;
  }
  const auto line = static_cast<std::int32_t>(storey.lines.size());
  storey.lines.push_back(meeting_line(storey, cell));
  storey.edges.push_back({cell.corners[last], cell.corners[first], static_cast<std::int32_t>(index), other, line});
  storey.cells[index] = std::move(inner);
  storey.cells.push_back(std::move(outer));
}

void cut_pinched_cell(StoreyCells& storey, std::size_t index) {
  const auto clearance = [&](std::size_t corner) {
    const LayoutCell& cell = storey.cells[index];
    return clearance_at(storey, cell, cell.corners[corner % cell.corners.size()]);
  };
  double least = 0, most = 0;
  for (std::size_t i = 0; i < storey.cells[index].corners.size(); ++i) {
    least = std::min(least, clearance(i));
    most = std::max(most, clearance(i));
  }
  if (most == 0) storey.cells[index].room = -1;
  if (least == 0 || most == 0) return;
  for (std::size_t i = 0; i < storey.cells[index].corners.size(); ++i) {
    const double here = clearance(i), next = clearance(i + 1);
    if (here * next >= 0) continue;
    const LayoutCell& cell = storey.cells[index];
    const Eigen::Vector2d& p = storey.vertices[cell.corners[i]];
    const Eigen::Vector2d& q = storey.vertices[cell.corners[(i + 1) % cell.corners.size()]];
    split_edge(storey, cell.edges[i++], p + (q - p) * (here / (here - next)));
  }
  const std::size_t n = storey.cells[index].corners.size();
  for (std::size_t first = 0; first < n; ++first) {
    if (clearance(first) > 0 || clearance(first + 1) <= 0) continue;
    std::size_t last = first + 1;
    while (clearance(last) > 0) ++last;
    part_cell(storey, index, first, last % n);
    return;
  }
}

}  // namespace

void cut_pinched_cells(StoreyCells& storey) {
  const std::size_t cells = storey.cells.size();
  for (std::size_t i = 0; i < cells; ++i)
    if (storey.cells[i].room >= 0) cut_pinched_cell(storey, i);
}

void split_crossing_steps(StoreyCells& storey) {
  const std::size_t edges = storey.edges.size();
  for (std::size_t e = 0; e < edges; ++e) {
    const CellEdge edge = storey.edges[e];
    if (edge.left < 0 || edge.right < 0) continue;
    const LayoutCell& left = storey.cells[static_cast<std::size_t>(edge.left)];
    const LayoutCell& right = storey.cells[static_cast<std::size_t>(edge.right)];
    if (left.room < 0 || left.room != right.room) continue;
    const Eigen::Vector2d p = storey.vertices[edge.from];
    const Eigen::Vector2d q = storey.vertices[edge.to];
    std::vector<double> places;
    for (const auto height : {&floor_at, &ceiling_at}) {
      const double at_p = height(storey, left, p) - height(storey, right, p);
      const double at_q = height(storey, left, q) - height(storey, right, q);
      if (at_p * at_q < 0 && std::min(std::abs(at_p), std::abs(at_q)) > one_height)
        places.push_back(at_p / (at_p - at_q));
    }
    std::sort(places.begin(), places.end(), std::greater<>());
    for (const double t : places) split_edge(storey, e, p + (q - p) * t);
  }
}

namespace {

struct RoomPart {
  std::int32_t room = -1;  // that it was of
  double area = 0;
  std::size_t storey = 0;
  std::vector<std::size_t> cells;
};

std::vector<RoomPart> connected_parts(const StoreyCells& storey, std::size_t index) {
  std::vector<std::size_t> rank(storey.cells.size()), parent(storey.cells.size());
  boost::disjoint_sets<std::size_t*, std::size_t*> sets(rank.data(), parent.data());
  for (std::size_t i = 0; i < storey.cells.size(); ++i) sets.make_set(i);
  for (const auto& edge : storey.edges) {
    if (edge.left < 0 || edge.right < 0) continue;
    const LayoutCell& left = storey.cells[static_cast<std::size_t>(edge.left)];
    const LayoutCell& right = storey.cells[static_cast<std::size_t>(edge.right)];
    if (left.room < 0 || left.room != right.room) continue;
    const auto open = [&](std::uint32_t vertex) {
      if (clearance_at(storey, left, vertex) <= 0 || clearance_at(storey, right, vertex) <= 0) return false;
      const Eigen::Vector2d& p = storey.vertices[vertex];
      return std::min(ceiling_at(storey, left, p), ceiling_at(storey, right, p)) -
                 std::max(floor_at(storey, left, p), floor_at(storey, right, p)) >
             one_height;
    };
    if (open(edge.from) || open(edge.to))
      sets.union_set(static_cast<std::size_t>(edge.left), static_cast<std::size_t>(edge.right));
  }
  std::vector<RoomPart> parts(storey.cells.size());
  for (std::size_t i = 0; i < storey.cells.size(); ++i) {
    if (storey.cells[i].room < 0) continue;
    RoomPart& part = parts[sets.find_set(i)];
    part.room = storey.cells[i].room;
    part.storey = index;
    part.area += storey.cells[i].area;
    part.cells.push_back(i);
  }
  std::erase_if(parts, [](const RoomPart& part) { return part.cells.empty(); });
  return parts;
}

}  // namespace

std::int32_t number_rooms(std::vector<StoreyCells>& storeys) {
  std::vector<RoomPart> parts;
  for (std::size_t s = 0; s < storeys.size(); ++s) {
    const auto found = connected_parts(storeys[s], s);
    parts.insert(parts.end(), found.begin(), found.end());
  }
  std::stable_sort(parts.begin(), parts.end(), [](const RoomPart& a, const RoomPart& b) {
    return std::tuple(a.room, -a.area) < std::tuple(b.room, -b.area);
  });
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (const auto cell : parts[p].cells) storeys[parts[p].storey].cells[cell].room = static_cast<std::int32_t>(p);
  return static_cast<std::int32_t>(parts.size());
}

}  // namespace atrium::layout
