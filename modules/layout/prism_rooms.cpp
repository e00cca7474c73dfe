#include "modules/layout/prism_rooms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "graph/api/text.hpp"
#include "modules/layout/coverage.hpp"
#include "modules/layout/room_cells.hpp"

namespace atrium::layout {
namespace {

using Inside = std::vector<std::vector<bool>>;

/// What is inside between two surfaces of a cell's stack.
struct Interval {
  std::size_t cell = 0;
  std::size_t low = 0, high = 0;  ///< places in the stack
};

struct PrismRoom {
  std::vector<std::size_t> intervals;
  double area = 0, seen = 0, floor = 0, ceiling = 0;
};

/// Holes of slabs: finds where inside goes on through a ceiling around which a slab with rooms on both sides was seen.
class Slabs {
 public:
  Slabs(const PrismSpace& space, Inside& inside) : space_(space), inside_(inside) {}

  void part() {
    for (std::size_t s = 0; s < space_.surfaces.size(); ++s)
      if (!space_.surfaces[s].up && is_level(space_.surfaces[s].surface.plane)) part(static_cast<std::int32_t>(s));
  }

 private:
  static constexpr double thickest = 1.0;  // metres

  /// The place of a surface in a cell's stack; −1: it is not in it.
  int place_of(std::size_t cell, std::int32_t surface) const {
    const auto& stack = space_.stacks[cell].surfaces;
    const auto it = std::find(stack.begin(), stack.end(), surface);
    return it == stack.end() ? -1 : static_cast<int>(it - stack.begin());
  }
  bool is_inside(std::size_t cell, std::size_t prism) const { return inside_[cell][prism]; }
  /// The floor right over a ceiling that bounds a room below, if it bounds one above; −1: there is none.
  std::int32_t floor_over(std::size_t cell, int ceiling) const {
    const auto& stack = space_.stacks[cell].surfaces;
    const auto k = static_cast<std::size_t>(ceiling);
    if (!is_inside(cell, k) || is_inside(cell, k + 1)) return -1;
    const Eigen::Vector2d middle = middle_of(space_.plan, space_.plan.cells[cell]);
    for (std::size_t f = k + 1; f < stack.size(); ++f) {
      if (space_.height(stack[f], middle) - space_.height(stack[k], middle) > thickest) return -1;
      if (is_inside(cell, f + 1)) return stack[f];
    }
    return -1;
  }

  /// A surface over each cell, and where inside goes on through it.
  struct Through {
    std::vector<int> place;  ///< in the cell's stack; −1: it is not in it
    std::vector<bool> hole;
    std::vector<std::size_t> group;  ///< of holes: the cells that hang together have one number
  };
  /// What lies around a hole.
  struct Rim {
    double length = 0;
    std::map<std::int32_t, double> slabs;  ///< by the floor on them, of the room above: how much of the length
  };

  Through through(std::int32_t surface) const {
    const std::size_t n = space_.stacks.size();
    Through result{std::vector<int>(n), std::vector<bool>(n), std::vector<std::size_t>(n)};
    for (std::size_t c = 0; c < n; ++c) {
      result.place[c] = place_of(c, surface);
      const auto k = static_cast<std::size_t>(std::max(result.place[c], 0));
      result.hole[c] = result.place[c] >= 0 && is_inside(c, k) && is_inside(c, k + 1);
    }
    std::vector<std::size_t> rank(n), parent(n);
    boost::disjoint_sets<std::size_t*, std::size_t*> sets(rank.data(), parent.data());
    for (std::size_t c = 0; c < n; ++c) sets.make_set(c);
    for (const auto& edge : space_.plan.edges) {
      if (edge.left < 0 || edge.right < 0) continue;
      const auto a = static_cast<std::size_t>(edge.left), b = static_cast<std::size_t>(edge.right);
      if (result.hole[a] && result.hole[b]) sets.union_set(a, b);
    }
    for (std::size_t c = 0; c < n; ++c) result.group[c] = sets.find_set(c);
    return result;
  }

