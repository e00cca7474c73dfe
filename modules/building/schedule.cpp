#include "modules/building/schedule.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "graph/api/write_output.hpp"
#include "modules/building/elements.hpp"
#include "modules/building/ifc_context.hpp"
#include "modules/building/opening_size.hpp"
#include "modules/building/table.hpp"
#include "modules/building/upright_building.hpp"
#include "modules/geometry/polygon.hpp"
#include "modules/types/building_rules.hpp"

namespace atrium::building {
namespace {

std::string known(double value) { return value > 0 ? fmt::format("{:.3f}", value) : std::string(); }
std::string yes(bool value) { return value ? "yes" : "no"; }

double area_of(const Building& building, const BuildingFace& face) {
  const auto ring_area = [&](const std::vector<std::uint32_t>& ring) {
    std::vector<Eigen::Vector3d> places;
    places.reserve(ring.size());
    for (const auto v : ring) places.push_back(building.vertices[v]);
    return vector_area(places).norm();
  };
  double sum = ring_area(face.outline);
  for (const auto& hole : face.holes) sum -= ring_area(hole);
  return sum;
}

std::string room_name(const Building& building, std::int32_t room) {
  return room < 0 ? std::string() : building.rooms[static_cast<std::size_t>(room)].name;
}

double perimeter(const std::vector<Eigen::Vector3d>& ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) sum += (ring[(i + 1) % ring.size()] - ring[i]).norm();
  return sum;
}

/// What a room's faces and openings come to.
struct RoomSums {
  double floor = 0, ceiling = 0, walls = 0, openings = 0;
  std::size_t doors = 0, windows = 0, passages = 0;
};

std::vector<RoomSums> sums_of(const Building& building) {
  std::vector<RoomSums> sums(building.rooms.size());
  for (const auto& face : building.faces) {
    if (face.room < 0) continue;
    RoomSums& sum = sums[static_cast<std::size_t>(face.room)];
    double& of = face.surface == SurfaceClass::floor     ? sum.floor
                 : face.surface == SurfaceClass::ceiling ? sum.ceiling
                                                         : sum.walls;
    of += area_of(building, face);
  }
  for (const auto& opening : building.openings) {
    const auto side = [&](std::int32_t f, const std::vector<Eigen::Vector3d>& outline) {
      if (f < 0 || outline.size() < 3) return;
      const BuildingFace& face = building.faces[static_cast<std::size_t>(f)];
      if (face.room >= 0 && face.surface == SurfaceClass::wall)
        sums[static_cast<std::size_t>(face.room)].openings += vector_area(outline).norm();
    };
    side(opening.face_a, opening.outline_a);
    side(opening.face_b, opening.outline_b);
    for (const auto room : {opening.room_a, opening.room_b}) {
      if (room < 0) continue;
      RoomSums& sum = sums[static_cast<std::size_t>(room)];
      sum.doors += opening.kind == "door" ? 1 : 0;
      sum.windows += opening.kind == "window" ? 1 : 0;
      sum.passages += opening.kind == "passage" ? 1 : 0;
    }
  }
  return sums;
}

std::string rooms_table(const Building& building) {
  CsvTable table(
      "number,name,storey,area_m2,perimeter_m,height_m,volume_m3,floor_m2,ceiling_m2,walls_gross_m2,walls_net_m2,doors,"
      "windows,passages,confidence,doubts");
  const std::vector<RoomSums> sums = sums_of(building);
  for (std::size_t r = 0; r < building.rooms.size(); ++r) {
    const BuildingRoom& room = building.rooms[r];
    double around = perimeter(room.outline);
    for (const auto& hole : room.holes) around += perimeter(hole);
    std::string doubts;
    for (const auto& doubt : room.doubts) doubts += (doubts.empty() ? "" : "; ") + doubt;
    const RoomSums& sum = sums[r];
    table << r << room.name << static_cast<std::size_t>(room.storey) << room.area << around << room.height
          << room.volume << sum.floor << sum.ceiling << sum.walls << sum.walls - sum.openings << sum.doors
          << sum.windows << sum.passages
          << (room.confidence < 0 ? std::string() : fmt::format("{:.3f}", room.confidence)) << doubts;
    table.end();
  }
  return table.text();
}

std::int32_t storey_of(const Building& building, const BuildingOpening& opening) {
  for (const auto f : {opening.face_a, opening.face_b})
    if (f >= 0) return building.faces[static_cast<std::size_t>(f)].storey;
  return 0;
}

std::string openings_table(const Building& building, const std::vector<std::string>& walls, bool windows) {
  CsvTable table(std::string(windows ? "name," : "name,kind,") +
                 "storey,from_room,to_room,width_m,height_m,sill_m,area_m2,wall_thickness_m,wall,corrected");
  const std::vector<std::string> names = opening_names(building);
  for (std::size_t o = 0; o < building.openings.size(); ++o) {
    const BuildingOpening& opening = building.openings[o];
    const bool listed = windows ? opening.kind == "window" : opening.kind == "door" || opening.kind == "passage";
    if (!listed) continue;
    const OpeningSize size = size_of(building, opening);
    table << names[o];
    if (!windows) table << opening.kind;
    table << static_cast<std::size_t>(storey_of(building, opening)) << room_name(building, opening.room_a)
          << room_name(building, opening.room_b) << size.width << size.height << size.sill << size.width * size.height
          << known(opening.thickness) << walls[o] << yes(!opening.corrections.empty());
    table.end();
  }
  return table.text();
}

std::string walls_table(const Building& building, const Elements& elements) {
  CsvTable table(
      "name,storey,left_room,right_room,length_m,thickness_m,thickness_assumed,height_m,gross_m2,net_m2,gross_m3,"
      "net_m3,doors_and_windows,coverage,inferred,faces,corrected");
  for (std::size_t w = 0; w < elements.walls.size(); ++w) {
    const Wall& wall = elements.walls[w];
    double area = 0, seen = 0;
    bool inferred = true, corrected = false;
    std::string faces;
    for (const auto f : wall.faces) {
      const BuildingFace& face = building.faces[static_cast<std::size_t>(f)];
      area += area_of(building, face);
      seen += area_of(building, face) * face.observed;
      inferred = inferred && face.primitive < 0;
      corrected = corrected || !face.corrections.empty();
      faces += fmt::format("{}{}", faces.empty() ? "" : " ", f);
    }
    const auto main = [](const WallHole& hole) { return hole.main; };
    const auto holes = static_cast<std::size_t>(std::count_if(wall.holes.begin(), wall.holes.end(), main));
    table << wall_name(w) << static_cast<std::size_t>(wall.storey) << room_name(building, wall.left_room)
          << room_name(building, wall.right_room) << wall.length << wall.thickness << yes(wall.assumed)
          << wall.high() - wall.low() << wall.gross_area() << wall.net_area() << wall.gross_volume()
          << wall.net_volume() << holes << (area > 0 ? seen / area : 0) << yes(inferred) << faces << yes(corrected);
    table.end();
  }
  return table.text();
}

}  // namespace

void Schedule::run(const In& in, const Params& params, Context& context) {
  check(*in.building);
  const Building building = upright_building(*in.building, in.transform ? *in.transform : Transform{}, true).building;
  if (building.rooms.empty()) context.warn("the building has no rooms: the schedules are empty");
  ElementLimits limits;
  limits.assumed_wall = params.assumed_thickness;
  limits.max_thickness = params.max_thickness;
  limits.max_column_width = params.max_column_width;
  const Elements elements = elements_of(building, limits);
  std::vector<std::string> walls(building.openings.size());
  for (std::size_t w = 0; w < elements.walls.size(); ++w)
    for (const auto& hole : elements.walls[w].holes)
      if (hole.main) walls[static_cast<std::size_t>(hole.opening)] = wall_name(w);
  const std::vector<std::pair<std::string, std::string>> files{
      {params.rooms.path, rooms_table(building)},
      {params.doors.path, openings_table(building, walls, false)},
      {params.windows.path, openings_table(building, walls, true)},
      {params.walls.path, walls_table(building, elements)}};
  for (const auto& [path, text] : files) {
    write_output(context, path, text);
  }
  return;
}

}  // namespace atrium::building
