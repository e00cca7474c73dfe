#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "modules/building/ifc_context.hpp"
#include "modules/geometry/polygon.hpp"
#include "modules/types/building_rules.hpp"

namespace atrium::building {
namespace {

using step::choice, step::none, step::real, step::refs, step::text, step::typed;

constexpr double one_height = 1e-6;   // metres
constexpr double same_volume = 1e-6;  // of the room's volume

/// The room's plan, if it is a prism: level floor and ceiling of one height each, all walls upright.
bool is_prism(const IfcContext& ifc, const BuildingRoom& room, double& low, double& high) {
  low = 1e300;
  high = -1e300;
  for (const auto f : room.faces)
    for (const auto v : ifc.face(f).outline) {
      low = std::min(low, ifc.building.vertices[v].z());
      high = std::max(high, ifc.building.vertices[v].z());
    }
  for (const auto f : room.faces)
    for (const auto v : ifc.face(f).outline) {
      const double z = ifc.building.vertices[v].z();
      if (std::min(std::abs(z - low), std::abs(z - high)) > one_height) return false;
    }
  const double volume = room.area * (high - low);
  return room.outline.size() >= 3 && std::abs(volume - room.volume) <= same_volume * std::abs(volume);
}

PlanPolygon plan_of(const BuildingRoom& room) {
  PlanPolygon polygon;
  for (const auto& p : room.outline) polygon.outline.emplace_back(p.head<2>());
  for (const auto& hole : room.holes) {
    polygon.holes.emplace_back();
    for (const auto& p : hole) polygon.holes.back().emplace_back(p.head<2>());
  }
  return polygon;
}

/// The faces turned round, so that they are seen from outside.
PolygonSurface surface_of(const IfcContext& ifc, const BuildingRoom& room, double elevation) {
  PolygonSurface surface;
  std::map<std::uint32_t, std::uint32_t> known;
  const auto turned = [&](const std::vector<std::uint32_t>& ring) {
    std::vector<std::uint32_t> result;
    for (auto v = ring.rbegin(); v != ring.rend(); ++v) {
      const auto [entry, fresh] = known.try_emplace(*v, static_cast<std::uint32_t>(surface.points.size()));
      if (fresh) surface.points.push_back(ifc.building.vertices[*v] - elevation * Eigen::Vector3d::UnitZ());
      result.push_back(entry->second);
    }
    return result;
  };
  for (const auto f : room.faces) {
    PolygonSurface::Face face{turned(ifc.face(f).outline), {}};
    for (const auto& hole : ifc.face(f).holes) face.holes.push_back(turned(hole));
    surface.faces.push_back(std::move(face));
  }
  return surface;
}

double perimeter_of(const BuildingRoom& room) {
  double sum = 0;
  const auto add = [&](const std::vector<Eigen::Vector3d>& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) sum += (ring[(i + 1) % ring.size()] - ring[i]).norm();
  };
  add(room.outline);
  for (const auto& hole : room.holes) add(hole);
  return sum;
}

void add_space(IfcContext& ifc, std::size_t index) {
  const BuildingRoom& room = ifc.building.rooms[index];
  const double elevation = ifc.elevation(room.storey);
  const std::string key = fmt::format("space {}", index);
  const StepRef place = ifc.shapes.placement(ifc.storey_places[static_cast<std::size_t>(room.storey)], {});
  double low = 0, high = 0;
  StepRef body;
  if (is_prism(ifc, room, low, high))
    body = ifc.shapes.body(
        {ifc.shapes.extruded(plan_of(room), {{0, 0, low - elevation}}, Eigen::Vector3d::UnitZ(), high - low, "space")},
        "SweptSolid");
  else if (!room.faces.empty())
    body = ifc.shapes.body({ifc.shapes.faceted(surface_of(ifc, room, elevation), "space")}, "Tessellation");
  const StepRef shape = body ? ifc.shapes.shape({body}) : StepRef{};
  const StepRef ref = ifc.file.add("IFCSPACE", {ifc.id(key), none(), text(room.name), none(), none(), place, shape,
                                                text(room.name), choice("ELEMENT"), choice("INTERNAL"), none()});
  ifc.spaces.push_back(ref);
  std::string doubts;
  for (const auto& doubt : room.doubts) doubts += (doubts.empty() ? "" : "; ") + doubt;
  IfcProperties judged;
  if (room.confidence >= 0 || !room.doubts.empty()) judged = {{"Doubts", typed("IFCTEXT", text(doubts))}};
  add_evidence(ifc, ref, key, room.faces, judged);
  add_quantities(ifc, ref, key, "Qto_SpaceBaseQuantities",
                 {{"length", "Height", room.height},
                  {"length", "GrossPerimeter", perimeter_of(room)},
                  {"area", "GrossFloorArea", room.area},
                  {"area", "NetFloorArea", room.area},
                  {"volume", "GrossVolume", room.volume},
                  {"volume", "NetVolume", room.volume}});
}

/// The connected parts of a mesh, by the lowest number of their triangles; per triangle.
std::vector<std::uint32_t> parts_of(const Mesh& mesh) {
  std::vector<std::uint32_t> root(mesh.vertices.size());
  for (std::uint32_t v = 0; v < root.size(); ++v) root[v] = v;
  const auto find = [&](std::uint32_t v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t v : {triangle[1], triangle[2]}) {
      const std::uint32_t a = find(triangle[0]), b = find(v);
      root[std::max(a, b)] = std::min(a, b);
    }
  std::vector<std::uint32_t> result;
  for (const auto& triangle : mesh.triangles) result.push_back(find(triangle[0]));
  return result;
}

std::size_t storey_at(const IfcContext& ifc, double z) {
  std::size_t best = 0;
  for (std::size_t s = 0; s < ifc.building.storeys.size(); ++s)
    if (ifc.building.storeys[s].elevation <= z) best = s;
  return best;
}

}  // namespace

