#include "modules/layout/faces.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "graph/api/error.hpp"
#include "graph/api/text.hpp"
#include "modules/layout/face_rings.hpp"
#include "modules/layout/raster.hpp"
#include "modules/layout/room_cells.hpp"
#include "modules/layout/room_surface.hpp"
#include "modules/types/ground_truth.hpp"

namespace atrium::layout {
namespace {

class Assembly {
 public:
  Assembly(const CellComplex& cells, const Structure& structure, Context& context)
      : cells_(cells),
        planes_(*structure.primitives),
        footprints_(footprints(planes_, cells.pixel, context)),
        context_(context) {
    building_.origin = cells.origin;
  }

  Building run() {
    std::vector<StoreyCells> storeys = cells_.storeys;
    for (auto& storey : storeys) {
      building_.storeys.push_back({storey.floor_height, storey.ceiling_height - storey.floor_height});
      cut_pinched_cells(storey);
      split_crossing_steps(storey);
    }
    warn_of_lost_rooms(storeys);
    building_.rooms.resize(static_cast<std::size_t>(number_rooms(storeys)));
    if (building_.rooms.empty()) refuse();
    for (std::size_t s = 0; s < storeys.size(); ++s) add_storey(storeys[s], static_cast<std::int32_t>(s));
    set_storey_heights();
    return std::move(building_);
  }

 private:
  static std::set<std::int32_t> rooms_of(const StoreyCells& storey) {
    std::set<std::int32_t> rooms;
    for (const auto& cell : storey.cells)
      if (cell.room >= 0) rooms.insert(cell.room);
    return rooms;
  }

  void warn_of_lost_rooms(const std::vector<StoreyCells>& cut) const {
    for (std::size_t s = 0; s < cut.size(); ++s) {
      const auto left = rooms_of(cut[s]);
      for (const auto room : rooms_of(cells_.storeys[s])) {
        if (left.count(room) != 0) continue;
        double area = 0;
        for (const auto& cell : cells_.storeys[s].cells) area += cell.room == room ? cell.area : 0;
        context_.warn(fmt::format(
            "storey {}: a room of {:.1f} m2 is left out: its ceiling lies nowhere above its floor", s, area));
      }
    }
  }

  /// There is no room: says what the scan lacks.
  [[noreturn]] void refuse() const {
    bool inside = false, floors = false, ceilings = false, walls = false;
    for (const auto& storey : cells_.storeys) {
      inside = inside || !rooms_of(storey).empty();
      const auto seen = [](const CellSurface& surface) { return surface.primitive >= 0; };
      floors = floors || std::any_of(storey.floors.begin(), storey.floors.end(), seen);
      ceilings = ceilings || std::any_of(storey.ceilings.begin(), storey.ceilings.end(), seen);
      walls = walls || std::any_of(storey.lines.begin(), storey.lines.end(),
                                   [](const CellLine& line) { return !line.primitives.empty(); });
    }
    std::string lacking;
    for (const auto& [there, name] : {std::pair{floors, "floor"}, {ceilings, "ceiling"}, {walls, "wall"}})
      if (!there) lacking += fmt::format("{}no {}", lacking.empty() ? "" : " and ", name);
    if (lacking.empty()) lacking = "floors, ceilings and walls, but none of them around a space";
    throw Error(
        fmt::format("the scan shows no room: {} ({} found)",
                    inside ? "the ceilings lie nowhere above the floors" : "nothing is inside", lacking),
        "check that z points up and the lengths are metres, that normals look to where the scan was taken from, and "
        "that the planes keep floor and ceiling (smaller min_points); layout.rooms can ask for less (`min_area`, "
        "`min_cover`)");
  }

  void add_storey(const StoreyCells& storey, std::int32_t index) {
    for (const auto room : rooms_of(storey)) add_room(storey, index, room);
  }

