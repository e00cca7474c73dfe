#include "modules/layout/rooms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <numeric>

#include "modules/layout/coverage.hpp"
#include "modules/layout/hidden_walls.hpp"
#include "modules/layout/min_cut.hpp"

namespace atrium::layout {
namespace {

double length_of(const StoreyCells& storey, const CellEdge& edge) {
  return (storey.vertices[edge.to] - storey.vertices[edge.from]).norm();
}

class Energy {
 public:
  Energy(const StoreyCells& storey, const Rooms::Params& params)
      : storey_(storey),
        params_(params),
        ceiling_(ceiling_scanned(storey)),
        hidden_(hidden_walls(storey, ceiling_)),
        cut_(storey.cells.size() + 1) {}

  /// Per cell: is it inside?
  std::vector<bool> solve() {
    constexpr double never = 1e9;
    cut_.add(outside(), 0, never);
    for (std::size_t i = 0; i < storey_.cells.size(); ++i) add_cell(i);
    for (std::size_t i = 0; i < storey_.edges.size(); ++i) add_edge(i);
    return cut_.solve();
  }

 private:
  std::size_t outside() const { return storey_.cells.size(); }
  std::size_t element(std::int32_t cell) const { return cell < 0 ? outside() : static_cast<std::size_t>(cell); }

  void add_cell(std::size_t i) {
    const LayoutCell& cell = storey_.cells[i];
    double inside = 0;
    double hidden = 0;
    if (ceiling_) {
      inside = params_.ceiling_weight * cell.ceiling_cover + params_.floor_weight * cell.floor_cover;
      hidden = 1 - cell.ceiling_cover;
    } else {
      const double seen = std::max(cell.floor_cover, cell.any_cover);
      inside = params_.ceiling_weight * seen;
      hidden = 1 - seen;
    }
    cut_.add(i, inside * cell.area, params_.outside_weight * hidden * cell.area);
  }

  void add_edge(std::size_t index) {
    const CellEdge& edge = storey_.edges[index];
    const double area = length_of(storey_, edge) * (storey_.ceiling_height - storey_.floor_height);
    vote(edge.left, edge.right, edge.wall_left * area);
    vote(edge.right, edge.left, edge.wall_right * area);
    const double left_inside =
        area * (params_.smoothness * (1 - std::max(edge.wall_left, hidden_.left[index])) + params_.complexity);
    const double right_inside =
        area * (params_.smoothness * (1 - std::max(edge.wall_right, hidden_.right[index])) + params_.complexity);
    cut_.add_pair(element(edge.left), element(edge.right), right_inside, left_inside);
  }

  void vote(std::int32_t front, std::int32_t back, double area) {
    // The face of a long wall seems to run on over the end of another that meets it.
    if (front >= 0) cut_.add(element(front), params_.wall_weight * area * (1 - hidden_.cells[element(front)]), 0);
    if (back < 0) return;
    // Where a wide floor or ceiling goes on behind it, it is no wall.
    const LayoutCell& cell = storey_.cells[element(back)];
    constexpr double sure = 0.6, wide = 0.5;
    if (width_of(storey_, cell) < wide) {
      cut_.add(element(back), 0, params_.wall_weight * area);
      return;
    }
    const double cover = std::max(cell.floor_cover, cell.ceiling_cover);
    cut_.add(element(back), 0, params_.wall_weight * area * std::min(1.0, (1 - cover) / (1 - sure)));
  }

  const StoreyCells& storey_;
  const Rooms::Params& params_;
  bool ceiling_;
  HiddenWalls hidden_;
  MinCut cut_;
};

struct Room {
  std::size_t storey = 0;
  double area = 0, seen = 0;
  std::vector<std::size_t> cells;
};

std::vector<Room> connected(const StoreyCells& storey, std::size_t index, const std::vector<bool>& inside) {
  std::vector<std::size_t> rank(storey.cells.size()), parent(storey.cells.size());
  boost::disjoint_sets<std::size_t*, std::size_t*> sets(rank.data(), parent.data());
  for (std::size_t i = 0; i < storey.cells.size(); ++i) sets.make_set(i);
  constexpr double mostly = 0.5;
  for (const auto& edge : storey.edges) {
    if (edge.left < 0 || edge.right < 0) continue;
    if (edge.wall_left > mostly && edge.wall_right > mostly) continue;  // a thin wall: both of its faces on one line
    const auto a = static_cast<std::size_t>(edge.left);
    const auto b = static_cast<std::size_t>(edge.right);
    if (inside[a] && inside[b]) sets.union_set(a, b);
  }
  std::vector<Room> rooms(storey.cells.size());
  for (std::size_t i = 0; i < storey.cells.size(); ++i) {
    if (!inside[i]) continue;
    const LayoutCell& cell = storey.cells[i];
    Room& room = rooms[sets.find_set(i)];
    room.storey = index;
    room.area += cell.area;
    room.seen += cell.area * std::max({cell.floor_cover, cell.ceiling_cover, cell.any_cover});
    room.cells.push_back(i);
  }
  std::erase_if(rooms, [](const Room& room) { return room.cells.empty(); });
  return rooms;
}

}  // namespace

Rooms::Out Rooms::run(const In& in, const Params& params, Context& context) {
  Out out{*in.cells};
  std::vector<Room> rooms;
  for (std::size_t s = 0; s < out.cells.storeys.size(); ++s) {
    context.check_cancelled();
    StoreyCells& storey = out.cells.storeys[s];
    for (auto& cell : storey.cells) cell.room = -1;
    const auto found = connected(storey, s, Energy(storey, params).solve());
    rooms.insert(rooms.end(), found.begin(), found.end());
  }
  std::erase_if(
      rooms, [&](const Room& room) { return room.area < params.min_area || room.seen < params.min_cover * room.area; });
  std::stable_sort(rooms.begin(), rooms.end(), [](const Room& a, const Room& b) { return a.area > b.area; });
  for (std::size_t r = 0; r < rooms.size(); ++r)
    for (const auto cell : rooms[r].cells)
      out.cells.storeys[rooms[r].storey].cells[cell].room = static_cast<std::int32_t>(r);
  if (rooms.empty()) context.warn("no cell is inside: there is no room in this scan");
  double area = 0;
  for (const auto& room : rooms) area += room.area;
  context.info(fmt::format("{} rooms of {:.1f} m2", rooms.size(), area));
  return out;
}

}  // namespace atrium::layout
