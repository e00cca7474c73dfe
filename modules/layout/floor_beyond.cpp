#include "modules/layout/floor_beyond.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "modules/layout/face_grid.hpp"

namespace atrium::layout {
namespace {

constexpr double beyond_edge = 0.4;    // metres: of the squares
constexpr double beyond_reach = 4;     // metres from a room that is looked at
constexpr double beside_room = 0.6;    // metres: walls are at most so thick, and their other sides so far from a room
constexpr double same_floor = 0.1;     // metres
constexpr double over_parapets = 1.3;  // metres over the floor: what stands higher is a wall or a cupboard
constexpr double below_lintels = 2.2;  // metres over the floor: what is seen through a door is not higher
constexpr double least_floor = 0.8;    // square metres of a piece
constexpr double least_walls = 0.8;    // metres of walls that face it
constexpr std::size_t few_points = 2;  // in a square: strays

/// A room as seen from above, and from where to where it reaches.
struct RoomSpan {
  std::vector<std::vector<Eigen::Vector2d>> rings;
  Eigen::AlignedBox2d box;
  double floor = 0, low = 0, high = 0;
};

RoomSpan span_of(const Building& building, const BuildingRoom& room) {
  RoomSpan span{.rings = std::vector<std::vector<Eigen::Vector2d>>(1), .box = {}};
  for (const auto& p : room.outline) {
    span.rings[0].emplace_back(p.head<2>());
    span.box.extend(span.rings[0].back());
    span.floor += p.z() / static_cast<double>(room.outline.size());
  }
  span.low = span.high = span.floor;
  for (const auto f : room.faces)
    for (const auto v : building.faces[static_cast<std::size_t>(f)].outline) {
      span.low = std::min(span.low, building.vertices[v].z());
      span.high = std::max(span.high, building.vertices[v].z());
    }
  return span;
}

/// The mean height of a plane in a square.
struct SquareLevel {
  double sum = 0;
  std::size_t count = 0;
  std::size_t primitive = 0;
  double z() const { return sum / static_cast<double>(count); }
};

/// The squares around the rooms of one storey.
class BeyondSquares {
 public:
  BeyondSquares(const std::vector<RoomSpan>& rooms, const std::vector<RoomSpan>& others, const PlanePrimitives& planes)
      : planes_(planes) {
    Eigen::AlignedBox2d box;
    for (const auto& room : rooms) box.extend(room.box);
    if (box.isEmpty()) return;
    const Eigen::Vector2d margin = Eigen::Vector2d::Constant(beyond_reach);
    low_ = box.min() - margin;
    const Eigen::Vector2d sizes = box.sizes() + 2 * margin;
    width_ = static_cast<int>(sizes.x() / beyond_edge) + 1;
    height_ = static_cast<int>(sizes.y() / beyond_edge) + 1;
    const std::size_t squares = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    levels_.resize(squares);
    tall_.assign(squares, 0);
    floor_.assign(squares, false);
    inside_.assign(squares, false);
    beside_.assign(squares, false);
    heights_.assign(squares, 0);
    for (std::size_t p = 0; p < planes.primitives.size(); ++p) add(p);
    for (const auto& room : rooms) look_around(room);
    for (const auto& room : others) hide(room);
    find_tall();
  }

  FloorBeyond run() {
    FloorBeyond result;
    for (std::size_t i = 0; i < floor_.size(); ++i) {
      if (!floor_[i]) continue;
      const Piece piece = take(i);
      if (!piece.wide || !piece.touches || piece.clear < least_floor || piece.walls < least_walls) continue;
      result.area += piece.area;
      if (piece.area <= result.largest) continue;
      result.largest = piece.area;
      result.where = piece.where;
    }
    return result;
  }

