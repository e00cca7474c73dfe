#pragma once
#include <map>
#include <string>
#include <vector>

#include "graph/api/context.hpp"
#include "graph/api/error.hpp"
#include "modules/layout/faces.hpp"
#include "modules/layout/heights.hpp"
#include "modules/layout/mesh.hpp"
#include "modules/layout/openings.hpp"
#include "modules/layout/partition.hpp"
#include "modules/layout/rooms.hpp"
#include "modules/layout/storeys.hpp"
#include "modules/metric/validity.hpp"

namespace atrium::test {

/// Keeps what a node warns of.
class Warnings : public ContextHost {
 public:
  void log(Level level, std::string_view text) override {
    if (level == Level::warning) texts.emplace_back(text);
  }
  bool mention(const std::string& words) const {
    for (const auto& text : texts)
      if (text.find(words) != std::string::npos) return true;
    return false;
  }
  std::vector<std::string> texts;
};

/// Everything that the nodes of a layout make of primitives.
struct Layout {
  Structure structure;
  CellComplex cells;
  Building building;
  layout::Mesh::Out meshes;
  std::shared_ptr<Warnings> warnings = std::make_shared<Warnings>();
};

inline Layout laid_out(const PlanePrimitives& planes) {
  Layout result;
  Context context(1, result.warnings);
  result.structure = layout::Storeys::run({input(planes)}, {}, context).structure;
  const auto structure = input(result.structure);
  const auto cells = input(layout::Partition::run({structure}, {}, context).cells);
  const auto rooms = input(layout::Rooms::run({cells}, {}, context).cells);
  result.cells = layout::Heights::run({rooms}, {}, context).cells;
  const auto closed = input(layout::Faces::run({input(result.cells), structure}, context).building);
  result.building = layout::Openings::run({closed, structure}, {}, context).building;
  result.meshes = layout::Mesh::run({input(result.building), {}}, {});
  return result;
}

inline std::map<std::string, double> validity(const Mesh& mesh) {
  Context context;
  std::map<std::string, double> result;
  for (const auto& m : metric::Validity::run({input(mesh)}, {}, context).metrics.values) result[m.name] = m.value;
  return result;
}

/// The surface of one room. (Rooms may touch: their shells together need not be manifold.)
inline Mesh shell_of(const Layout& layout, std::size_t room) {
  Mesh mesh = layout.meshes.shell;
  mesh.triangles.clear();
  for (std::size_t t = 0; t < layout.meshes.shell.triangles.size(); ++t) {
    const auto face = static_cast<std::size_t>(layout.meshes.shell.primitives[t]);
    if (layout.building.faces.at(face).room == static_cast<std::int32_t>(room))
      mesh.triangles.push_back(layout.meshes.shell.triangles[t]);
  }
  mesh.classes.clear();
  mesh.storeys.clear();
  mesh.primitives.clear();
  return mesh;
}

/// What is wrong with a building and its shell; "" if each room is closed and sound.
inline std::string flaw(const Layout& layout) {
  const Building& b = layout.building;
  for (std::size_t r = 0; r < b.rooms.size(); ++r) {
    const auto v = validity(shell_of(layout, r));
    for (const char* name : {"edges.boundary", "edges.misoriented", "duplicate_faces", "degenerate_faces",
                             "self_intersections.deep", "self_intersections.overlapping"})
      if (const double n = v.at(std::string("validity.") + name); n != 0)
        return std::string(name) + ": " + std::to_string(n);
  }
  for (std::size_t r = 0; r < b.rooms.size(); ++r) {
    const auto& room = b.rooms[r];
    if (room.faces.size() < 4) return "a room of " + std::to_string(room.faces.size()) + " faces";
    if (!(room.volume > 0) || !(room.area > 0) || room.outline.size() < 3) return "a room without space";
    for (const auto f : room.faces) {
      const auto& face = b.faces.at(static_cast<std::size_t>(f));
      if (face.room != static_cast<std::int32_t>(r)) return "a face of another room";
      if (face.observed < 0 || face.observed > 1) return "observed " + std::to_string(face.observed);
      for (const auto i : face.outline)
        if (const double d = std::abs(face.plane.signed_distance(b.vertices.at(i))); d > 2.1e-3)
          return "a corner " + std::to_string(1000 * d) + " mm off its face";
    }
  }
  return "";
}

inline std::string error_of(const PlanePrimitives& planes) {
  try {
    laid_out(planes);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

}  // namespace atrium::test
