#include "modules/layout/room_columns.hpp"

#include <algorithm>
#include <cmath>

#include "modules/layout/raster.hpp"

namespace atrium::layout {
namespace {

using Rings = std::vector<std::vector<Eigen::Vector2d>>;

constexpr double apart = 0.4;                               // metres from the outline
constexpr double off_level = 0.15;                          // metres: further from floor or ceiling it is another one
constexpr double headroom = 1.8;                            // metres that another floor or ceiling leaves
constexpr double step_up = 0.25, highest_furniture = 0.95;  // metres over the floor: beds, tubs, tables, worktops
constexpr double faces_up = 0.9;                            // cosine: what one can stand on
constexpr double slanted = 0.5;                             // cosine: ceilings may be slopes of up to 60 degrees

Rings rings_of(const BuildingRoom& room) {
  Rings rings(1 + room.holes.size());
  for (const auto& p : room.outline) rings[0].emplace_back(p.head<2>());
  for (std::size_t i = 0; i < room.holes.size(); ++i)
    for (const auto& p : room.holes[i]) rings[i + 1].emplace_back(p.head<2>());
  return rings;
}

/// The height of the room's floor or ceiling over a place, and whether it was seen there.
bool level_over(const Building& building, const BuildingRoom& room, const std::vector<FaceGrid>& grids,
                SurfaceClass surface, const Eigen::Vector2d& p, double& height, bool& seen) {
  for (const auto f : room.faces) {
    const auto index = static_cast<std::size_t>(f);
    if (building.faces[index].surface != surface) continue;
    const auto z = grids[index].height_over(p);
    if (!z) continue;
    height = *z;
    seen = grids[index].at(grids[index].frame.to_plane({p.x(), p.y(), *z})) == FaceGrid::seen;
    return true;
  }
  return false;
}

RoomColumns columns_of(const Building& building, const BuildingRoom& room, const std::vector<FaceGrid>& grids) {
  RoomColumns result;
  const Rings rings = rings_of(room);
  if (rings[0].size() < 3) return result;
  Eigen::AlignedBox2d box;
  for (const auto& p : rings[0]) box.extend(p);
  result.low = RoomColumns::square_of(box.min());
  const Eigen::Vector2i size = RoomColumns::square_of(box.max()) - result.low + Eigen::Vector2i::Ones();
  result.width = size.x();
  result.height = size.y();
  result.columns.resize(static_cast<std::size_t>(size.x()) * static_cast<std::size_t>(size.y()));
  for (int y = 0; y < size.y(); ++y)
    for (int x = 0; x < size.x(); ++x) {
      RoomColumns::Column& column =
          result
              .columns[static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x()) + static_cast<std::size_t>(x)];
      const Eigen::Vector2d p = result.centre(x, y);
      column.inside = inside_rings(rings, p) &&
                      level_over(building, room, grids, SurfaceClass::floor, p, column.floor, column.floor_seen) &&
                      level_over(building, room, grids, SurfaceClass::ceiling, p, column.ceiling, column.ceiling_seen);
      column.apart = column.inside && distance_to_rings(rings, p) > apart;
    }
  return result;
}

/// Calls visit(place, rooms) for the points of a primitive, with the columns that stand over each.
template <class Visit>
void each_column(const PlanePrimitive& primitive, const Cloud& cloud, std::vector<RoomColumns>& rooms,
                 const Visit& visit) {
  Eigen::AlignedBox2i box;
  for (const auto i : primitive.inliers) box.extend(RoomColumns::square_of(cloud.points[i].head<2>().cast<double>()));
  for (auto& room : rooms) {
    const Eigen::AlignedBox2i its(room.low, room.low + Eigen::Vector2i(room.width - 1, room.height - 1));
    if (room.columns.empty() || !its.intersects(box)) continue;
    for (const auto i : primitive.inliers) {
      const Eigen::Vector3d p = cloud.points[i].cast<double>();
      if (auto* column = room.at(RoomColumns::square_of(p.head<2>()))) visit(p.z(), *column);
    }
  }
}

void stack(double z, RoomColumns::Column& column) {
  if (!column.apart || !(column.height() > 0)) return;
  const double share = (z - column.floor) / column.height();
  if (share < 0 || share >= 1) return;
  column.stacked |= std::uint64_t{1} << static_cast<unsigned>(share * column.levels());
}

}  // namespace

std::vector<RoomColumns> room_columns(const Building& building, const PlanePrimitives& planes,
                                      const std::vector<FaceGrid>& grids) {
  std::vector<RoomColumns> rooms;
  rooms.reserve(building.rooms.size());
  for (const auto& room : building.rooms) rooms.push_back(columns_of(building, room, grids));
  for (const auto& primitive : planes.primitives) {
    const double up = primitive.plane.normal.z();
    if (is_upright(primitive.plane))
      each_column(primitive, *planes.cloud, rooms, [](double z, auto& column) { stack(z, column); });
    else if (up > faces_up)
      each_column(primitive, *planes.cloud, rooms, [](double z, auto& column) {
        if (z <= column.floor + off_level || z >= column.ceiling - headroom) return;
        const bool furniture = z > column.floor + step_up && z < column.floor + highest_furniture;
        (furniture ? column.low_level : column.other_floor) = true;
      });
    else if (up < -slanted)
      each_column(primitive, *planes.cloud, rooms, [](double z, auto& column) {
        if (z > column.floor + headroom && z < column.ceiling - off_level) column.other_ceiling = true;
      });
  }
  return rooms;
}

}  // namespace atrium::layout
