#include "modules/layout/room_evidence.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

#include "modules/layout/room_columns.hpp"

namespace atrium::layout {
namespace {

constexpr double reach = 0.5;          // metres: a wall seen this near to its foot or top stands on the floor there
constexpr double in_front = 0.3;       // metres before the wall that the floor or ceiling is looked at
constexpr double least_wall = 0.6;     // metres: lower faces are steps and lintels
constexpr double least_share = 0.2;    // of a wall's height that must have been seen for it to count as standing there
constexpr double least_top = 1.0 / 3;  // of a wall's height that what was seen reaches: below that it is furniture
constexpr double full_height = 0.6;    // share of the levels that a wall inside of a room fills, the highest among them

class Measuring {
 public:
  Measuring(const Building& building, const BuildingRoom& room, const std::vector<FaceGrid>& grids,
            const std::vector<Footprint>& walls)
      : building_(building), room_(room), grids_(grids), walls_(walls) {}

  RoomEvidence run() {
    double seen_walls = 0, all_walls = 0, length = 0, seen_length = 0, standing = 0;
    for (const auto f : room_.faces) {
      const FaceGrid& grid = grids_[static_cast<std::size_t>(f)];
      if (building_.faces[static_cast<std::size_t>(f)].surface != SurfaceClass::wall) continue;
      seen_walls += grid.area(FaceGrid::seen);
      all_walls += grid.area(FaceGrid::seen) + grid.area(FaceGrid::unseen);
      for (int x = 0; x < grid.width; ++x) {
        const Column column = column_of(grid, x);
        if (column.squares * grid.step().y() < least_wall) continue;
        length += grid.step().x();
        if (column.seen < least_share * column.squares ||
            column.highest_seen - column.lowest < least_top * column.squares)
          continue;
        seen_length += grid.step().x();
        if (stands(grid, x, column)) standing += grid.step().x();
      }
    }
    RoomEvidence result;
    result.walls = all_walls > 0 ? seen_walls / all_walls : 0;
    result.enclosed = length > 0 ? seen_length / length : 0;
    result.contact = seen_length > 0 ? standing / seen_length : 0;
    result.floor = share_of(SurfaceClass::floor);
    result.ceiling = share_of(SurfaceClass::ceiling);
    for (const auto f : room_.faces) result.open_top += open_top_of(building_.faces[static_cast<std::size_t>(f)]);
    return result;
  }

 private:
  /// Metres of a wall that end below a ceiling which goes on behind it.
  double open_top_of(const BuildingFace& face) const {
    if (face.surface != SurfaceClass::wall || face.primitive < 0 ||
        static_cast<std::size_t>(face.primitive) >= walls_.size())
      return 0;
    const Footprint& wall = walls_[static_cast<std::size_t>(face.primitive)];
    double begin = 1e300, end = -1e300;
    for (const auto v : face.outline) {
      const double at = wall.along.dot(building_.vertices[v].head<2>());
      begin = std::min(begin, at);
      end = std::max(end, at);
    }
    const auto columns = static_cast<int>(wall.open_top.size());
    double length = 0;
    for (int c = std::max(0, wall.raster.column(begin)); c < std::min(columns, wall.raster.column(end) + 1); ++c)
      length += wall.raster.pixel * (wall.open_top[static_cast<std::size_t>(c)] > 0.5 ? 1 : 0);
    return length;
  }

  struct Column {
    int squares = 0, seen = 0;
    int lowest = -1, highest = -1;  // of the face
    int lowest_seen = -1, highest_seen = -1;
  };
  static Column column_of(const FaceGrid& grid, int x) {
    Column column;
    for (int y = 0; y < grid.height; ++y) {
      const auto what = grid.at(x, y);
      if (what == FaceGrid::outside) continue;
      ++column.squares;
      if (column.lowest < 0) column.lowest = y;
      column.highest = y;
      if (what != FaceGrid::seen) continue;
      ++column.seen;
      if (column.lowest_seen < 0) column.lowest_seen = y;
      column.highest_seen = y;
    }
    return column;
  }