 private:
  struct Piece {
    double area = 0, walls = 0;
    double clear = 0;      ///< of the area: further from a room than a wall is thick
    bool wide = false;     ///< a block of 2 x 2 squares is in it
    bool touches = false;  ///< a room
    Eigen::Vector3d where = Eigen::Vector3d::Zero();
  };

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  bool holds(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }
  Eigen::Vector2d centre(int x, int y) const { return low_ + beyond_edge * Eigen::Vector2d(x + 0.5, y + 0.5); }
  template <class Work>
  void around(std::size_t i, int reach, const Work& work) const {
    const int x = static_cast<int>(i % static_cast<std::size_t>(width_));
    const int y = static_cast<int>(i / static_cast<std::size_t>(width_));
    for (int v = std::max(0, y - reach); v <= std::min(height_ - 1, y + reach); ++v)
      for (int u = std::max(0, x - reach); u <= std::min(width_ - 1, x + reach); ++u) work(u, v);
  }

  /// The square that a point lies in; the number of squares: in none.
  std::size_t square_of(const Eigen::Vector3d& q) const {
    const Eigen::Vector2d at = (q.head<2>() - low_) / beyond_edge;
    const int x = static_cast<int>(std::floor(at.x())), y = static_cast<int>(std::floor(at.y()));
    return holds(x, y) ? index(x, y) : levels_.size();
  }

  void add(std::size_t p) {
    constexpr double lies_up = 0.95;  // cosine
    const PlanePrimitive& primitive = planes_.primitives[p];
    if (primitive.plane.normal.z() < lies_up) return;
    for (const auto i : primitive.inliers) {
      const Eigen::Vector3d q = planes_.cloud->points[i].cast<double>();
      const std::size_t square = square_of(q);
      if (square == levels_.size()) continue;
      auto& levels = levels_[square];
      if (levels.empty() || levels.back().primitive != p) levels.push_back({0, 0, p});
      levels.back().sum += q.z();
      ++levels.back().count;
    }
  }

  /// Counts the points at the height of walls over some room's floor.
  void find_tall() {
    std::sort(floors_.begin(), floors_.end());
    for (const auto& point : planes_.cloud->points) {
      const std::size_t square = square_of(point.cast<double>());
      if (square == levels_.size() || beside_[square]) continue;
      const double lowest = point.z() - below_lintels;
      const auto floor = std::lower_bound(floors_.begin(), floors_.end(), lowest);
      if (floor != floors_.end() && point.z() - *floor > over_parapets) ++tall_[square];
    }
  }

  /// Marks the squares that the room holds and those beside it, and the floors around it.
  void look_around(const RoomSpan& room) {
    floors_.push_back(room.floor);
    in_reach(room, beyond_reach, [&](std::size_t i, bool inner, double distance) {
      if (inner) inside_[i] = true;
      if (inner || distance < beside_room) beside_[i] = true;
      for (const auto& level : levels_[i])
        if (level.count >= few_points && std::abs(level.z() - room.floor) < same_floor) {
          floor_[i] = true;
          heights_[i] = room.floor;
        }
    });
  }

  /// A room of another storey: what it holds of this one's floors is in a room, too.
  void hide(const RoomSpan& room) {
    in_reach(room, beside_room, [&](std::size_t i, bool inner, double) {
      if (!floor_[i] || heights_[i] < room.low - same_floor || heights_[i] + over_parapets > room.high) return;
      if (inner) inside_[i] = true;
      beside_[i] = true;
    });
  }

  /// Calls work(square, whether the room holds its centre, distance from the room's outline).
  template <class Work>
  void in_reach(const RoomSpan& room, double reach, const Work& work) const {
    if (room.box.isEmpty()) return;
    const Eigen::Vector2d margin = Eigen::Vector2d::Constant(reach);
    const Eigen::Vector2i first = ((room.box.min() - margin - low_) / beyond_edge).array().floor().cast<int>().max(0);
    const Eigen::Vector2i last = ((room.box.max() + margin - low_) / beyond_edge)
                                     .array()
                                     .floor()
                                     .cast<int>()
                                     .min(Eigen::Array2i(width_ - 1, height_ - 1));
    for (int y = first.y(); y <= last.y(); ++y)
      for (int x = first.x(); x <= last.x(); ++x) {
        const bool inner = inside_rings(room.rings, centre(x, y));
        const double distance = distance_to_rings(room.rings, centre(x, y));
        if (inner || distance <= reach) work(index(x, y), inner, distance);
      }
  }