  std::vector<Rim> rims(const Through& through) const {
    std::vector<Rim> result(space_.stacks.size());
    for (const auto& edge : space_.plan.edges) {
      if (edge.left < 0 || edge.right < 0) continue;
      auto a = static_cast<std::size_t>(edge.left), b = static_cast<std::size_t>(edge.right);
      if (through.hole[a] == through.hole[b]) continue;
      if (through.hole[b]) std::swap(a, b);
      const double length = (space_.plan.vertices[edge.to] - space_.plan.vertices[edge.from]).norm();
      Rim& rim = result[through.group[a]];
      rim.length += length;
      const std::int32_t over = through.place[b] >= 0 ? floor_over(b, through.place[b]) : -1;
      if (over < 0) continue;
      rim.slabs[over] += length;
    }
    return result;
  }

  void part(std::int32_t surface) {
    constexpr double least_slab = 1.0 / 3;  // of the rim
    const Through holes = through(surface);
    const std::vector<Rim> around = rims(holes);
    for (std::size_t c = 0; c < space_.stacks.size(); ++c) {
      const Rim& rim = around[holes.group[c]];
      if (!holes.hole[c]) continue;
      double slab = 0;
      for (const auto& [floor, length] : rim.slabs) slab += length;
      if (slab < least_slab * rim.length) continue;
      int upper = -1;  // the floor on most of the slab that goes on over the cell
      double most = 0;
      for (const auto& [floor, length] : rim.slabs)
        if (const int place = place_of(c, floor); place > holes.place[c] && length > most) {
          most = length;
          upper = place;
        }
      if (upper < 0) continue;
      for (auto k = static_cast<std::size_t>(holes.place[c]) + 1; k <= static_cast<std::size_t>(upper); ++k)
        inside_[c][k] = false;
    }
  }

  const PrismSpace& space_;
  Inside& inside_;
};

class PrismRoomFinder {
 public:
  PrismRoomFinder(const PrismSpace& space, WallCover& walls, Inside inside)
      : space_(space), walls_(walls), inside_(std::move(inside)) {}

  std::vector<StoreyCells> run(const RoomLimits& limits, const Context& context) {
    Slabs(space_, inside_).part();
    find_intervals();
    find_contacts();
    find_rooms();
    double left_out = 0;
    const auto dropped = std::erase_if(rooms_, [&](const PrismRoom& room) {
      const bool drop = room.area < limits.least_area || room.seen < limits.least_cover * room.area;
      left_out += drop ? room.area : 0;
      return drop;
    });
    if (dropped > 0)
      context.info(fmt::format("{} of {:.1f} m2 in all left out: too small or hardly seen to be rooms",
                               counted(dropped, "space"), left_out));
    std::stable_sort(rooms_.begin(), rooms_.end(),
                     [](const PrismRoom& a, const PrismRoom& b) { return a.area > b.area; });
    return storeys();
  }

 private:
  void find_intervals() {
    constexpr double slab = 0.5;  // of the cell: a surface that was seen there parts what lies above and below it
    of_cell_.resize(space_.stacks.size());
    for (std::size_t c = 0; c < space_.stacks.size(); ++c) {
      const PrismStack& stack = space_.stacks[c];
      for (std::size_t k = 1; k < stack.surfaces.size(); ++k) {
        if (!inside_[c][k]) continue;
        const bool goes_on = k > 1 && inside_[c][k - 1] && stack.cover[k - 1] < slab && !of_cell_[c].empty();
        if (goes_on) {
          intervals_[of_cell_[c].back()].high = k;
        } else {
          of_cell_[c].push_back(intervals_.size());
          intervals_.push_back({c, k - 1, k});
        }
      }
    }
  }

  // Behind a cupboard a wall is not seen: where nothing else parts two rooms, its gap does not join them.
  static constexpr double unseen_passage = 0.75;  // metres: nobody saw the floor in it; wardrobes are less deep
  static constexpr double seen_passage = 0.5;     // metres
  static constexpr double own_room = 1;           // m²: what is smaller is part of its neighbour

  struct Contact {
    std::size_t a = 0, b = 0;
    double area = 0;
    double width = 0;   ///< of what no wall covers, metres
    bool seen = false;  ///< the floor on both sides
  };

  bool floor_seen(std::size_t interval) const {
    constexpr double partly = 0.2;  // of the cell
    return space_.stacks[intervals_[interval].cell].cover[intervals_[interval].low] >= partly;
  }

