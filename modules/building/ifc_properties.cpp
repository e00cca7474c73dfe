#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "modules/building/ifc_context.hpp"
#include "modules/geometry/polygon.hpp"

namespace atrium::building {
namespace {

using step::none, step::real, step::refs, step::text, step::typed, step::whole;

void define(IfcContext& ifc, StepRef object, const std::string& key, StepRef set) {
  add_relation(ifc, "IFCRELDEFINESBYPROPERTIES", key, refs({object}), set);
}

}  // namespace

void add_properties(IfcContext& ifc, StepRef object, const std::string& key, const std::string& set,
                    const IfcProperties& properties) {
  std::vector<StepRef> values;
  for (const auto& [name, value] : properties)
    values.push_back(ifc.file.shared("IFCPROPERTYSINGLEVALUE", {text(name), none(), value, none()}));
  const std::string own = key + " " + set;
  define(ifc, object, own,
         ifc.file.add("IFCPROPERTYSET", {ifc.id("set " + own), none(), text(set), none(), refs(values)}));
}

void add_quantities(IfcContext& ifc, StepRef object, const std::string& key, const std::string& set,
                    const std::vector<IfcQuantity>& quantities) {
  std::vector<StepRef> values;
  for (const auto& quantity : quantities) {
    const char* type = quantity.kind == "length" ? "IFCQUANTITYLENGTH"
                       : quantity.kind == "area" ? "IFCQUANTITYAREA"
                                                 : "IFCQUANTITYVOLUME";
    values.push_back(ifc.file.shared(type, {text(quantity.name), none(), none(), real(quantity.value), none()}));
  }
  const std::string own = key + " " + set;
  define(ifc, object, own,
         ifc.file.add("IFCELEMENTQUANTITY", {ifc.id("set " + own), none(), text(set), none(), none(), refs(values)}));
}

std::string corrections_text(const std::vector<std::string>& corrections) {
  std::string all;
  for (const auto& done : corrections) all += (all.empty() ? "" : "; ") + done;
  return all;
}

void add_evidence(IfcContext& ifc, StepRef object, const std::string& key, const std::vector<std::int32_t>& faces,
                  IfcProperties more) {
  double area = 0, seen = 0, squares = 0, confidence = 2;
  std::int64_t inferred = 0;
  std::string list;
  std::vector<std::string> corrections;
  for (const auto f : faces) {
    const BuildingFace& face = ifc.face(f);
    double own = 0;
    for (const auto& ring : ifc.rings(face)) own += vector_area(ring).norm() * (own > 0 ? -1 : 1);
    area += own;
    seen += own * face.observed;
    squares += own * face.observed * face.residual * face.residual;
    inferred += face.primitive < 0 ? 1 : 0;
    if (face.room >= 0) {
      const double room = ifc.building.rooms[static_cast<std::size_t>(face.room)].confidence;
      if (room >= 0) confidence = std::min(confidence, room);
    }
    list += (list.empty() ? "" : ", ") + std::to_string(f);
    for (const auto& done : face.corrections) corrections.push_back(fmt::format("face {} {}", f, done));
  }
  const auto count = static_cast<std::int64_t>(faces.size());
  IfcProperties properties{{"Coverage", typed("IFCREAL", real(area > 0 ? seen / area : 0))},
                           {"Residual", typed("IFCLENGTHMEASURE", real(seen > 0 ? std::sqrt(squares / seen) : 0))},
                           {"FacesSeen", typed("IFCINTEGER", whole(count - inferred))},
                           {"FacesInferred", typed("IFCINTEGER", whole(inferred))},
                           {"Inferred", typed("IFCBOOLEAN", step::truth(inferred == count))},
                           {"Faces", typed("IFCTEXT", text(list))}};
  if (confidence <= 1) properties.emplace_back("RoomConfidence", typed("IFCREAL", real(confidence)));
  if (!corrections.empty())
    properties.emplace_back("Corrections", typed("IFCTEXT", text(corrections_text(corrections))));
  properties.insert(properties.end(), more.begin(), more.end());
  add_properties(ifc, object, key, "Atrium_Evidence", properties);
}

}  // namespace atrium::building