  /// The connected piece that a square is part of; its squares are taken.
  Piece take(std::size_t first) {
    Piece piece;
    std::vector<std::size_t> open;
    std::vector<std::size_t> walls;
    const auto visit = [&](std::size_t i) {
      if (!floor_[i]) return;
      floor_[i] = false;
      if (!inside_[i]) open.push_back(i);
    };
    visit(first);
    for (std::size_t k = 0; k < open.size(); ++k) {
      const std::size_t i = open[k];
      piece.touches = piece.touches || beside_[i];
      around(i, 1, [&](int x, int y) { visit(index(x, y)); });
      around(i, 3, [&](int x, int y) {
        if (tall_[index(x, y)] >= few_points) walls.push_back(index(x, y));
      });
    }
    std::sort(walls.begin(), walls.end());
    walls.erase(std::unique(walls.begin(), walls.end()), walls.end());
    piece.walls = beyond_edge * static_cast<double>(walls.size());
    const double square = beyond_edge * beyond_edge;
    piece.area = square * static_cast<double>(open.size());
    piece.clear = square * static_cast<double>(
                               std::count_if(open.begin(), open.end(), [&](std::size_t i) { return !beside_[i]; }));
    find_middle(open, piece);
    return piece;
  }

  /// Whether a block of 2 x 2 squares away from the rooms is in the piece, and where.
  void find_middle(std::vector<std::size_t>& squares, Piece& piece) const {
    std::sort(squares.begin(), squares.end());
    const auto has = [&](std::size_t i) {
      return !beside_[i] && std::binary_search(squares.begin(), squares.end(), i);
    };
    const auto row = static_cast<std::size_t>(width_);
    for (const auto i : squares)
      if (has(i) && has(i + 1) && i + row + 1 < beside_.size() && has(i + row) && has(i + row + 1)) {
        piece.wide = true;
        const std::size_t x = i % row + 1, y = i / row + 1;
        piece.where << low_ + beyond_edge * Eigen::Vector2d(static_cast<double>(x), static_cast<double>(y)),
            heights_[i];
        return;
      }
  }

  const PlanePrimitives& planes_;
  Eigen::Vector2d low_ = Eigen::Vector2d::Zero();
  int width_ = 0, height_ = 0;
  std::vector<double> floors_;  // of the rooms
  std::vector<std::vector<SquareLevel>> levels_;
  std::vector<std::size_t> tall_;  // points at the height of walls, away from the rooms
  std::vector<bool> floor_;        // was seen at a room's height, and is not yet taken
  std::vector<double> heights_;    // of that floor
  std::vector<bool> inside_;       // of a room
  std::vector<bool> beside_;       // in a room or next to it
};

}  // namespace

FloorBeyond floor_beyond_rooms(const Building& building, const PlanePrimitives& planes) {
  std::map<std::int32_t, std::vector<RoomSpan>> storeys;
  for (const auto& room : building.rooms)
    if (!room.outline.empty()) storeys[room.storey].push_back(span_of(building, room));
  FloorBeyond result;
  for (const auto& [storey, rooms] : storeys) {
    std::vector<RoomSpan> others;
    for (const auto& [other, theirs] : storeys)
      if (other != storey) others.insert(others.end(), theirs.begin(), theirs.end());
    const FloorBeyond found = BeyondSquares(rooms, others, planes).run();
    result.area += found.area;
    if (found.largest <= result.largest) continue;
    result.largest = found.largest;
    result.where = found.where;
  }
  return result;
}

}  // namespace atrium::layout