  void find_contacts() {
    constexpr double mostly = 0.5;
    for (std::size_t e = 0; e < space_.plan.edges.size(); ++e) {
      const CellEdge& edge = space_.plan.edges[e];
      if (edge.left < 0 || edge.right < 0) continue;
      const double length = (space_.plan.vertices[edge.to] - space_.plan.vertices[edge.from]).norm();
      for (const auto a : of_cell_[static_cast<std::size_t>(edge.left)])
        for (const auto b : of_cell_[static_cast<std::size_t>(edge.right)]) {
          double area = 0, walled = 0;
          for (std::size_t i = intervals_[a].low + 1; i <= intervals_[a].high; ++i)
            for (std::size_t k = intervals_[b].low + 1; k <= intervals_[b].high; ++k) {
              const double piece = length * common_height(space_, edge, i, k);
              if (piece <= 0) continue;
              area += piece;
              walled += piece * std::max(walls_(e, 0, i), walls_(e, 1, k));
            }
          if (area > one_height * length && walled <= mostly * area)
            contacts_.push_back({a, b, area, length * (1 - walled / area), floor_seen(a) && floor_seen(b)});
        }
    }
    std::stable_sort(contacts_.begin(), contacts_.end(),
                     [](const Contact& a, const Contact& b) { return a.area > b.area; });
  }

  /// Parts of the building that are joined to rooms.
  struct Parts {
    std::vector<std::size_t> of;  ///< of an interval: its part
    std::vector<std::vector<std::size_t>> members;
    std::vector<std::set<std::size_t>> cells;
    std::vector<double> area;

    /// Whether that could be: no part lies over itself.
    bool join(std::size_t a, std::size_t b) {
      if (members[a].size() < members[b].size()) std::swap(a, b);
      if (std::any_of(cells[b].begin(), cells[b].end(), [&](std::size_t c) { return cells[a].count(c) != 0; }))
        return false;
      for (const auto i : members[b]) of[i] = a;
      members[a].insert(members[a].end(), members[b].begin(), members[b].end());
      cells[a].merge(cells[b]);
      area[a] += area[b];
      members[b].clear();
      return true;
    }
  };

  Parts single_parts() const {
    const std::size_t n = intervals_.size();
    Parts parts{std::vector<std::size_t>(n), std::vector<std::vector<std::size_t>>(n),
                std::vector<std::set<std::size_t>>(n), std::vector<double>(n)};
    for (std::size_t i = 0; i < n; ++i) {
      parts.of[i] = i;
      parts.members[i] = {i};
      parts.cells[i] = {intervals_[i].cell};
      parts.area[i] = space_.plan.cells[intervals_[i].cell].area;
    }
    return parts;
  }

  /// Joins parts that hang together by all of the gaps between them, the widest first. Returns whether any did.
  bool join_round(Parts& parts) const {
    struct Passage {
      std::size_t a = 0, b = 0;  ///< an interval of each part
      double area = 0, width = 0, seen = 0;
    };
    std::map<std::pair<std::size_t, std::size_t>, Passage> found;
    for (const Contact& contact : contacts_) {
      const auto key = std::minmax(parts.of[contact.a], parts.of[contact.b]);
      if (key.first == key.second) continue;
      Passage& passage = found.try_emplace(key, Passage{contact.a, contact.b}).first->second;
      passage.area += contact.area;
      passage.width += contact.width;
      passage.seen += contact.seen ? contact.width : 0;
    }
    std::vector<Passage> passages;
    passages.reserve(found.size());
    for (const auto& [key, passage] : found) passages.push_back(passage);
    std::stable_sort(passages.begin(), passages.end(),
                     [](const Passage& l, const Passage& r) { return l.area > r.area; });
    bool joined = false;
    for (const Passage& passage : passages) {
      const std::size_t a = parts.of[passage.a], b = parts.of[passage.b];
      if (a == b) continue;
      const bool leads_on = passage.width >= unseen_passage || passage.seen >= seen_passage ||
                            std::min(parts.area[a], parts.area[b]) < own_room;
      if (leads_on && parts.join(a, b)) joined = true;
    }
    return joined;
  }

