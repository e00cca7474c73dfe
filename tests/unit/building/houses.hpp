#pragma once
#include "modules/geometry/polygon.hpp"
#include "tests/support/box_building.hpp"

namespace atrium::test {

/// Rooms of any plan with ceilings of any plane.
class House {
 public:
  Building building;

  House() { building.storeys = {{0, 2.5}}; }

  /// A room over a counter-clockwise plan whose walls end at `high(x, y)`, which is linear over each of `ceilings`:
  /// lists of indices into the plan followed by `extra` points (a ridge), counter-clockwise from above. `peaks` gives
  /// for each side of the plan the extra points on its wall, from its first corner to its second.
  struct Plan {
    std::vector<Eigen::Vector2d> plan;
    std::vector<Eigen::Vector2d> extra;
    std::vector<std::vector<std::uint32_t>> ceilings;
    std::vector<std::vector<std::uint32_t>> peaks;
    std::vector<Eigen::Vector2d> column;  ///< counter-clockwise; a hole in plan, floor and (only) ceiling
  };
  template <class Height>
  void room(const Plan& shape, double low, Height high, std::int32_t storey = 0) {
    const auto index = static_cast<std::int32_t>(building.rooms.size());
    const auto first = static_cast<std::uint32_t>(building.vertices.size());
    const auto n = static_cast<std::uint32_t>(shape.plan.size()), m = static_cast<std::uint32_t>(shape.extra.size());
    const auto c = static_cast<std::uint32_t>(shape.column.size());
    for (const auto& p : shape.plan) building.vertices.emplace_back(p.x(), p.y(), low);
    for (const auto& p : shape.plan) building.vertices.emplace_back(p.x(), p.y(), high(p.x(), p.y()));
    for (const auto& p : shape.extra) building.vertices.emplace_back(p.x(), p.y(), high(p.x(), p.y()));
    for (const auto& p : shape.column) building.vertices.emplace_back(p.x(), p.y(), low);
    for (const auto& p : shape.column) building.vertices.emplace_back(p.x(), p.y(), high(p.x(), p.y()));
    const std::uint32_t column = first + 2 * n + m;
    const auto top = [&](std::uint32_t i) { return first + n + i; };
    BuildingRoom room;
    room.name = "room " + std::to_string(index + 1);
    room.storey = storey;
    for (std::uint32_t i = 0; i < n; ++i) room.outline.push_back(building.vertices[first + i]);
    room.area = area(shape.plan);
    if (c > 0) {
      room.area -= area(shape.column);
      room.holes.emplace_back();
      for (std::uint32_t i = c; i-- > 0;) room.holes.back().push_back(building.vertices[column + i]);
    }
    building.rooms.push_back(room);
    std::vector<std::uint32_t> floor, floor_hole, ceiling_hole;
    for (std::uint32_t i = 0; i < n; ++i) floor.push_back(first + i);
    for (std::uint32_t i = 0; i < c; ++i) {
      floor_hole.insert(floor_hole.begin(), column + i);
      ceiling_hole.push_back(column + c + i);
    }
    face(SurfaceClass::floor, floor, floor_hole);
    for (const auto& ring : shape.ceilings) {
      std::vector<std::uint32_t> turned;
      for (auto i = ring.rbegin(); i != ring.rend(); ++i) turned.push_back(top(*i));
      face(SurfaceClass::ceiling, turned, ceiling_hole);
    }
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t next = (i + 1) % n;
      std::vector<std::uint32_t> ring{first + i, top(i)};
      if (i < shape.peaks.size())
        for (const auto p : shape.peaks[i]) ring.push_back(top(p));
      ring.push_back(top(next));
      ring.push_back(first + next);
      face(SurfaceClass::wall, ring, {});
    }
    for (std::uint32_t i = 0; i < c; ++i) {
      const std::uint32_t next = (i + 1) % c;
      face(SurfaceClass::wall, {column + next, column + c + next, column + c + i, column + i}, {});
    }
    measure(building.rooms.back());
  }

  static Plan rectangle(double x0, double y0, double x1, double y1) {
    return {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, {}, {{0, 1, 2, 3}}, {}, {}};
  }
  /// A rectangle with a ridge along y over the middle of x.
  static Plan gable(double x0, double y0, double x1, double y1) {
    const double middle = 0.5 * (x0 + x1);
    Plan plan = rectangle(x0, y0, x1, y1);
    plan.extra = {{middle, y0}, {middle, y1}};
    plan.ceilings = {{0, 4, 5, 3}, {4, 1, 2, 5}};
    plan.peaks = {{4}, {}, {5}, {}};
    return plan;
  }

 private:
  void face(SurfaceClass surface, const std::vector<std::uint32_t>& ring, const std::vector<std::uint32_t>& hole) {
    BuildingFace face;
    face.surface = surface;
    face.storey = building.rooms.back().storey;
    face.room = static_cast<std::int32_t>(building.rooms.size()) - 1;
    face.primitive = static_cast<std::int32_t>(building.faces.size());
    face.observed = 0.8;
    face.residual = 0.003;
    face.outline = ring;
    if (!hole.empty()) face.holes = {hole};
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    const auto& at = building.vertices;
    for (std::size_t i = 1; i + 1 < ring.size(); ++i)
      normal += (at[ring[i]] - at[ring[0]]).cross(at[ring[i + 1]] - at[ring[0]]);
    face.plane.normal = normal.normalized();
    face.plane.offset = -face.plane.normal.dot(at[ring[0]]);
    building.rooms.back().faces.push_back(static_cast<std::int32_t>(building.faces.size()));
    building.faces.push_back(std::move(face));
  }
  void measure(BuildingRoom& room) const {
    for (const auto f : room.faces) {
      const BuildingFace& face = building.faces[static_cast<std::size_t>(f)];
      const auto add = [&](const std::vector<std::uint32_t>& ring) {
        for (std::size_t i = 1; i + 1 < ring.size(); ++i)
          room.volume -=
              building.vertices[ring[0]].dot(building.vertices[ring[i]].cross(building.vertices[ring[i + 1]])) / 6;
      };
      add(face.outline);
      for (const auto& hole : face.holes) add(hole);
    }
    room.height = room.volume / room.area;
  }
};

}  // namespace atrium::test
