#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "graph/api/error.hpp"
#include "graph/api/walk.hpp"
#include "modules/building/ifc_context.hpp"
#include "modules/types/crs_name.hpp"

namespace atrium::building {
namespace {

using step::choice, step::list, step::none, step::real, step::refs, step::text, step::typed, step::whole;

/// What all ids are derived from: the places of all corners, not names, confidence or what was seen.
std::string geometry_of(const Building& building) {
  std::string key = content_hash(building.origin) + content_hash(building.vertices);
  for (const auto& face : building.faces) key += content_hash(face.outline);
  return content_hash(key);
}

struct CrsParts {
  std::string datum, projection, zone;
};

/// What the number of a UTM zone says.
CrsParts parts_of(const std::string& name) {
  const int code = epsg_code(name);
  const auto utm = [&](int first, const char* datum, char half) {
    return CrsParts{datum, "UTM", fmt::format("{}{}", code - first, half)};
  };
  if (code >= 25828 && code <= 25838) return utm(25800, "ETRS89", 'N');
  if (code >= 32601 && code <= 32660) return utm(32600, "WGS84", 'N');
  if (code >= 32701 && code <= 32760) return utm(32700, "WGS84", 'S');
  return {};
}

StepValue known(const std::string& value) { return value.empty() ? none() : text(value); }

void add_map(IfcContext& ifc) {
  const CrsParts parts = parts_of(ifc.options.crs);
  const StepRef crs = ifc.file.add("IFCPROJECTEDCRS", {text(ifc.options.crs), none(), known(parts.datum), none(),
                                                       known(parts.projection), known(parts.zone), ifc.metre});
  const Eigen::Vector3d& origin = ifc.building.origin;
  ifc.file.add("IFCMAPCONVERSION", {ifc.shapes.model_context(), crs, real(origin.x()), real(origin.y()),
                                    real(origin.z()), real(1), real(0), real(1)});
}

}  // namespace

IfcContext::IfcContext(const Building& b, const Elements& e, const IfcOptions& o)
    : building(b), elements(e), options(o), shapes(file), id_space(o.id_space.empty() ? geometry_of(b) : o.id_space) {
  contained.resize(b.storeys.size());
}

std::vector<std::vector<Eigen::Vector3d>> IfcContext::rings(const BuildingFace& face) const {
  std::vector<std::vector<Eigen::Vector3d>> result;
  const auto add = [&](const std::vector<std::uint32_t>& ring) {
    result.emplace_back();
    for (const auto v : ring) result.back().push_back(building.vertices[v]);
  };
  add(face.outline);
  for (const auto& hole : face.holes) add(hole);
  return result;
}

void add_relation(IfcContext& ifc, std::string_view type, const std::string& key, const StepValue& first,
                  const StepValue& second) {
  ifc.file.add(type, {ifc.id(std::string(type) + " " + key), none(), none(), none(), first, second});
}

void add_project(IfcContext& ifc) {
  const auto unit = [&](std::string_view kind, std::string_view name) {
    return ifc.file.add("IFCSIUNIT", {step::derived(), choice(kind), none(), choice(name)});
  };
  ifc.metre = unit("LENGTHUNIT", "METRE");
  const StepRef units =
      ifc.file.add("IFCUNITASSIGNMENT", {refs({ifc.metre, unit("AREAUNIT", "SQUARE_METRE"),
                                               unit("VOLUMEUNIT", "CUBIC_METRE"), unit("PLANEANGLEUNIT", "RADIAN")})});
  const StepRef project =
      ifc.file.add("IFCPROJECT", {ifc.id("project"), none(), text(ifc.options.project), none(), none(), none(), none(),
                                  refs({ifc.shapes.model_context()}), units});
  if (!ifc.options.crs.empty()) add_map(ifc);
  // Without a map the places of the scan are kept by the site; with one they would count twice.
  IfcFrame place;
  if (ifc.options.crs.empty()) place.location = ifc.building.origin;
  const StepRef site_place = ifc.shapes.placement({}, place);
  const StepRef site =
      ifc.file.add("IFCSITE", {ifc.id("site"), none(), text("Site"), none(), none(), site_place, none(), none(),
                               choice("ELEMENT"), none(), none(), none(), none(), none()});
  const StepRef building_place = ifc.shapes.placement(site_place, {});
  const StepRef building =
      ifc.file.add("IFCBUILDING", {ifc.id("building"), none(), text("Building"), none(), none(), building_place, none(),
                                   none(), choice("ELEMENT"), none(), none(), none()});
  for (std::size_t s = 0; s < ifc.building.storeys.size(); ++s) {
    const double elevation = ifc.building.storeys[s].elevation;
    ifc.storey_places.push_back(ifc.shapes.placement(building_place, {{0, 0, elevation}}));
    ifc.storeys.push_back(ifc.file.add(
        "IFCBUILDINGSTOREY", {ifc.id(fmt::format("storey {}", s)), none(), text(fmt::format("Storey {}", s)), none(),
                              none(), ifc.storey_places.back(), none(), none(), choice("ELEMENT"), real(elevation)}));
  }
  add_relation(ifc, "IFCRELAGGREGATES", "project", project, refs({site}));
  add_relation(ifc, "IFCRELAGGREGATES", "site", site, refs({building}));
  if (!ifc.storeys.empty()) add_relation(ifc, "IFCRELAGGREGATES", "building", building, refs(ifc.storeys));
  if (ifc.building.confidence >= 0) {
    std::string doubts;
    for (const auto& doubt : ifc.building.doubts) doubts += (doubts.empty() ? "" : "; ") + doubt;
    add_properties(
        ifc, building, "building", "Atrium_Evidence",
        {{"Confidence", typed("IFCREAL", real(ifc.building.confidence))}, {"Doubts", typed("IFCTEXT", text(doubts))}});
  }
}

void close_project(IfcContext& ifc) {
  for (std::size_t s = 0; s < ifc.storeys.size(); ++s)
    if (!ifc.contained[s].empty())
      add_relation(ifc, "IFCRELCONTAINEDINSPATIALSTRUCTURE", fmt::format("storey {}", s), refs(ifc.contained[s]),
                   ifc.storeys[s]);
  const auto material = [&](const char* name, const std::vector<StepRef>& objects) {
    if (objects.empty()) return;
    const StepRef ref =
        ifc.file.add("IFCMATERIAL", {text(name), text("by class: the scan does not show what it is made of"), none()});
    add_relation(ifc, "IFCRELASSOCIATESMATERIAL", name, refs(objects), ref);
  };
  std::map<std::string, std::vector<StepRef>> by_kind;
  for (const auto& hole : ifc.holes)
    if (hole.fills) by_kind[ifc.building.openings[static_cast<std::size_t>(hole.opening)].kind].push_back(hole.fills);
  material("Wall", ifc.walls);
  material("Slab", ifc.slabs);
  material("Column", ifc.columns);
  material("Door", by_kind["door"]);
  material("Window", by_kind["window"]);
}

std::string ifc_text(const Building& building, const Elements& elements, const Mesh* furniture,
                     const IfcOptions& options) {
  IfcContext ifc(building, elements, options);
  add_project(ifc);
  add_ifc_walls(ifc);
  add_ifc_slabs(ifc);
  add_ifc_columns(ifc);
  add_ifc_openings(ifc);
  add_ifc_spaces(ifc);
  if (options.boundaries) add_ifc_boundaries(ifc);
  if (furniture != nullptr) add_ifc_furniture(ifc, *furniture);
  close_project(ifc);
  // The time is always the same: equal buildings give equal bytes.
  const std::string header = "FILE_DESCRIPTION(('ViewDefinition [DesignTransferView_V1.0]'),'2;1');\n" +
                             fmt::format("FILE_NAME({},'1970-01-01T00:00:00',(''),(''),'Atrium','Atrium','');\n",
                                         text(options.file_name).text) +
                             "FILE_SCHEMA(('IFC4'));\n";
  return ifc.file.contents(header);
}

}  // namespace atrium::building
