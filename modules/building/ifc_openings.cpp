#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "modules/building/ifc_context.hpp"
#include "modules/floorplan/regions.hpp"

namespace atrium::building {
namespace {

using step::choice, step::none, step::real, step::refs, step::text, step::truth, step::typed;

constexpr double beyond = 0.01;  // metres by which an opening reaches out of its wall on both sides
constexpr double leaf = 0.04;    // metres: thickness of a door's leaf
constexpr double pane = 0.03;    // metres: thickness of a window

/// The rectangle of an opening in a wall's plane.
struct Pane {
  StepRef place;  ///< its lower corner at the wall's beginning, x along the wall, z up
  double width = 0, height = 0, right = 0, left = 0;  ///< right and left: the sides of the wall across
  std::int32_t storey = 0;
};

PlanPolygon rectangle(double x0, double y0, double x1, double y1) {
  return {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, {}};
}

StepRef box(IfcContext& ifc, const Pane& p, double right, double left, std::string_view colour) {
  return ifc.shapes.shape({ifc.shapes.body(
      {ifc.shapes.extruded(rectangle(0, right, p.width, left), {}, Eigen::Vector3d::UnitZ(), p.height, colour)},
      "SweptSolid")});
}

Pane pane_in_wall(IfcContext& ifc, const Wall& wall, StepRef wall_place, const WallHole& hole) {
  Pane result;
  for (const auto& p : wall.footprint.outline) {
    result.right = std::min(result.right, wall.local(p).y());
    result.left = std::max(result.left, wall.local(p).y());
  }
  result.place = ifc.shapes.placement(wall_place, {{hole.from, 0, hole.low - wall.low()}});
  result.width = hole.to - hole.from;
  result.height = hole.high - hole.low;
  result.storey = wall.storey;
  return result;
}

/// The place of an opening that no wall was found for.
Pane pane_of(IfcContext& ifc, const BuildingOpening& opening) {
  Pane result;
  const BuildingFace* face = opening.face_a >= 0 ? &ifc.face(opening.face_a) : nullptr;
  Eigen::Vector2d normal = face != nullptr ? Eigen::Vector2d(face->plane.normal.head<2>()) : Eigen::Vector2d::UnitY();
  normal = normal.norm() > 1e-6 ? Eigen::Vector2d(normal.normalized()) : Eigen::Vector2d::UnitY();
  const Eigen::Vector2d along(normal.y(), -normal.x());
  Eigen::Vector2d low(1e300, 1e300), high(-1e300, -1e300);
  for (const auto& p : opening.outline_a) {
    low = low.cwiseMin(Eigen::Vector2d(along.dot(p.head<2>()), p.z()));
    high = high.cwiseMax(Eigen::Vector2d(along.dot(p.head<2>()), p.z()));
  }
  result.storey = face != nullptr ? face->storey : 0;
  const Eigen::Vector2d corner = along * low.x() + normal * normal.dot(opening.outline_a.front().head<2>());
  result.place = ifc.shapes.placement(ifc.storey_places[static_cast<std::size_t>(result.storey)],
                                      {{corner.x(), corner.y(), low.y() - ifc.elevation(result.storey)},
                                       Eigen::Vector3d::UnitZ(),
                                       {along.x(), along.y(), 0}});
  result.width = high.x() - low.x();
  result.height = high.y() - low.y();
  return result;
}

StepRef add_hole(IfcContext& ifc, const std::string& key, const std::string& name, StepRef host, StepRef place,
                 StepRef shape) {
  const StepRef ref = ifc.file.add(
      "IFCOPENINGELEMENT", {ifc.id(key), none(), text(name), none(), none(), place, shape, none(), choice("OPENING")});
  add_relation(ifc, "IFCRELVOIDSELEMENT", key, host, ref);
  return ref;
}

/// A door's leaf or a window's pane, in the middle of its opening.
StepRef middle_box(IfcContext& ifc, const BuildingOpening& opening, const Pane& p) {
  const double half = 0.5 * (opening.kind == "door" ? leaf : pane);
  return box(ifc, p, -half, half, opening.kind);
}

StepRef add_filling(IfcContext& ifc, const BuildingOpening& opening, std::int32_t index, const std::string& name,
                    const Pane& p, StepRef hole, StepRef shape) {
  const bool door = opening.kind == "door";
  const std::string key = fmt::format("{} {}", opening.kind, index);
  const StepRef place = ifc.shapes.placement(p.place, {});
  const StepRef ref =
      ifc.file.add(door ? "IFCDOOR" : "IFCWINDOW",
                   {ifc.id(key), none(), text(name), none(), none(), place, shape, none(), real(p.height),
                    real(p.width), choice(door ? "DOOR" : "WINDOW"), choice("NOTDEFINED"), none()});
  ifc.contained[static_cast<std::size_t>(p.storey)].push_back(ref);
  if (hole) add_relation(ifc, "IFCRELFILLSELEMENT", key, hole, ref);
  if (opening.room_a >= 0 && opening.room_b >= 0)
    add_properties(ifc, ref, key, door ? "Pset_DoorCommon" : "Pset_WindowCommon",
                   {{"IsExternal", typed("IFCBOOLEAN", truth(false))}});
  IfcProperties evidence{{"OtherSideSeen", typed("IFCBOOLEAN", truth(opening.outline_b.size() >= 3))},
                         {"WallThickness", typed("IFCLENGTHMEASURE", real(opening.thickness))}};
  for (const auto& [label, room] : {std::pair{"FromRoom", opening.room_a}, {"ToRoom", opening.room_b}})
    evidence.emplace_back(
        label,
        typed("IFCTEXT", text(room < 0 ? std::string() : ifc.building.rooms[static_cast<std::size_t>(room)].name)));
  if (!opening.corrections.empty())
    evidence.emplace_back("Corrections", typed("IFCTEXT", text(corrections_text(opening.corrections))));
  add_properties(ifc, ref, key, "Atrium_Evidence", evidence);
  add_quantities(ifc, ref, key, door ? "Qto_DoorBaseQuantities" : "Qto_WindowBaseQuantities",
                 {{"length", "Width", p.width}, {"length", "Height", p.height}, {"area", "Area", p.width * p.height}});
  return ref;
}

bool has_leaf(const BuildingOpening& opening) { return opening.kind == "door" || opening.kind == "window"; }

void add_wall_holes(IfcContext& ifc, const std::vector<std::string>& names, std::vector<bool>& done) {
  for (std::size_t w = 0; w < ifc.elements.walls.size(); ++w) {
    std::map<std::int32_t, int> parts;
    for (const auto& hole : ifc.elements.walls[w].holes) {
      const BuildingOpening& opening = ifc.building.openings[static_cast<std::size_t>(hole.opening)];
      const std::string& name = names[static_cast<std::size_t>(hole.opening)];
      const Pane p = pane_in_wall(ifc, ifc.elements.walls[w], ifc.wall_places[w], hole);
      const int part = parts[hole.opening]++;
      const std::string key = hole.main ? fmt::format("opening {}", hole.opening)
                                        : fmt::format("opening {} in wall {} part {}", hole.opening, w, part);
      const StepRef shape = box(ifc, p, p.right - beyond, p.left + beyond, "opening");
      const StepRef ref = add_hole(ifc, key, name, ifc.walls[w], p.place, shape);
      if (!hole.main) continue;
      const StepRef fills = has_leaf(opening)
                                ? add_filling(ifc, opening, hole.opening, name, p, ref, middle_box(ifc, opening, p))
                                : StepRef{};
      ifc.holes.push_back({hole.opening, ref, fills});
      done[static_cast<std::size_t>(hole.opening)] = true;
    }
  }
}

/// Of an opening in a slab: its outline from above, upright through the slab.
struct SlabPane {
  PlanPolygon outline;
  Pane pane;
  double foot = 0;  ///< height of the pane's place
};

SlabPane slab_pane(IfcContext& ifc, const Slab& slab, const BuildingOpening& opening) {
  SlabPane result;
  PlanRing ring;
  double low = 1e300, high = -1e300;
  Eigen::Vector2d least(1e300, 1e300), most(-1e300, -1e300);
  Eigen::Vector2d rise = slab.bottom.head<2>();
  rise = rise.norm() > 0 ? Eigen::Vector2d(rise.normalized()) : Eigen::Vector2d::UnitY();
  for (const auto& p : opening.outline_a) {
    ring.emplace_back(p.head<2>());
    low = std::min(low, slab.bottom_at(p.head<2>()));
    high = std::max(high, slab.bottom_at(p.head<2>()));
    const Eigen::Vector2d flat(rise.y() * p.x() - rise.x() * p.y(), rise.dot(p.head<2>()));
    least = least.cwiseMin(flat);
    most = most.cwiseMax(flat);
  }
  const floorplan::Region region = floorplan::united({ring});
  if (region.empty()) return result;
  result.outline = region.front();
  result.foot = low - beyond;
  result.pane.width = (most - least).x();
  result.pane.height = (most - least).y() * std::hypot(1, slab.bottom.head<2>().norm());
  result.pane.storey = slab.storey;
  result.pane.place = ifc.shapes.placement(ifc.storey_places[static_cast<std::size_t>(slab.storey)],
                                           {{0, 0, result.foot - ifc.elevation(slab.storey)}});
  return result;
}

/// A pane in the middle of a slab, along its slope.
StepRef slab_filling(IfcContext& ifc, const Slab& slab, const SlabPane& p, std::string_view colour) {
  const double half = 0.5 * pane * std::hypot(1, slab.bottom.x(), slab.bottom.y());
  std::vector<double> low, high;
  for (const auto& corner : p.outline.outline) {
    low.push_back(slab.bottom_at(corner) + 0.5 * slab.thickness - half - p.foot);
    high.push_back(low.back() + 2 * half);
  }
  return ifc.shapes.shape(
      {ifc.shapes.body({ifc.shapes.faceted(prism({p.outline.outline, {}}, low, high), colour)}, "Tessellation")});
}

void add_slab_holes(IfcContext& ifc, const std::vector<std::string>& names, std::vector<bool>& done) {
  for (std::size_t s = 0; s < ifc.elements.slabs.size(); ++s) {
    const Slab& slab = ifc.elements.slabs[s];
    for (const auto o : slab.openings) {
      const BuildingOpening& opening = ifc.building.openings[static_cast<std::size_t>(o)];
      const std::string& name = names[static_cast<std::size_t>(o)];
      const SlabPane p = slab_pane(ifc, slab, opening);
      if (p.outline.outline.empty()) continue;
      double high = -1e300;
      for (const auto& corner : p.outline.outline)
        high = std::max(high, slab.bottom_at(corner) + slab.thickness + beyond);
      const StepRef solid = ifc.shapes.extruded(p.outline, {}, Eigen::Vector3d::UnitZ(), high - p.foot, "opening");
      const StepRef hole = add_hole(ifc, fmt::format("opening {}", o), name, ifc.slabs[s], p.pane.place,
                                    ifc.shapes.shape({ifc.shapes.body({solid}, "SweptSolid")}));
      const StepRef fills =
          has_leaf(opening) ? add_filling(ifc, opening, o, name, p.pane, hole, slab_filling(ifc, slab, p, opening.kind))
                            : StepRef{};
      ifc.holes.push_back({o, hole, fills});
      done[static_cast<std::size_t>(o)] = true;
    }
  }
}

}  // namespace

std::vector<std::string> opening_names(const Building& building) {
  std::map<std::string, int> counts;
  std::vector<std::string> names;
  for (const auto& opening : building.openings) {
    const std::string kind = opening.kind == "slab" ? "slab opening" : opening.kind;
    names.push_back(fmt::format("{} {}", kind, ++counts[kind]));
  }
  return names;
}

void add_ifc_openings(IfcContext& ifc) {
  const std::vector<std::string> names = opening_names(ifc.building);
  std::vector<bool> done(names.size(), false);
  add_wall_holes(ifc, names, done);
  add_slab_holes(ifc, names, done);
  // Doors and windows that no wall was found for stand by themselves.
  for (std::size_t o = 0; o < names.size(); ++o) {
    const BuildingOpening& opening = ifc.building.openings[o];
    if (done[o] || !has_leaf(opening) || opening.outline_a.size() < 3 || ifc.storeys.empty()) continue;
    const auto index = static_cast<std::int32_t>(o);
    const Pane p = pane_of(ifc, opening);
    ifc.holes.push_back({index, {}, add_filling(ifc, opening, index, names[o], p, {}, middle_box(ifc, opening, p))});
  }
}

}  // namespace atrium::building
