#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "modules/building/ifc_context.hpp"
#include "modules/building/profile.hpp"
#include "modules/floorplan/regions.hpp"

namespace atrium::building {
namespace {

using step::choice, step::none, step::refs, step::text, step::truth, step::typed;

constexpr double square_end = 2e-4;  // metres: corners this near to a rectangle's are its own

PlanPolygon in_wall(const Wall& wall, const PlanPolygon& polygon) {
  PlanPolygon result;
  for (const auto& p : polygon.outline) result.outline.push_back(wall.local(p));
  for (const auto& hole : polygon.holes) {
    result.holes.emplace_back();
    for (const auto& p : hole) result.holes.back().push_back(wall.local(p));
  }
  return result;
}

struct Across {
  double right = 1e300, left = -1e300;
};

Across across(const PlanPolygon& local) {
  Across result;
  for (const auto& p : local.outline) {
    result.right = std::min(result.right, p.y());
    result.left = std::max(result.left, p.y());
  }
  return result;
}

bool is_rectangle(const PlanPolygon& local, double length) {
  if (local.outline.size() != 4 || !local.holes.empty()) return false;
  const Across t = across(local);
  return std::all_of(local.outline.begin(), local.outline.end(), [&](const Eigen::Vector2d& p) {
    return std::min(std::abs(p.x()), std::abs(p.x() - length)) < square_end &&
           std::min(std::abs(p.y() - t.right), std::abs(p.y() - t.left)) < square_end;
  });
}

/// One prism for each part of the profile.
std::vector<StepRef> bands(IfcContext& ifc, const Wall& wall, std::string_view colour) {
  std::vector<StepRef> items;
  const double foot = wall.low();
  for (const auto& part : wall.profile)
    for (const auto& polygon : footprint_part(wall, part)) {
      const PlanPolygon local = in_wall(wall, polygon);
      std::vector<double> low, high;
      const auto add = [&](const PlanRing& ring) {
        for (const auto& p : ring) {
          const double share = std::clamp((p.x() - part.from) / (part.to - part.from), 0.0, 1.0);
          low.push_back(part.low_from + share * (part.low_to - part.low_from) - foot);
          high.push_back(part.high_from + share * (part.high_to - part.high_from) - foot);
        }
      };
      add(local.outline);
      for (const auto& hole : local.holes) add(hole);
      items.push_back(ifc.shapes.faceted(prism(local, low, high), colour));
    }
  return items;
}

StepRef wall_body(IfcContext& ifc, const Wall& wall) {
  const std::string_view colour = wall.assumed ? "wall of assumed thickness" : "wall";
  const PlanPolygon local = in_wall(wall, wall.footprint);
  if (wall.level())
    return ifc.shapes.body({ifc.shapes.extruded(local, {}, Eigen::Vector3d::UnitZ(), wall.high() - wall.low(), colour)},
                           "SweptSolid");
  if (is_rectangle(local, wall.length)) {
    std::vector<ProfilePart> profile = wall.profile;
    for (auto& part : profile)
      for (double* z : {&part.low_from, &part.low_to, &part.high_from, &part.high_to}) *z -= wall.low();
    const Across t = across(local);
    const IfcFrame side{{0, t.left, 0}, -Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitX()};
    return ifc.shapes.body(
        {ifc.shapes.extruded({outline_of(profile), {}}, side, Eigen::Vector3d::UnitZ(), t.left - t.right, colour)},
        "SweptSolid");
  }
  return ifc.shapes.body(bands(ifc, wall, colour), "Tessellation");
}

std::string room_name(const IfcContext& ifc, std::int32_t room) {
  return room < 0 ? std::string() : ifc.building.rooms[static_cast<std::size_t>(room)].name;
}

std::string key_of(const char* kind, const std::vector<std::int32_t>& faces, std::map<std::string, int>& known) {
  std::string key = kind;
  for (const auto f : faces) key += fmt::format(" {}", f);
  const int number = known[key]++;
  return number == 0 ? key : fmt::format("{} part {}", key, number);
}

void add_wall(IfcContext& ifc, const Wall& wall, const std::string& name, const std::string& key) {
  const StepRef place = ifc.shapes.placement(ifc.storey_places[static_cast<std::size_t>(wall.storey)],
                                             {{wall.start.x(), wall.start.y(), wall.low() - ifc.elevation(wall.storey)},
                                              Eigen::Vector3d::UnitZ(),
                                              {wall.along.x(), wall.along.y(), 0}});
  const StepRef shape = ifc.shapes.shape({ifc.shapes.axis_line({0, 0}, {wall.length, 0}), wall_body(ifc, wall)});
  const StepRef ref = ifc.file.add("IFCWALL", {ifc.id(key), none(), text(name), none(), none(), place, shape, none(),
                                               choice(wall.level() ? "SOLIDWALL" : "NOTDEFINED")});
  ifc.walls.push_back(ref);
  ifc.wall_places.push_back(place);
  ifc.contained[static_cast<std::size_t>(wall.storey)].push_back(ref);
  IfcProperties common;
  if (wall.left_room >= 0 && wall.right_room >= 0) common.emplace_back("IsExternal", typed("IFCBOOLEAN", truth(false)));
  if (!common.empty()) add_properties(ifc, ref, key, "Pset_WallCommon", common);
  add_evidence(ifc, ref, key, wall.faces,
               {{"ThicknessAssumed", typed("IFCBOOLEAN", truth(wall.assumed))},
                {"LeftRoom", typed("IFCTEXT", text(room_name(ifc, wall.left_room)))},
                {"RightRoom", typed("IFCTEXT", text(room_name(ifc, wall.right_room)))}});
  add_quantities(ifc, ref, key, "Qto_WallBaseQuantities",
                 {{"length", "Length", wall.length},
                  {"length", "Width", wall.thickness},
                  {"length", "Height", wall.high() - wall.low()},
                  {"area", "GrossFootprintArea", wall.footprint.area()},
                  {"area", "GrossSideArea", wall.gross_area()},
                  {"area", "NetSideArea", wall.net_area()},
                  {"volume", "GrossVolume", wall.gross_volume()},
                  {"volume", "NetVolume", wall.net_volume()}});
}

/// A vertical prism of the footprint between the slab's planes, its profile in the lower one.
StepRef slab_body(IfcContext& ifc, const Slab& slab, double elevation) {
  const std::string_view colour = slab.kind == SlabKind::roof ? "roof" : "slab";
  if (slab.level()) {
    const IfcFrame frame{{0, 0, slab.bottom.z() - elevation}};
    return ifc.shapes.extruded(slab.footprint, frame, Eigen::Vector3d::UnitZ(), slab.thickness, colour);
  }
  const Eigen::Vector3d normal = Eigen::Vector3d(-slab.bottom.x(), -slab.bottom.y(), 1).normalized();
  const Eigen::Vector3d level = Eigen::Vector3d(-normal.y(), normal.x(), 0).normalized();
  const Eigen::Vector3d rise = normal.cross(level);
  const Eigen::Vector2d middle = slab.footprint.outline.front();
  const Eigen::Vector3d origin(middle.x(), middle.y(), slab.bottom_at(middle));
  const auto flat = [&](const PlanRing& ring) {
    PlanRing result;
    for (const auto& p : ring) {
      const Eigen::Vector3d d = Eigen::Vector3d(p.x(), p.y(), slab.bottom_at(p)) - origin;
      result.emplace_back(level.dot(d), rise.dot(d));
    }
    return result;
  };
  PlanPolygon polygon{flat(slab.footprint.outline), {}};
  for (const auto& hole : slab.footprint.holes) polygon.holes.push_back(flat(hole));
  const IfcFrame frame{{origin.x(), origin.y(), origin.z() - elevation}, normal, level};
  // Upright in the frame's own axes.
  return ifc.shapes.extruded(polygon, frame, {level.z(), rise.z(), normal.z()}, slab.thickness, colour);
}

double hole_area(const IfcContext& ifc, const Slab& slab) {
  double sum = 0;
  for (const auto o : slab.openings) {
    PlanRing ring;
    for (const auto& p : ifc.building.openings[static_cast<std::size_t>(o)].outline_a) ring.emplace_back(p.head<2>());
    sum += floorplan::area(floorplan::common(floorplan::united({ring}), {slab.footprint}));
  }
  return sum;
}

void add_slab(IfcContext& ifc, const Slab& slab, const std::string& name, const std::string& key) {
  const double elevation = ifc.elevation(slab.storey);
  const StepRef place = ifc.shapes.placement(ifc.storey_places[static_cast<std::size_t>(slab.storey)], {});
  const StepRef shape = ifc.shapes.shape({ifc.shapes.body({slab_body(ifc, slab, elevation)}, "SweptSolid")});
  const char* kind = slab.kind == SlabKind::roof ? "ROOF" : slab.kind == SlabKind::ceiling ? "NOTDEFINED" : "FLOOR";
  const StepRef ref =
      ifc.file.add("IFCSLAB", {ifc.id(key), none(), text(name), none(), none(), place, shape, none(), choice(kind)});
  ifc.slabs.push_back(ref);
  ifc.contained[static_cast<std::size_t>(slab.storey)].push_back(ref);
  const double slope = std::hypot(slab.bottom.x(), slab.bottom.y());
  if (slope > 0)
    add_properties(ifc, ref, key, "Pset_SlabCommon",
                   {{"PitchAngle", typed("IFCPLANEANGLEMEASURE", step::real(std::atan(slope)))}});
  add_evidence(ifc, ref, key, slab.faces, {{"ThicknessAssumed", typed("IFCBOOLEAN", truth(slab.assumed))}});
  const double stretch = std::hypot(1, slope), gross = slab.footprint.area(), net = gross - hole_area(ifc, slab);
  add_quantities(ifc, ref, key, "Qto_SlabBaseQuantities",
                 {{"length", "Width", slab.thickness / stretch},
                  {"area", "GrossArea", gross * stretch},
                  {"area", "NetArea", net * stretch},
                  {"volume", "GrossVolume", gross * slab.thickness},
                  {"volume", "NetVolume", net * slab.thickness}});
}

}  // namespace

std::string wall_name(std::size_t wall) { return fmt::format("wall {}", wall + 1); }

void add_ifc_walls(IfcContext& ifc) {
  std::map<std::string, int> known;
  for (std::size_t w = 0; w < ifc.elements.walls.size(); ++w) {
    const Wall& wall = ifc.elements.walls[w];
    add_wall(ifc, wall, wall_name(w), key_of("wall", wall.faces, known));
  }
}

void add_ifc_slabs(IfcContext& ifc) {
  std::map<std::string, int> known;
  std::size_t number = 0;
  for (const auto& slab : ifc.elements.slabs) {
    const char* kind = slab.kind == SlabKind::roof ? "roof" : slab.kind == SlabKind::ceiling ? "ceiling" : "floor";
    add_slab(ifc, slab, fmt::format("{} {}", kind, ++number), key_of("slab", slab.faces, known));
  }
}

void add_ifc_columns(IfcContext& ifc) {
  std::map<std::string, int> known;
  std::size_t number = 0;
  for (const auto& column : ifc.elements.columns) {
    const std::string key = key_of("column", column.faces, known);
    const StepRef place = ifc.shapes.placement(ifc.storey_places[static_cast<std::size_t>(column.storey)],
                                               {{0, 0, column.low - ifc.elevation(column.storey)}});
    const double height = column.high - column.low;
    const PlanPolygon outline{column.outline, {}};
    const StepRef solid = ifc.shapes.extruded(outline, {}, Eigen::Vector3d::UnitZ(), height, "column");
    const StepRef ref = ifc.file.add(
        "IFCCOLUMN", {ifc.id(key), none(), text(fmt::format("column {}", ++number)), none(), none(), place,
                      ifc.shapes.shape({ifc.shapes.body({solid}, "SweptSolid")}), none(), choice("COLUMN")});
    ifc.columns.push_back(ref);
    ifc.contained[static_cast<std::size_t>(column.storey)].push_back(ref);
    add_evidence(ifc, ref, key, column.faces);
    add_quantities(ifc, ref, key, "Qto_ColumnBaseQuantities",
                   {{"length", "Length", height},
                    {"area", "CrossSectionArea", outline.area()},
                    {"volume", "GrossVolume", outline.area() * height},
                    {"volume", "NetVolume", outline.area() * height}});
  }
}

}  // namespace atrium::building
