#include "modules/layout/rooms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <numeric>
#include <utility>

#include "graph/api/text.hpp"
#include "modules/layout/coverage.hpp"
#include "modules/layout/enclosure.hpp"
#include "modules/layout/hidden_walls.hpp"
#include "modules/layout/min_cut.hpp"
#include "modules/layout/room_necks.hpp"
#include "modules/layout/wall_bodies.hpp"

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
    // Where no ceiling was scanned, what stands between walls that look towards it counts for one.
    const double shown = std::max(cell.ceiling_cover, within_walls(cell) * std::max(cell.floor_cover, cell.any_cover));
    // There, furniture speaks for a floor, too.
    const double floor = ceiling_ ? cell.floor_cover : std::max(cell.floor_cover, cell.any_cover);
    const double inside = params_.ceiling_weight * shown + params_.floor_weight * floor;
    cut_.add(i, inside * cell.area, params_.outside_weight * (1 - shown) * cell.area);
  }

  /// 0: outside, 1: surely between the walls of a room.
  static double within_walls(const LayoutCell& cell) {
    constexpr double least = 0.5, enough = 0.75;
    return std::clamp((cell.enclosed - least) / (enough - least), 0.0, 1.0);
  }

  void add_edge(std::size_t index) {
    const CellEdge& edge = storey_.edges[index];
    const double area = length_of(storey_, edge) * (storey_.ceiling_height - storey_.floor_height);
    const double left = ends_room(edge.wall_left, edge.face_left, edge.top_left);
    const double right = ends_room(edge.wall_right, edge.face_right, edge.top_right);
    vote(edge.left, edge.right, (is_cut_wall(edge.right) ? left : edge.wall_left) * area);
    vote(edge.right, edge.left, (is_cut_wall(edge.left) ? right : edge.wall_right) * area);
    const double left_inside =
        area * (params_.smoothness * (1 - std::max(left, hidden_.left[index])) + params_.complexity);
    const double right_inside =
        area * (params_.smoothness * (1 - std::max(right, hidden_.right[index])) + params_.complexity);
    cut_.add_pair(element(edge.left), element(edge.right), right_inside, left_inside);
  }

  /// Where no ceiling was scanned, walls end at different heights: those that are tall may end a room.
  double ends_room(double wall, double face, double top) const {
    const bool tall = top >= least_wall_top(storey_);
    return !ceiling_ && tall ? std::max(wall, face) : wall;
  }

  /// Whether a cell is as thin as a wall (what stands behind the front of a cupboard is not), in a storey many of whose
  /// walls were not seen up to their ends.
  bool is_cut_wall(std::int32_t cell) const {
    constexpr double thickest = 0.25, cut = 0.93;
    const double end = storey_.wall_end - storey_.floor_height;
    return cell >= 0 && end > 0 && end < cut * (storey_.ceiling_height - storey_.floor_height) &&
           width_of(storey_, storey_.cells[element(cell)]) <= thickest;
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

/// Cells of less than `min_detail` go to the side that surrounds most of them: no niche or pilaster is that small.
void level_details(const StoreyCells& storey, double min_detail, std::vector<bool>& inside) {
  constexpr double mostly = 1.5;  // times as much border with the other side as with its own
  std::vector<std::vector<std::size_t>> edges_of(storey.cells.size());
  for (std::size_t e = 0; e < storey.edges.size(); ++e)
    for (const auto cell : {storey.edges[e].left, storey.edges[e].right})
      if (cell >= 0) edges_of[static_cast<std::size_t>(cell)].push_back(e);
  std::vector<std::size_t> small;
  for (std::size_t i = 0; i < storey.cells.size(); ++i)
    if (storey.cells[i].area < min_detail) small.push_back(i);
  std::stable_sort(small.begin(), small.end(),
                   [&](std::size_t a, std::size_t b) { return storey.cells[a].area < storey.cells[b].area; });
  const auto has_more_of_other = [&](std::size_t cell) {
    double same = 0, other = 0;
    for (const auto e : edges_of[cell]) {
      const CellEdge& edge = storey.edges[e];
      const std::int32_t beside = edge.left == static_cast<std::int32_t>(cell) ? edge.right : edge.left;
      const bool in = beside >= 0 && inside[static_cast<std::size_t>(beside)];
      (in == inside[cell] ? same : other) += length_of(storey, edge);
    }
    return same > 0 && other > mostly * same;
  };
  // Each change shortens the border, so this ends.
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto cell : small) {
      if (!has_more_of_other(cell)) continue;
      inside[cell] = !inside[cell];
      changed = true;
    }
  }
}

struct Room {
  std::size_t storey = 0;
  double area = 0, seen = 0;
  std::vector<std::size_t> cells;
};

Room room_of(const StoreyCells& storey, std::size_t index, std::vector<std::size_t> cells) {
  Room room{index, 0, 0, std::move(cells)};
  for (const auto i : room.cells) {
    const LayoutCell& cell = storey.cells[i];
    room.area += cell.area;
    room.seen += cell.area * std::max({cell.floor_cover, cell.ceiling_cover, cell.any_cover});
  }
  return room;
}