  bool stands(const FaceGrid& grid, int x, const Column& column) const {
    const Eigen::Vector3d normal = grid.frame.u.cross(grid.frame.v);
    const auto near = [&](int y) -> Eigen::Vector2d {
      return (grid.frame.to_space(grid.centre(x, y)) + in_front * normal).head<2>();
    };
    const double step = grid.step().y();
    return ((column.lowest_seen - column.lowest) * step < reach && seen(SurfaceClass::floor, near(column.lowest))) ||
           ((column.highest - column.highest_seen) * step < reach && seen(SurfaceClass::ceiling, near(column.highest)));
  }

  /// Whether the room's floor or ceiling was seen at a place or in a square beside it.
  bool seen(SurfaceClass surface, const Eigen::Vector2d& place) const {
    for (const auto f : room_.faces) {
      const FaceGrid& grid = grids_[static_cast<std::size_t>(f)];
      if (building_.faces[static_cast<std::size_t>(f)].surface != surface) continue;
      const auto z = grid.height_over(place);
      if (!z) continue;
      const Eigen::Vector2d p = grid.frame.to_plane({place.x(), place.y(), *z});
      for (int y = -1; y <= 1; ++y)
        for (int u = -1; u <= 1; ++u)
          if (grid.at(grid.column(p.x()) + u, grid.row(p.y()) + y) == FaceGrid::seen) return true;
    }
    return false;
  }

  double share_of(SurfaceClass surface) const {
    double seen = 0, all = 0;
    for (const auto f : room_.faces) {
      if (building_.faces[static_cast<std::size_t>(f)].surface != surface) continue;
      const FaceGrid& grid = grids_[static_cast<std::size_t>(f)];
      seen += grid.area(FaceGrid::seen);
      all += grid.area(FaceGrid::seen) + grid.area(FaceGrid::unseen);
    }
    return all > 0 ? seen / all : 0;
  }