  void find_rooms() {
    Parts parts = single_parts();
    for (const Contact& contact : contacts_)
      if (const std::size_t a = parts.of[contact.a], b = parts.of[contact.b]; a != b && contact.width >= unseen_passage)
        parts.join(a, b);
    while (join_round(parts)) {
    }
    for (auto& members : parts.members) {
      if (members.empty()) continue;
      PrismRoom room;
      std::sort(members.begin(), members.end());
      for (const auto i : members) add(i, room);
      room.floor /= room.area;
      room.ceiling /= room.area;
      rooms_.push_back(std::move(room));
    }
  }

  void add(std::size_t index, PrismRoom& room) const {
    const Interval& interval = intervals_[index];
    const PrismStack& stack = space_.stacks[interval.cell];
    const LayoutCell& cell = space_.plan.cells[interval.cell];
    const Eigen::Vector2d middle = middle_of(space_.plan, cell);
    double seen = std::max(stack.cover[interval.low], stack.cover[interval.high]);
    for (std::size_t k = interval.low + 1; k <= interval.high; ++k) seen = std::max(seen, stack.free[k]);
    room.intervals.push_back(index);
    room.area += cell.area;
    room.seen += cell.area * std::min(1.0, seen);
    room.floor += cell.area * space_.height(stack.surfaces[interval.low], middle);
    room.ceiling += cell.area * space_.height(stack.surfaces[interval.high], middle);
  }

  /// Storeys by the rooms' floors, lowest first.
  std::vector<StoreyCells> storeys() const {
    constexpr double one_storey = 1.0;  // metres between the floors of neighbours in height
    std::vector<std::size_t> order(rooms_.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return rooms_[a].floor < rooms_[b].floor; });
    std::vector<StoreyCells> result;
    std::vector<std::size_t> waiting = order;
    while (!waiting.empty()) {
      std::vector<std::size_t> taken, later;
      std::set<std::size_t> cells;
      for (const auto r : waiting) {
        const bool overlaps = std::any_of(rooms_[r].intervals.begin(), rooms_[r].intervals.end(),
                                          [&](std::size_t i) { return cells.count(intervals_[i].cell) != 0; });
        const bool high = !taken.empty() && rooms_[r].floor - rooms_[taken.back()].floor > one_storey;
        if (overlaps || high || !later.empty()) {
          later.push_back(r);
          continue;
        }
        for (const auto i : rooms_[r].intervals) cells.insert(intervals_[i].cell);
        taken.push_back(r);
      }
      result.push_back(storey(taken));
      waiting = std::move(later);
    }
    for (std::size_t s = 0; s + 1 < result.size(); ++s)
      result[s].high = result[s + 1].low = (result[s].ceiling_height + result[s + 1].floor_height) / 2;
    return result;
  }

  StoreyCells storey(const std::vector<std::size_t>& rooms) const {
    constexpr double far = 1e9;
    StoreyCells result = space_.plan;
    result.low = -far;
    result.high = far;
    double largest = 0;
    for (const auto r : rooms) {
      if (rooms_[r].area > largest) {
        largest = rooms_[r].area;
        result.floor_height = rooms_[r].floor;
        result.ceiling_height = rooms_[r].ceiling;
      }
      for (const auto i : rooms_[r].intervals) {
        const Interval& interval = intervals_[i];
        LayoutCell& cell = result.cells[interval.cell];
        cell.room = static_cast<std::int32_t>(r);
        cell.floor = space_.stacks[interval.cell].surfaces[interval.low];
        cell.ceiling = space_.stacks[interval.cell].surfaces[interval.high];
      }
    }
    return result;
  }

  const PrismSpace& space_;
  WallCover& walls_;
  Inside inside_;
  std::vector<Interval> intervals_;
  std::vector<std::vector<std::size_t>> of_cell_;  // intervals, lowest first
  std::vector<Contact> contacts_;
  std::vector<PrismRoom> rooms_;
};

}  // namespace

std::vector<StoreyCells> prism_rooms(const PrismSpace& space, WallCover& walls, std::vector<std::vector<bool>> inside,
                                     const RoomLimits& limits, const Context& context) {
  return PrismRoomFinder(space, walls, std::move(inside)).run(limits, context);
}

}  // namespace atrium::layout
