#include "modules/io/building_json.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>

#include "modules/io/json_text.hpp"
#include "modules/types/building_rules.hpp"
#include "modules/types/ground_truth.hpp"

namespace atrium::io {
namespace {

using Json = JsonField::Json;
using CornerIndices = std::vector<std::uint32_t>;

constexpr std::int32_t any = std::numeric_limits<std::int32_t>::max();

Json json_of_rings(const std::vector<std::vector<Eigen::Vector3d>>& rings) {
  Json list = Json::array();
  for (const auto& ring : rings) list.push_back(json_of(ring));
  return list;
}

Json room_to_json(const BuildingRoom& room) {
  Json json{{"name", room.name},
            {"storey", room.storey},
            {"area", room.area},
            {"height", room.height},
            {"volume", room.volume},
            {"faces", room.faces},
            {"outline", json_of(room.outline)}};
  if (!room.holes.empty()) json["holes"] = json_of_rings(room.holes);
  if (room.confidence >= 0) json["confidence"] = room.confidence;
  if (room.confidence >= 0 || !room.doubts.empty()) json["doubts"] = room.doubts;
  return json;
}

double area_of(const Building& building, const BuildingFace& face) {
  const auto places = [&](const CornerIndices& ring) {
    std::vector<Eigen::Vector3d> result;
    for (const auto v : ring) result.push_back(building.vertices[v]);
    return result;
  };
  Eigen::Vector3d sum = area_vector(places(face.outline));
  for (const auto& hole : face.holes) sum += area_vector(places(hole));
  return sum.norm();
}

Json face_to_json(const Building& building, const BuildingFace& face) {
  Json json{{"class", name_of(face.surface)},
            {"storey", face.storey},
            {"room", face.room},
            {"area", area_of(building, face)},
            {"normal", json_of(face.plane.normal)},
            {"offset", face.plane.offset},
            {"primitive", face.primitive},
            {"inferred", face.primitive < 0},
            {"observed", face.observed},
            {"residual", face.residual},
            {"outline", face.outline}};
  if (!face.holes.empty()) json["holes"] = face.holes;
  if (face.backing > 0) json["backing"] = face.backing;
  if (!face.corrections.empty()) json["corrections"] = face.corrections;
  return json;
}

Json opening_to_json(const BuildingOpening& opening, const Eigen::Vector3d& up) {
  Json json{{"kind", opening.kind},     {"room_a", opening.room_a}, {"room_b", opening.room_b},
            {"face_a", opening.face_a}, {"face_b", opening.face_b}, {"thickness", opening.thickness}};
  if (opening.outline_a.size() >= 3) {
    // Along up and across it; of a hole in a slab the sides of its first corner.
    Eigen::Vector3d v =
        up - up.dot(area_vector(opening.outline_a).normalized()) * area_vector(opening.outline_a).normalized();
    v = v.norm() > 0.1 ? v.normalized() : (opening.outline_a[1] - opening.outline_a[0]).normalized();
    const Eigen::Vector3d u = area_vector(opening.outline_a).normalized().cross(v);
    Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity()), high = -low;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const auto& p : opening.outline_a) {
      low = low.cwiseMin(Eigen::Vector2d(u.dot(p), v.dot(p)));
      high = high.cwiseMax(Eigen::Vector2d(u.dot(p), v.dot(p)));
      middle += p / static_cast<double>(opening.outline_a.size());
    }
    json["position"] = json_of(middle);
    json["width"] = high.x() - low.x();
    json["height"] = high.y() - low.y();
  }
  json["outline_a"] = json_of(opening.outline_a);
  json["outline_b"] = json_of(opening.outline_b);
  if (!opening.corrections.empty()) json["corrections"] = opening.corrections;
  return json;
}

