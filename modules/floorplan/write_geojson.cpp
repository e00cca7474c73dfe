#include "modules/floorplan/write_geojson.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "graph/api/write_output.hpp"
#include "modules/floorplan/caption.hpp"
#include "modules/types/crs_name.hpp"

namespace atrium::floorplan {
namespace {

using Json = nlohmann::ordered_json;

// To a whole 1/scale, so that the shortest decimal has no more digits.
double rounded(double value, double scale) { return std::round(value * scale) / scale; }
Json known(double value) { return value > 0 ? Json(rounded(value, 1e4)) : Json(); }

class Features {
 public:
  explicit Features(const FloorPlan& plan) : plan_(plan) {}

  void add(const Json& properties, const PlanPolygon& polygon) {
    Json rings = Json::array({ring(polygon.outline)});
    for (const auto& hole : polygon.holes) rings.push_back(ring(hole));
    add(properties, "Polygon", std::move(rings));
  }
  void add(const Json& properties, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    add(properties, "LineString", Json::array({place(from), place(to)}));
  }
  Json take() { return std::move(features_); }

 private:
  Json place(const Eigen::Vector2d& p) const {
    return Json::array({rounded(plan_.origin.x() + p.x(), 1e4), rounded(plan_.origin.y() + p.y(), 1e4)});
  }
  Json ring(const PlanRing& corners) const {
    Json result = Json::array();
    for (const auto& p : corners) result.push_back(place(p));
    result.push_back(place(corners.front()));
    return result;
  }
  void add(const Json& properties, const char* type, Json coordinates) {
    features_.push_back({{"type", "Feature"},
                         {"properties", properties},
                         {"geometry", {{"type", type}, {"coordinates", std::move(coordinates)}}}});
  }
  const FloorPlan& plan_;
  Json features_ = Json::array();
};

Json room_name(const PlanStorey& storey, std::int32_t room) {
  if (room < 0 || static_cast<std::size_t>(room) >= storey.rooms.size()) return {};
  return storey.rooms[static_cast<std::size_t>(room)].name;
}

void add_openings(Features& features, const PlanStorey& storey) {
  for (const auto& opening : storey.openings) {
    Json properties{{"class", opening.kind}, {"storey", storey.index}};
    if (opening.kind != "slab") {
      properties["rooms"] = Json::array({room_name(storey, opening.room_a), room_name(storey, opening.room_b)});
      properties["width_m"] = known(opening.width());
      properties["height_m"] = known(opening.height);
    }
    properties["sill_m"] = rounded(opening.sill, 1e4);
    properties["thickness_m"] = known(opening.thickness);
    if (opening.corrected) properties["corrected"] = true;
    if (opening.outline.empty())
      features.add(properties, opening.from, opening.to);
    else
      features.add(properties, PlanPolygon{opening.outline, {}});
  }
}

void add_storey(Features& features, const PlanStorey& storey, double origin_z) {
  const Json elevation = storey.floor_known ? Json(rounded(origin_z + storey.elevation, 1e4)) : Json();
  for (const auto& room : storey.rooms) {
    Json properties{{"class", "room"},
                    {"storey", storey.index},
                    {"name", room.name},
                    {"area_m2", rounded(room.polygon.area(), 1e4)},
                    {"height_m", known(room.height)},
                    {"elevation_m", elevation},
                    {"confidence", room.confidence >= 0 ? Json(rounded(room.confidence, 1e2)) : Json()}};
    if (room.corrected) properties["corrected"] = true;
    features.add(properties, room.polygon);
  }
  for (const auto& wall : storey.walls) {
    Json properties{{"class", "wall"},
                    {"storey", storey.index},
                    {"thickness_m", known(wall.thickness)},
                    {"length_m", rounded((wall.to - wall.from).norm(), 1e4)},
                    {"inferred", wall.inferred}};
    if (wall.corrected) properties["corrected"] = true;
    if (wall.outline.empty())
      features.add(properties, wall.from, wall.to);
    else
      features.add(properties, PlanPolygon{wall.outline, {}});
  }
  add_openings(features, storey);
  const auto add_all = [&](const char* name, const std::vector<PlanPolygon>& polygons) {
    for (const auto& polygon : polygons)
      features.add({{"class", name}, {"storey", storey.index}, {"area_m2", rounded(polygon.area(), 1e4)}}, polygon);
  };
  add_all("floor", storey.floors);
  add_all("ceiling", storey.ceilings);
}

}  // namespace

void WriteGeojson::run(const In& in, const Params& params, Context& context) {
  const std::string crs = crs_of(params.crs, in.scan.get(), in.plan->to_plan, "plan", context);
  Features features(*in.plan);
  for (const auto& storey : in.plan->storeys) add_storey(features, storey, origin_height(*in.plan));
  if (in.plan->storeys.empty()) context.warn("the plan is empty: " + params.path.path + " has no features");
  Json root{
      {"type", "FeatureCollection"},
      {"name", crs.empty() ? "floor plan (local coordinates, not WGS 84)" : "floor plan"},
      {"frame", crs.empty() ? "metres in the frame of the scan: x, y" : "metres in " + crs + ": easting, northing"}};
  const int code = epsg_code(crs);
  if (!crs.empty() && code == 0)
    context.warn(fmt::format(
        "GeoJSON names coordinate reference systems by their EPSG code: '{}' is in the member frame only", crs));
  if (code > 0)
    root["crs"] = {{"type", "name"}, {"properties", {{"name", "urn:ogc:def:crs:EPSG::" + std::to_string(code)}}}};
  root["features"] = features.take();
  write_output(context, params.path.path, root.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace atrium::floorplan