  void add_room(const StoreyCells& storey, std::int32_t index, std::int32_t room) {
    const RoomSurface surface = room_surface(storey, room);
    BuildingRoom& entry = building_.rooms[static_cast<std::size_t>(room)];
    entry.name = fmt::format("room {}", room + 1);
    entry.storey = index;
    const auto base = static_cast<std::uint32_t>(building_.vertices.size());
    building_.vertices.insert(building_.vertices.end(), surface.vertices.begin(), surface.vertices.end());
    for (const auto& source : surface.faces) {
      entry.faces.push_back(static_cast<std::int32_t>(building_.faces.size()));
      add_face(storey, source, index, room, base);
    }
    entry.outline = raised(surface.outline, storey.floor_height);
    entry.holes.reserve(surface.holes.size());
    for (const auto& hole : surface.holes) entry.holes.push_back(raised(hole, storey.floor_height));
    measure_room(entry);
  }

  void add_face(const StoreyCells& storey, const RoomFace& source, std::int32_t index, std::int32_t room,
                std::uint32_t base) {
    BuildingFace face;
    face.surface = source.key.surface;
    face.storey = index;
    face.room = room;
    face.outline = moved(source.outline, base);
    face.holes.reserve(source.holes.size());
    for (const auto& hole : source.holes) face.holes.push_back(moved(hole, base));
    set_plane(storey, source.key, face);
    constexpr double steep = 0.5;  // cosine: what bounds a room at this angle is a wall that leans
    if (std::abs(face.plane.normal.z()) < steep) face.surface = SurfaceClass::wall;
    building_.faces.push_back(std::move(face));
  }

  static std::vector<Eigen::Vector3d> raised(const std::vector<Eigen::Vector2d>& ring, double height) {
    std::vector<Eigen::Vector3d> result;
    result.reserve(ring.size());
    for (const auto& p : ring) result.emplace_back(p.x(), p.y(), height);
    return result;
  }

  static Ring moved(Ring ring, std::uint32_t base) {
    for (auto& v : ring) v += base;
    return ring;
  }

  void set_plane(const StoreyCells& storey, const FaceKey& key, BuildingFace& face) {
    std::vector<std::int32_t> candidates;
    if (key.surface == SurfaceClass::wall) {
      if (key.index < 0) return;
      const CellLine& line = storey.lines[static_cast<std::size_t>(key.index)];
      const double side = key.along_normal ? 1 : -1;
      face.plane = {side * Eigen::Vector3d(line.normal.x(), line.normal.y(), 0), side * line.offset};
      candidates = line.primitives;
    } else {
      const CellSurface& surface =
          (key.surface == SurfaceClass::floor ? storey.floors : storey.ceilings)[static_cast<std::size_t>(key.index)];
      face.plane = surface.plane;
      if ((face.plane.normal.z() > 0) != (key.surface == SurfaceClass::floor))
        face.plane = {-face.plane.normal, -face.plane.offset};
      if (surface.primitive >= 0) candidates = {surface.primitive};
      candidates.insert(candidates.end(), surface.joined.begin(), surface.joined.end());
    }
    std::erase_if(candidates, [&](std::int32_t p) {
      return planes_.primitives[static_cast<std::size_t>(p)].plane.normal.dot(face.plane.normal) <= 0;
    });
    observe(candidates, face);
  }