std::string unit_name(double metres) {
  constexpr std::array<std::pair<double, const char*>, 5> known{
      {{1.0, "m"}, {0.01, "cm"}, {0.001, "mm"}, {0.0254, "in"}, {0.3048, "ft"}}};
  for (const auto& [value, name] : known)
    if (std::abs(metres / value - 1) < 1e-9) return name;
  return fmt::format("{} m", metres);
}

/// A list of places that may be empty.
std::vector<Eigen::Vector3d> places_of(const JsonField& field) {
  std::vector<Eigen::Vector3d> result;
  for (const auto& item : field.items()) result.push_back(item.place());
  return result;
}
CornerIndices corners_of(const JsonField& field, std::int32_t last_vertex) {
  CornerIndices ring;
  for (const auto& item : field.items()) ring.push_back(static_cast<std::uint32_t>(item.whole(0, last_vertex)));
  if (ring.size() < 3) field.fail("has fewer than three corners");
  return ring;
}
Eigen::Vector3d direction_of(const JsonField& field) {
  Eigen::Vector3d direction = field.place();
  if (std::abs(direction.norm() - 1) > 1e-6) field.fail("is not of unit length");
  return direction;
}

std::vector<std::string> texts_of(const JsonField& field, const char* key) {
  std::vector<std::string> result;
  if (!field.has(key)) return result;
  for (const auto& item : field[key].items()) result.push_back(item.text());
  return result;
}

void confidence_from(const JsonField& field, double& confidence, std::vector<std::string>& doubts) {
  doubts = texts_of(field, "doubts");
  if (!field.has("confidence")) return;
  confidence = field["confidence"].number();
  if (!(confidence >= 0 && confidence <= 1)) field["confidence"].fail("is not between 0 and 1");
}

BuildingRoom room_from_json(const JsonField& field, std::int32_t last_storey, std::int32_t last_face) {
  BuildingRoom room;
  room.name = field["name"].text();
  room.storey = field["storey"].whole(0, last_storey);
  room.area = field["area"].number();
  room.height = field["height"].number();
  room.volume = field["volume"].number();
  for (const auto& f : field["faces"].items()) room.faces.push_back(f.whole(0, last_face));
  room.outline = places_of(field["outline"]);
  if (field.has("holes"))
    for (const auto& hole : field["holes"].items()) room.holes.push_back(places_of(hole));
  confidence_from(field, room.confidence, room.doubts);
  return room;
}

BuildingFace face_from_json(const JsonField& field, std::int32_t last_storey, std::int32_t last_room,
                            std::int32_t last_vertex) {
  BuildingFace face;
  face.surface = class_of(field["class"]);
  face.storey = field["storey"].whole(0, last_storey);
  face.room = field["room"].whole(-1, last_room);
  face.plane.normal = direction_of(field["normal"]);
  face.plane.offset = field["offset"].number();
  face.primitive = field["primitive"].whole(-1, any);
  face.observed = field["observed"].number();
  face.residual = field["residual"].number();
  face.outline = corners_of(field["outline"], last_vertex);
  if (field.has("holes"))
    for (const auto& hole : field["holes"].items()) face.holes.push_back(corners_of(hole, last_vertex));
  if (field.has("backing")) face.backing = field["backing"].number();
  if (face.backing < 0) field["backing"].fail("is below 0");
  face.corrections = texts_of(field, "corrections");
  return face;
}

BuildingOpening opening_from_json(const JsonField& field, std::int32_t last_room, std::int32_t last_face) {
  BuildingOpening opening;
  opening.kind = field["kind"].text();
  opening.room_a = field["room_a"].whole(-1, last_room);
  opening.room_b = field["room_b"].whole(-1, last_room);
  opening.face_a = field["face_a"].whole(-1, last_face);
  opening.face_b = field["face_b"].whole(-1, last_face);
  opening.thickness = field["thickness"].number();
  opening.outline_a = places_of(field["outline_a"]);
  opening.outline_b = places_of(field["outline_b"]);
  opening.corrections = texts_of(field, "corrections");
  return opening;
}

std::int32_t last_of(const JsonField& list) { return static_cast<std::int32_t>(list.items().size()) - 1; }

