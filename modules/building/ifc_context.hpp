#pragma once
#include <string>
#include <vector>

#include "modules/building/elements.hpp"
#include "modules/building/ifc_shapes.hpp"
#include "modules/types/mesh.hpp"

namespace atrium::building {

struct IfcOptions {
  std::string file_name = "building.ifc";
  std::string project = "Atrium";
  std::string crs;         ///< "EPSG:25832", or empty
  std::string id_space;    ///< what all GlobalIds are derived from; empty: the building's geometry
  bool boundaries = true;  ///< space boundaries too
};

/// The text of an IFC4 file. `furniture` may be null: a mesh in the building's frame whose connected parts become
/// proxies.
std::string ifc_text(const Building& building, const Elements& elements, const Mesh* furniture,
                     const IfcOptions& options);

/// An opening in the file.
struct IfcHole {
  std::int32_t opening = -1;
  StepRef ref, fills;  ///< IfcOpeningElement, and the door or window in it
};

/// What is written so far, for the parts of ifc_text.
struct IfcContext {
  const Building& building;
  const Elements& elements;
  const IfcOptions& options;
  StepFile file;
  IfcShapes shapes;
  std::string id_space;
  std::vector<StepRef> storeys, storey_places;
  std::vector<std::vector<StepRef>> contained;  ///< per storey
  std::vector<StepRef> spaces, walls, wall_places, slabs, columns;
  std::vector<IfcHole> holes;
  StepRef metre;

  IfcContext(const Building& b, const Elements& e, const IfcOptions& o);
  /// The GlobalId of what `key` names in this building.
  StepValue id(std::string_view key) const { return step::text(global_id(id_space + "\n" + std::string(key))); }
  double elevation(std::int32_t storey) const { return building.storeys[static_cast<std::size_t>(storey)].elevation; }
  const BuildingFace& face(std::int32_t f) const { return building.faces[static_cast<std::size_t>(f)]; }
  std::vector<std::vector<Eigen::Vector3d>> rings(const BuildingFace& face) const;
};

using IfcProperties = std::vector<std::pair<std::string, StepValue>>;  ///< name, typed value
/// A property set, or a set of quantities ("length", "area", "volume" with its value), of one object.
void add_properties(IfcContext& ifc, StepRef object, const std::string& key, const std::string& set,
                    const IfcProperties& properties);
struct IfcQuantity {
  std::string kind, name;
  double value;
};
void add_quantities(IfcContext& ifc, StepRef object, const std::string& key, const std::string& set,
                    const std::vector<IfcQuantity>& quantities);
/// What was done by hand, as one text.
std::string corrections_text(const std::vector<std::string>& corrections);
/// What of these faces was seen, and what was corrected: "Atrium_Evidence".
void add_evidence(IfcContext& ifc, StepRef object, const std::string& key, const std::vector<std::int32_t>& faces,
                  IfcProperties more = {});
void add_relation(IfcContext& ifc, std::string_view type, const std::string& key, const StepValue& first,
                  const StepValue& second);

/// The parts of a file, in their order.
void add_project(IfcContext& ifc);
void add_ifc_walls(IfcContext& ifc);
void add_ifc_slabs(IfcContext& ifc);
void add_ifc_columns(IfcContext& ifc);
void add_ifc_openings(IfcContext& ifc);
void add_ifc_spaces(IfcContext& ifc);
void add_ifc_boundaries(IfcContext& ifc);
void add_ifc_furniture(IfcContext& ifc, const Mesh& mesh);
void close_project(IfcContext& ifc);

/// Names by which people find elements in tables and programs: "wall 3", "door 1" …
std::string wall_name(std::size_t wall);
std::vector<std::string> opening_names(const Building& building);

}  // namespace atrium::building
