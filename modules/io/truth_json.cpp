#include "modules/io/truth_json.hpp"

#include <limits>
#include <nlohmann/json.hpp>

#include "modules/io/json_text.hpp"

namespace atrium::io {
namespace {

using Json = JsonField::Json;

Json mesh_to_json(const Mesh& mesh) {
  Json json{{"vertices", json_of(mesh.vertices)}, {"triangles", mesh.triangles}, {"faces", mesh.primitives}};
  if (!mesh.colours.empty()) json["colours"] = mesh.colours;
  return json;
}

Mesh mesh_from_json(const JsonField& field, const GroundTruth& truth) {
  Mesh mesh;
  mesh.origin = truth.origin;
  for (const auto& p : field["vertices"].items()) mesh.vertices.push_back(p.place());
  const auto last_vertex = static_cast<std::int32_t>(mesh.vertices.size()) - 1;
  const auto last_face = static_cast<std::int32_t>(truth.faces.size()) - 1;
  for (const auto& t : field["triangles"].items()) {
    const auto corners = t.items();
    if (corners.size() != 3) t.fail("is not a triangle");
    std::array<std::uint32_t, 3> triangle{};
    for (std::size_t k = 0; k < 3; ++k) triangle[k] = static_cast<std::uint32_t>(corners[k].whole(0, last_vertex));
    mesh.triangles.push_back(triangle);
  }
  for (const auto& f : field["faces"].items()) {
    mesh.primitives.push_back(f.whole(0, last_face));
    const auto& face = truth.faces[static_cast<std::size_t>(mesh.primitives.back())];
    mesh.classes.push_back(face.surface);
    mesh.storeys.push_back(face.storey);
  }
  if (mesh.primitives.size() != mesh.triangles.size()) field["faces"].fail("is not as long as the triangles");
  if (!field.has("colours")) return mesh;
  for (const auto& c : field["colours"].items()) {
    const auto parts = c.items();
    if (parts.size() != 3) c.fail("is not [red, green, blue]");
    Colour colour{};
    for (std::size_t k = 0; k < 3; ++k) colour[k] = static_cast<std::uint8_t>(parts[k].whole(0, 255));
    mesh.colours.push_back(colour);
  }
  if (mesh.colours.size() != mesh.vertices.size()) field["colours"].fail("is not as long as the vertices");
  return mesh;
}

Json opening_to_json(const TrueOpening& o) {
  return {{"kind", o.kind},     {"room_a", o.room_a},       {"room_b", o.room_b},           {"face_a", o.face_a},
          {"face_b", o.face_b}, {"thickness", o.thickness}, {"outline", json_of(o.outline)}};
}

TrueOpening true_opening_from_json(const JsonField& field, std::int32_t last_room, std::int32_t last_face) {
  TrueOpening opening;
  opening.kind = field["kind"].text();
  opening.room_a = field["room_a"].whole(-1, last_room);
  opening.room_b = field["room_b"].whole(-1, last_room);
  opening.face_a = field["face_a"].whole(-1, last_face);
  opening.face_b = field["face_b"].whole(-1, last_face);
  opening.thickness = field["thickness"].number();
  opening.outline = field["outline"].ring();
  return opening;
}

TrueFace face_from_json(const JsonField& field, std::int32_t last_room) {
  TrueFace face;
  face.surface = class_of(field["class"]);
  face.storey = field["storey"].whole(-1, 10000);
  face.room = field["room"].whole(-1, last_room);
  face.plane.normal = field["normal"].place();
  if (std::abs(face.plane.normal.norm() - 1) > 1e-6) field["normal"].fail("is not of unit length");
  face.plane.offset = field["offset"].number();
  face.outline = field["outline"].ring();
  if (field.has("holes"))
    for (const auto& hole : field["holes"].items()) face.holes.push_back(hole.ring());
  return face;
}

}  // namespace

std::string truth_to_json(const GroundTruth& truth) {
  Json root{{"atrium_truth", 1}, {"units", "m"}, {"origin", json_of(truth.origin)}};
  root["rooms"] = Json::array();
  for (const auto& room : truth.rooms)
    root["rooms"].push_back({{"name", room.name}, {"storey", room.storey}, {"outline", json_of(room.outline)}});
  root["faces"] = Json::array();
  for (const auto& face : truth.faces) {
    Json json{
        {"class", name_of(face.surface)},       {"storey", face.storey},       {"room", face.room},
        {"normal", json_of(face.plane.normal)}, {"offset", face.plane.offset}, {"outline", json_of(face.outline)}};
    if (!face.holes.empty()) {
      json["holes"] = Json::array();
      for (const auto& hole : face.holes) json["holes"].push_back(json_of(hole));
    }
    root["faces"].push_back(json);
  }
  root["openings"] = Json::array();
  for (const auto& opening : truth.openings) root["openings"].push_back(opening_to_json(opening));
  root["mesh"] = mesh_to_json(truth.mesh);
  return json_text(root, {"rooms", "faces", "openings"});
}

GroundTruth truth_from_json(const JsonField& root) {
  if (root["atrium_truth"].number() != 1) root["atrium_truth"].fail("is a version that is not known", "known: 1");
  if (root["units"].text() != "m") root["units"].fail("is not \"m\"");
  GroundTruth truth;
  truth.origin = root["origin"].place();
  for (const auto& field : root["rooms"].items())
    truth.rooms.push_back({field["name"].text(), field["storey"].whole(-1, 10000), field["outline"].ring()});
  const auto last_room = static_cast<std::int32_t>(truth.rooms.size()) - 1;
  for (const auto& field : root["faces"].items()) truth.faces.push_back(face_from_json(field, last_room));
  const auto last_face = static_cast<std::int32_t>(truth.faces.size()) - 1;
  for (const auto& field : root["openings"].items())
    truth.openings.push_back(true_opening_from_json(field, last_room, last_face));
  truth.mesh = root.has("mesh") ? mesh_from_json(root["mesh"], truth) : mesh_of(truth);
  return truth;
}

}  // namespace atrium::io