void add_ifc_spaces(IfcContext& ifc) {
  for (std::size_t r = 0; r < ifc.building.rooms.size(); ++r) add_space(ifc, r);
  for (std::size_t s = 0; s < ifc.storeys.size(); ++s) {
    std::vector<StepRef> own;
    for (std::size_t r = 0; r < ifc.spaces.size(); ++r)
      if (ifc.building.rooms[r].storey == static_cast<std::int32_t>(s)) own.push_back(ifc.spaces[r]);
    if (!own.empty()) add_relation(ifc, "IFCRELAGGREGATES", fmt::format("storey {}", s), ifc.storeys[s], refs(own));
  }
}

void add_ifc_furniture(IfcContext& ifc, const Mesh& mesh) {
  if (ifc.storeys.empty()) return;
  const std::vector<std::uint32_t> part = parts_of(mesh);
  std::map<std::uint32_t, std::vector<std::size_t>> triangles;
  for (std::size_t t = 0; t < part.size(); ++t) triangles[part[t]].push_back(t);
  const Eigen::Vector3d shift = mesh.origin - ifc.building.origin;
  std::size_t number = 0;
  for (const auto& [first, own] : triangles) {
    std::map<std::uint32_t, std::uint32_t> known;
    std::vector<Eigen::Vector3d> points;
    std::vector<std::array<std::uint32_t, 3>> corners;
    double middle = 0;
    for (const auto t : own) {
      std::array<std::uint32_t, 3> triangle{};
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = mesh.triangles[t][k];
        const auto [entry, fresh] = known.try_emplace(v, static_cast<std::uint32_t>(points.size()));
        if (fresh) points.push_back(mesh.vertices[v] + shift);
        triangle[k] = entry->second;
      }
      corners.push_back(triangle);
    }
    for (const auto& p : points) middle += p.z() / static_cast<double>(points.size());
    const std::size_t storey = storey_at(ifc, middle);
    for (auto& p : points) p.z() -= ifc.building.storeys[storey].elevation;
    const StepRef solid = ifc.shapes.triangles(points, corners, false, "furniture");
    const std::string name = fmt::format("furniture {}", ++number);
    ifc.contained[storey].push_back(ifc.file.add(
        "IFCBUILDINGELEMENTPROXY",
        {ifc.id(name), none(), text(name), none(), none(), ifc.shapes.placement(ifc.storey_places[storey], {}),
         ifc.shapes.shape({ifc.shapes.body({solid}, "Tessellation")}), none(), choice("NOTDEFINED")}));
  }
}

}  // namespace atrium::building