/// "accuracy.wall.rms" becomes {"wall": {"rms": …}}; what has other names is left out.
Json accuracy_to_json(const Metrics& metrics) {
  constexpr std::string_view prefix = "accuracy.";
  Json json = Json::object();
  for (const auto& metric : metrics.values) {
    if (!std::string_view(metric.name).starts_with(prefix)) continue;
    const std::string rest = metric.name.substr(prefix.size());
    const std::size_t dot = rest.find('.');
    if (dot == std::string::npos) continue;
    if (!std::isfinite(metric.value)) throw Error(metric.name + " is not finite");
    json[rest.substr(0, dot)][rest.substr(dot + 1)] = metric.value;
  }
  return json;
}

}  // namespace

std::string building_to_json(const Building& building, const Eigen::Vector3d& up, std::optional<double> scan_unit,
                             const Metrics* accuracy) {
  check(building);
  if (!up.allFinite()) throw Error("what is up in the building has a number that is not finite");
  Json root{{"atrium_building", 1}, {"units", "m"}, {"up", json_of(up)}, {"origin", json_of(building.origin)}};
  if (scan_unit) root["scan_unit"] = {{"name", unit_name(*scan_unit)}, {"metres", *scan_unit}};
  if (building.confidence >= 0) {
    root["confidence"] = building.confidence;
    root["doubts"] = building.doubts;
  }
  if (accuracy != nullptr) root["accuracy"] = accuracy_to_json(*accuracy);
  for (const char* list : {"storeys", "rooms", "faces", "openings", "walls"}) root[list] = Json::array();
  for (const auto& storey : building.storeys)
    root["storeys"].push_back({{"elevation", storey.elevation}, {"height", storey.height}});
  for (const auto& room : building.rooms) root["rooms"].push_back(room_to_json(room));
  for (const auto& face : building.faces) root["faces"].push_back(face_to_json(building, face));
  for (const auto& opening : building.openings) root["openings"].push_back(opening_to_json(opening, up));
  for (const auto& wall : building.walls)
    root["walls"].push_back(
        {{"face_a", wall.face_a}, {"face_b", wall.face_b}, {"thickness", wall.thickness}, {"area", wall.area}});
  root["vertices"] = json_of(building.vertices);
  return json_text(root, {"storeys", "rooms", "faces", "openings", "walls", "vertices"});
}

ReadBack building_from_json(const JsonField& root) {
  if (!root.has("atrium_building"))
    root.fail("is no building: it has no 'atrium_building'", "io.write_building documents the format");
  if (root["atrium_building"].number() != 1) root["atrium_building"].fail("is a version that is not known", "known: 1");
  if (root["units"].text() != "m") root["units"].fail("is not \"m\"");
  ReadBack result;
  Building& building = result.building;
  result.up = direction_of(root["up"]);
  building.origin = root["origin"].place();
  confidence_from(root, building.confidence, building.doubts);
  for (const auto& field : root["storeys"].items())
    building.storeys.push_back({field["elevation"].number(), field["height"].number()});
  building.vertices = places_of(root["vertices"]);
  const auto last_storey = last_of(root["storeys"]), last_room = last_of(root["rooms"]),
             last_face = last_of(root["faces"]), last_vertex = last_of(root["vertices"]);
  for (const auto& field : root["rooms"].items())
    building.rooms.push_back(room_from_json(field, last_storey, last_face));
  for (const auto& field : root["faces"].items())
    building.faces.push_back(face_from_json(field, last_storey, last_room, last_vertex));
  for (const auto& field : root["openings"].items())
    building.openings.push_back(opening_from_json(field, last_room, last_face));
  for (const auto& field : root["walls"].items())
    building.walls.push_back({field["face_a"].whole(0, last_face), field["face_b"].whole(0, last_face),
                              field["thickness"].number(), field["area"].number()});
  return result;
}

}  // namespace atrium::io
