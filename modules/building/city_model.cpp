#include "modules/building/city_model.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "modules/building/room_solid.hpp"

namespace atrium::building {
namespace {

using Json = nlohmann::ordered_json;

constexpr double units = 1e4;  // per metre: whole tenths of a millimetre

double rounded(double value) { return std::round(value * units) / units; }

/// The corners of all surfaces, each once.
class CityVertices {
 public:
  std::size_t index(const Eigen::Vector3d& place) {
    const std::array<std::int64_t, 3> key{std::llround(place.x() * units), std::llround(place.y() * units),
                                          std::llround(place.z() * units)};
    const auto [it, is_new] = numbers_.emplace(key, list_.size());
    if (is_new) {
      list_.push_back(key);
      box_.extend(
          Eigen::Vector3d(static_cast<double>(key[0]), static_cast<double>(key[1]), static_cast<double>(key[2])) /
          units);
    }
    return it->second;
  }
  const Json& list() const { return list_; }
  Json extent(const Eigen::Vector3d& origin) const {
    Json result = Json::array();
    for (const Eigen::Vector3d& corner : {box_.min(), box_.max()})
      for (int i = 0; i < 3; ++i) result.push_back(rounded(origin[i] + corner[i]));
    return result;
  }

 private:
  std::map<std::array<std::int64_t, 3>, std::size_t> numbers_;
  Json list_ = Json::array();
  Eigen::AlignedBox3d box_;
};

const char* surface_type(SurfaceClass surface) {
  switch (surface) {
    case SurfaceClass::floor: return "FloorSurface";
    case SurfaceClass::ceiling: return "CeilingSurface";
    default: return "InteriorWallSurface";
  }
}

/// Passages and holes have nothing in them.
const char* opening_type(const std::string& kind) {
  return kind == "door" ? "Door" : kind == "window" ? "Window" : "ClosureSurface";
}

/// The semantic surfaces of a room: its faces, and its openings as their children.
class Surfaces {
 public:
  explicit Surfaces(const Building& building) : building_(building) {}

  std::size_t index(const SolidPiece& piece) {
    const auto [it, is_new] = numbers_.emplace(std::pair(piece.face, piece.opening), list_.size());
    if (!is_new) return it->second;
    const std::size_t index = it->second;
    list_.push_back(piece.opening < 0 ? face(piece.face) : opening(piece.opening));
    if (piece.opening < 0) return index;
    const std::size_t parent = this->index({piece.face, -1, {}});
    list_[index]["parent"] = parent;
    list_[parent]["children"].push_back(index);
    return index;
  }
  Json take() { return std::move(list_); }

 private:
  Json face(std::int32_t index) const {
    const BuildingFace& face = building_.faces[static_cast<std::size_t>(index)];
    return {{"type", surface_type(face.surface)},
            {"face", index},
            {"observed", rounded(face.observed)},
            {"inferred", face.primitive < 0}};
  }
  Json opening(std::int32_t index) const {
    const BuildingOpening& opening = building_.openings[static_cast<std::size_t>(index)];
    return {{"type", opening_type(opening.kind)}, {"opening", index}};
  }

  const Building& building_;
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> numbers_;
  Json list_ = Json::array();
};

class Model {
 public:
  Model(const Building& building, const CityOptions& options) : building_(building), options_(options) {}