std::vector<Room> connected(const StoreyCells& storey, std::size_t index, const std::vector<bool>& inside) {
  std::vector<std::size_t> rank(storey.cells.size()), parent(storey.cells.size());
  boost::disjoint_sets<std::size_t*, std::size_t*> sets(rank.data(), parent.data());
  for (std::size_t i = 0; i < storey.cells.size(); ++i) sets.make_set(i);
  constexpr double mostly = 0.5;
  for (const auto& edge : storey.edges) {
    if (edge.left < 0 || edge.right < 0) continue;
    if (std::max(edge.wall_left, edge.wall_right) > mostly) continue;  // a wall, be it so thin or seen from one side
    const auto a = static_cast<std::size_t>(edge.left);
    const auto b = static_cast<std::size_t>(edge.right);
    if (inside[a] && inside[b]) sets.union_set(a, b);
  }
  std::vector<std::vector<std::size_t>> parts(storey.cells.size());
  for (std::size_t i = 0; i < storey.cells.size(); ++i)
    if (inside[i]) parts[sets.find_set(i)].push_back(i);
  std::vector<Room> rooms;
  for (const auto& part : parts)
    for (auto& cells : parted_at_necks(storey, part)) rooms.push_back(room_of(storey, index, std::move(cells)));
  return rooms;
}

/// Takes cells in walls between rooms out of the inside.
void leave_out_wall_bodies(const StoreyCells& storey, const std::vector<Room>& rooms, std::vector<bool>& inside) {
  std::vector<std::int32_t> room_of_cell(storey.cells.size(), -1);
  for (std::size_t r = 0; r < rooms.size(); ++r)
    for (const auto cell : rooms[r].cells) room_of_cell[cell] = static_cast<std::int32_t>(r);
  const std::vector<std::int32_t> before = room_of_cell;
  clear_wall_bodies(storey, room_of_cell);
  for (std::size_t i = 0; i < inside.size(); ++i)
    if (before[i] >= 0 && room_of_cell[i] < 0) inside[i] = false;
}

/// Parts of the outside that one room surrounds, and around which hardly a wall was seen, belong to it: a column shows
/// its faces.
void fill_islands(const StoreyCells& storey, double min_seen, std::vector<Room>& rooms) {
  constexpr std::size_t none = ~std::size_t{0};
  std::vector<std::size_t> room_of(storey.cells.size(), none);
  for (std::size_t r = 0; r < rooms.size(); ++r)
    for (const auto cell : rooms[r].cells) room_of[cell] = r;
  std::vector<std::size_t> rank(storey.cells.size()), parent(storey.cells.size());
  boost::disjoint_sets<std::size_t*, std::size_t*> sets(rank.data(), parent.data());
  for (std::size_t i = 0; i < storey.cells.size(); ++i) sets.make_set(i);
  const auto outside = [&](std::int32_t cell) { return room_of[static_cast<std::size_t>(cell)] == none; };
  for (const auto& edge : storey.edges)
    if (edge.left >= 0 && edge.right >= 0 && outside(edge.left) && outside(edge.right))
      sets.union_set(static_cast<std::size_t>(edge.left), static_cast<std::size_t>(edge.right));
  struct Part {
    std::size_t room = none;
    bool island = true;  // all around is this room
    double length = 0, seen = 0;
  };
  std::vector<Part> parts(storey.cells.size());
  for (const auto& edge : storey.edges) {
    if (edge.left < 0 || edge.right < 0) {
      const std::int32_t cell = std::max(edge.left, edge.right);
      if (cell >= 0 && outside(cell)) parts[sets.find_set(static_cast<std::size_t>(cell))].island = false;
    } else if (outside(edge.left) != outside(edge.right)) {
      const bool left_out = outside(edge.left);
      Part& part = parts[sets.find_set(static_cast<std::size_t>(left_out ? edge.left : edge.right))];
      const std::size_t room = room_of[static_cast<std::size_t>(left_out ? edge.right : edge.left)];
      part.island = part.island && (part.room == none || part.room == room);
      part.room = room;
      part.length += length_of(storey, edge);
      part.seen += length_of(storey, edge) * (left_out ? edge.wall_right : edge.wall_left);
    }
  }
  for (std::size_t i = 0; i < storey.cells.size(); ++i) {
    if (room_of[i] != none) continue;
    const Part& part = parts[sets.find_set(i)];
    if (!part.island || part.room == none || part.seen >= min_seen * part.length) continue;
    rooms[part.room].cells.push_back(i);
    rooms[part.room].area += storey.cells[i].area;
  }
}

}  // namespace

Rooms::Out Rooms::run(const In& in, const Params& params, Context& context) {
  Out out{*in.cells};
  std::vector<Room> rooms;
  for (std::size_t s = 0; s < out.cells.storeys.size(); ++s) {
    context.check_cancelled();
    StoreyCells& storey = out.cells.storeys[s];
    for (auto& cell : storey.cells) cell.room = -1;
    auto inside = Energy(storey, params).solve();
    level_details(storey, params.min_detail, inside);
    leave_out_wall_bodies(storey, connected(storey, s, inside), inside);
    auto found = connected(storey, s, inside);
    fill_islands(storey, params.min_island, found);
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
  context.info(fmt::format("{} of {:.1f} m2", counted(rooms.size(), "room"), area));
  return out;
}

}  // namespace atrium::layout
