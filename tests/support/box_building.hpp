#pragma once
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "modules/types/building.hpp"

namespace atrium::test {

/// Puts a building together from boxes.
class BoxBuilding {
 public:
  Building building;

  BoxBuilding() { building.storeys = {{0, 2.5}}; }

  /// A room from (x0, y0) to (x1, y1); its faces are floor, ceiling, and the walls at y0, x1, y1, x0.
  void room(double x0, double y0, double x1, double y1, double low = 0, double high = 2.5, std::int32_t storey = 0) {
    const auto room = static_cast<std::int32_t>(building.rooms.size());
    const auto v = static_cast<std::uint32_t>(building.vertices.size());
    for (const double z : {low, high})
      for (const auto& p : std::vector<Eigen::Vector2d>{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}})
        building.vertices.emplace_back(p.x(), p.y(), z);
    BuildingRoom entry;
    entry.name = "room " + std::to_string(room + 1);
    entry.storey = storey;
    entry.area = (x1 - x0) * (y1 - y0);
    entry.height = high - low;
    entry.volume = entry.area * entry.height;
    for (std::uint32_t i = 0; i < 4; ++i) entry.outline.push_back(building.vertices[v + i]);
    const auto add = [&](SurfaceClass surface, std::vector<std::uint32_t> ring) {
      BuildingFace face;
      face.surface = surface;
      face.storey = storey;
      face.room = room;
      face.primitive = static_cast<std::int32_t>(building.faces.size());
      face.observed = 0.9;
      face.residual = 0.004;
      for (auto& corner : ring) corner += v;
      const auto& at = building.vertices;
      face.plane.normal = (at[ring[1]] - at[ring[0]]).cross(at[ring[2]] - at[ring[1]]).normalized();
      face.plane.offset = -face.plane.normal.dot(at[ring[0]]);
      face.outline = std::move(ring);
      entry.faces.push_back(static_cast<std::int32_t>(building.faces.size()));
      building.faces.push_back(std::move(face));
    };
    add(SurfaceClass::floor, {0, 1, 2, 3});
    add(SurfaceClass::ceiling, {4, 7, 6, 5});
    add(SurfaceClass::wall, {0, 4, 5, 1});
    add(SurfaceClass::wall, {1, 5, 6, 2});
    add(SurfaceClass::wall, {2, 6, 7, 3});
    add(SurfaceClass::wall, {3, 7, 4, 0});
    building.rooms.push_back(std::move(entry));
  }

  /// Two rooms, 4 m × 3 m and 2.88 m × 3 m, 12 cm apart: a door from x = 4 to 4.12 at y 0.5 to 1.4, 2.1 m high, and a
  /// window in the first room's wall y = 0, x 1 to 2.5, z 0.9 to 2.1.
  static Building two_rooms() {
    BoxBuilding b;
    b.room(0, 0, 4, 3);
    b.room(4.12, 0, 7, 3);
    BuildingOpening door{"door", 0, 1, 3, 11, 0.12, {}, {}};
    door.outline_a = {{4, 0.5, 0}, {4, 0.5, 2.1}, {4, 1.4, 2.1}, {4, 1.4, 0}};
    door.outline_b = {{4.12, 1.4, 0}, {4.12, 1.4, 2.1}, {4.12, 0.5, 2.1}, {4.12, 0.5, 0}};
    BuildingOpening window{"window", 0, -1, 2, -1, 0, {}, {}};
    window.outline_a = {{1, 0, 0.9}, {1, 0, 2.1}, {2.5, 0, 2.1}, {2.5, 0, 0.9}};
    b.building.openings = {door, window};
    b.building.walls = {{3, 11, 0.12, 7.5}};
    return b.building;
  }
};

}  // namespace atrium::test