  CityModel make() {
    Json objects = Json::object();
    objects["building"] = whole();
    for (std::size_t s = 0; s < building_.storeys.size(); ++s) objects[fmt::format("storey-{}", s)] = storey(s);
    for (std::size_t r = 0; r < building_.rooms.size(); ++r) objects[fmt::format("room-{}", r)] = room(r);
    Json root{{"type", "CityJSON"}, {"version", "2.0"}};
    const Eigen::Vector3d& origin = building_.origin;
    root["transform"] = {{"scale", {1 / units, 1 / units, 1 / units}},
                         {"translate", {origin.x(), origin.y(), origin.z()}}};
    root["metadata"] = {{"title", options_.title}};
    if (!vertices_.list().empty()) root["metadata"]["geographicalExtent"] = vertices_.extent(origin);
    if (options_.epsg > 0)
      root["metadata"]["referenceSystem"] = fmt::format("https://www.opengis.net/def/crs/EPSG/0/{}", options_.epsg);
    root["CityObjects"] = std::move(objects);
    root["vertices"] = vertices_.list();
    return {root.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n", std::move(warnings_)};
  }

 private:
  static void add_confidence(Json& attributes, double confidence, const std::vector<std::string>& doubts) {
    if (confidence < 0) return;
    attributes["confidence"] = rounded(confidence);
    attributes["doubts"] = doubts;
  }

  Json whole() const {
    Json children = Json::array();
    for (std::size_t s = 0; s < building_.storeys.size(); ++s) children.push_back(fmt::format("storey-{}", s));
    Json attributes = Json::object();
    add_confidence(attributes, building_.confidence, building_.doubts);
    return {{"type", "Building"}, {"attributes", attributes}, {"children", children}, {"geometry", Json::array()}};
  }

  Json storey(std::size_t index) const {
    Json children = Json::array();
    for (std::size_t r = 0; r < building_.rooms.size(); ++r)
      if (building_.rooms[r].storey == static_cast<std::int32_t>(index)) children.push_back(fmt::format("room-{}", r));
    const BuildingStorey& storey = building_.storeys[index];
    return {{"type", "BuildingStorey"},
            {"attributes",
             {{"sortKey", index},
              {"elevation_m", rounded(building_.origin.z() + storey.elevation)},
              {"height_m", rounded(storey.height)}}},
            {"parents", {"building"}},
            {"children", children},
            {"geometry", Json::array()}};
  }

  Json room(std::size_t index) {
    const BuildingRoom& room = building_.rooms[index];
    Json attributes{{"name", room.name},
                    {"area_m2", rounded(room.area)},
                    {"height_m", rounded(room.height)},
                    {"volume_m3", rounded(room.volume)}};
    add_confidence(attributes, room.confidence, room.doubts);
    return {{"type", "BuildingRoom"},
            {"attributes", attributes},
            {"parents", {fmt::format("storey-{}", room.storey)}},
            {"geometry", Json::array({geometry(room)})}};
  }

  Json geometry(const BuildingRoom& room) {
    RoomSolid solid = room_solid(building_, room, true);
    if (!solid.closed) {
      solid = room_solid(building_, room, false);
      warnings_.push_back(
          solid.closed
              ? fmt::format("the surface of '{}' does not close with its openings: it has none", room.name)
              : fmt::format("the surface of '{}' does not close: it is no solid, and has no openings", room.name));
    }
    Surfaces surfaces(building_);
    Json boundaries = Json::array(), values = Json::array();
    for (const auto& piece : solid.pieces) {
      Json rings = Json::array();
      for (const auto& ring : piece.rings) {
        Json corners = Json::array();
        for (const auto v : ring) corners.push_back(vertices_.index(solid.vertices[v]));
        rings.push_back(std::move(corners));
      }
      boundaries.push_back(std::move(rings));
      values.push_back(surfaces.index(piece));
    }
    if (solid.closed) {
      boundaries = Json::array({std::move(boundaries)});
      values = Json::array({std::move(values)});
    }
    return {{"type", solid.closed ? "Solid" : "MultiSurface"},
            {"lod", "3"},
            {"boundaries", std::move(boundaries)},
            {"semantics", {{"surfaces", surfaces.take()}, {"values", std::move(values)}}}};
  }

  const Building& building_;
  const CityOptions& options_;
  CityVertices vertices_;
  std::vector<std::string> warnings_;
};

}  // namespace

CityModel city_model(const Building& building, const CityOptions& options) { return Model(building, options).make(); }

}  // namespace atrium::building