  /// Which of the primitives were seen on the face, and on how much of it.
  void observe(const std::vector<std::int32_t>& candidates, BuildingFace& face) const {
    const auto& v = building_.vertices;
    const Eigen::Vector3d& n = face.plane.normal;
    const bool upright = is_upright(face.plane);
    const Eigen::Vector2d along = upright ? Eigen::Vector2d(-n.y(), n.x()).normalized() : Eigen::Vector2d::UnitX();
    const auto flat = [&](const Eigen::Vector3d& p) {
      return upright ? Eigen::Vector2d(along.dot(p.head<2>()), p.z()) : Eigen::Vector2d(p.head<2>());
    };
    Eigen::AlignedBox2d box;
    std::vector<std::vector<Eigen::Vector2d>> rings;
    const auto add = [&](const Ring& ring) {
      rings.emplace_back();
      for (const auto i : ring) rings.back().push_back(flat(v[i]));
      for (const auto& p : rings.back()) box.extend(p);
    };
    add(face.outline);
    for (const auto& hole : face.holes) add(hole);
    const double pixel = std::min(cells_.pixel, std::sqrt(std::max(box.volume(), 1e-6)) / 4);
    std::vector<std::size_t> seen(candidates.size(), 0);
    std::size_t samples = 0, covered = 0;
    for (double y = box.min().y() + pixel / 2; y < box.max().y(); y += pixel)
      for (double x = box.min().x() + pixel / 2; x < box.max().x(); x += pixel) {
        if (!inside(rings, {x, y})) continue;
        ++samples;
        bool any = false;
        for (std::size_t c = 0; c < candidates.size(); ++c) {
          const Footprint& f = footprints_[static_cast<std::size_t>(candidates[c])];
          const double t = !upright || f.along.dot(along) > 0 ? x : -x;
          if (!f.raster.at(Eigen::Vector2d(t, y))) continue;
          ++seen[c];
          any = true;
        }
        covered += any ? 1 : 0;
      }
    if (samples == 0 || covered == 0) return;
    face.observed = static_cast<double>(covered) / static_cast<double>(samples);
    const auto best = static_cast<std::size_t>(std::max_element(seen.begin(), seen.end()) - seen.begin());
    face.primitive = candidates[best];
    face.residual = planes_.primitives[static_cast<std::size_t>(face.primitive)].residual;
  }

  static bool inside(const std::vector<std::vector<Eigen::Vector2d>>& rings, const Eigen::Vector2d& p) {
    bool result = false;
    for (const auto& ring : rings)
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Eigen::Vector2d &a = ring[i], &b = ring[(i + 1) % ring.size()];
        if ((a.y() > p.y()) == (b.y() > p.y())) continue;
        if (p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y())) result = !result;
      }
    return result;
  }

  void measure_room(BuildingRoom& room) const {
    const auto& v = building_.vertices;
    for (const auto f : room.faces) {
      const BuildingFace& face = building_.faces[static_cast<std::size_t>(f)];
      const Eigen::Vector3d& n = face.plane.normal;
      double area = signed_area(face.outline, v, n);
      for (const auto& hole : face.holes) area += signed_area(hole, v, n);
      // The divergence theorem over faces that look inside.
      room.volume -= area * n.dot(v[face.outline[0]]) / 3;
    }
    // As seen from above, however the floor slopes.
    room.area = area_vector(room.outline).z();
    for (const auto& hole : room.holes) room.area += area_vector(hole).z();
    if (room.area > 0) room.height = room.volume / room.area;
  }

  /// The mean height of a storey's rooms. A storey without rooms keeps that of its planes.
  void set_storey_heights() {
    std::vector<double> areas(building_.storeys.size(), 0), volumes(building_.storeys.size(), 0);
    for (const auto& room : building_.rooms) {
      areas[static_cast<std::size_t>(room.storey)] += room.area;
      volumes[static_cast<std::size_t>(room.storey)] += room.volume;
    }
    for (std::size_t s = 0; s < areas.size(); ++s)
      if (areas[s] > 0) building_.storeys[s].height = volumes[s] / areas[s];
  }

  const CellComplex& cells_;
  const PlanePrimitives& planes_;
  std::vector<Footprint> footprints_;
  Context& context_;
  Building building_;
};

}  // namespace

Faces::Out Faces::run(const In& in, Context& context) {
  Out out{Assembly(*in.cells, *in.structure, context).run()};
  context.info(fmt::format("{}, {}, {}", counted(out.building.rooms.size(), "room"),
                           counted(out.building.faces.size(), "face"),
                           counted(out.building.vertices.size(), "corner")));
  return out;
}

}  // namespace atrium::layout