  const Building& building_;
  const BuildingRoom& room_;
  const std::vector<FaceGrid>& grids_;
  const std::vector<Footprint>& walls_;
};

double perimeter(const BuildingRoom& room) {
  double length = 0;
  for (std::size_t i = 0; i < room.outline.size(); ++i)
    length += (room.outline[(i + 1) % room.outline.size()] - room.outline[i]).head<2>().norm();
  return length;
}

/// Whether upright planes fill the column up to the ceiling, and most of it below.
bool is_wall(const RoomColumns::Column& column) {
  const int levels = column.levels();
  return (column.stacked >> static_cast<unsigned>(levels - 1) & 1U) != 0 &&
         std::popcount(column.stacked) >= full_height * levels;
}

/// The share of the columns in the largest connected piece whose floor was seen and whose ceiling was not.
double largest_open_piece(const RoomColumns& columns, std::size_t inner) {
  const auto is_open = [&](const RoomColumns::Column* column) {
    return column != nullptr && column->floor_seen && !column->ceiling_seen;
  };
  std::vector<bool> visited(columns.columns.size(), false);
  std::size_t largest = 0;
  std::vector<Eigen::Vector2i> left;
  for (int y = 0; y < columns.height; ++y)
    for (int x = 0; x < columns.width; ++x) {
      std::size_t piece = 0;
      left.assign(1, columns.low + Eigen::Vector2i(x, y));
      while (!left.empty()) {
        const Eigen::Vector2i at = left.back();
        left.pop_back();
        const auto* column = columns.at(at);
        if (!is_open(column)) continue;
        auto seen = visited[static_cast<std::size_t>(column - columns.columns.data())];
        if (seen) continue;
        seen = true;
        ++piece;
        for (const auto& step :
             {Eigen::Vector2i(1, 0), Eigen::Vector2i(-1, 0), Eigen::Vector2i(0, 1), Eigen::Vector2i(0, -1)})
          left.push_back(at + step);
      }
      largest = std::max(largest, piece);
    }
  return static_cast<double>(largest) / static_cast<double>(inner);
}

void measure_columns(const BuildingRoom& room, const RoomColumns& columns, RoomEvidence& evidence) {
  std::vector<double> heights;
  std::size_t inner = 0, other_floor = 0, low_level = 0, other_ceiling = 0;
  for (const auto& column : columns.columns) {
    if (!column.inside) continue;
    heights.push_back(column.height());
    inner += column.height() > least_wall && is_wall(column) ? 1 : 0;
    other_floor += column.other_floor && !column.floor_seen ? 1 : 0;
    low_level += column.low_level && !column.other_floor && !column.floor_seen ? 1 : 0;
    other_ceiling += column.other_ceiling && !column.ceiling_seen ? 1 : 0;
  }
  constexpr double more_than_beds = 5;  // m²
  if (static_cast<double>(low_level) * RoomColumns::square * RoomColumns::square > more_than_beds)
    other_floor += low_level;
  const double around = perimeter(room);
  if (around > 0) evidence.width = 2 * room.area / around;
  if (heights.empty()) {
    evidence.headroom = room.height;
    return;
  }
  const auto all = static_cast<double>(heights.size());
  if (around > 0) evidence.inner_walls = static_cast<double>(inner) * RoomColumns::square / around;
  const auto roofed = std::count_if(columns.columns.begin(), columns.columns.end(),
                                    [](const auto& column) { return column.inside && column.ceiling_seen; });
  constexpr double some = 0.1;  // of the ceiling: with less it was not scanned
  if (static_cast<double>(roofed) > some * all) evidence.open_part = largest_open_piece(columns, heights.size());
  evidence.other_floor = static_cast<double>(other_floor) / all;
  evidence.other_ceiling = static_cast<double>(other_ceiling) / all;
  std::sort(heights.rbegin(), heights.rend());
  const auto square_metre = static_cast<std::size_t>(1 / (RoomColumns::square * RoomColumns::square));
  evidence.headroom = heights[std::min(square_metre, heights.size()) - 1];
}

/// The share of each room that another one has too: squares at which both have at least 0.3 m of height in common.
void measure_overlaps(const std::vector<RoomColumns>& rooms, std::vector<RoomEvidence>& evidence) {
  constexpr double least = 0.3;  // metres
  using Entry = std::pair<std::size_t, const RoomColumns::Column*>;
  std::map<std::pair<int, int>, std::vector<Entry>> places;
  std::vector<std::size_t> all(rooms.size(), 0), shared(rooms.size(), 0);
  for (std::size_t r = 0; r < rooms.size(); ++r)
    for (int y = 0; y < rooms[r].height; ++y)
      for (int x = 0; x < rooms[r].width; ++x)
        if (const auto* column = rooms[r].at(rooms[r].low + Eigen::Vector2i(x, y))) {
          places[{rooms[r].low.x() + x, rooms[r].low.y() + y}].emplace_back(r, column);
          ++all[r];
        }
  for (const auto& [place, entries] : places)
    for (const auto& [a, mine] : entries)
      shared[a] += std::any_of(entries.begin(), entries.end(), [&, room = a, column = mine](const Entry& other) {
        return other.first != room &&
               std::min(column->ceiling, other.second->ceiling) - std::max(column->floor, other.second->floor) > least;
      });
  for (std::size_t r = 0; r < rooms.size(); ++r)
    if (all[r] > 0) evidence[r].overlap = static_cast<double>(shared[r]) / static_cast<double>(all[r]);
}

}  // namespace

std::vector<RoomEvidence> room_evidence(const Building& building, const PlanePrimitives& planes,
                                        const std::vector<FaceGrid>& grids, const std::vector<Footprint>& walls) {
  const auto columns = room_columns(building, planes, grids);
  std::vector<RoomEvidence> result;
  result.reserve(building.rooms.size());
  for (std::size_t r = 0; r < building.rooms.size(); ++r) {
    result.push_back(Measuring(building, building.rooms[r], grids, walls).run());
    measure_columns(building.rooms[r], columns[r], result.back());
  }
  measure_overlaps(columns, result);
  return result;
}

}  // namespace atrium::layout
