#include "modules/scene/join.hpp"

#include <limits>

#include "modules/scene/mesh_parts.hpp"
#include "modules/types/palette.hpp"

namespace atrium::scene {
namespace {

void check_structure(const Mesh& structure) {
  const std::size_t count = structure.triangles.size();
  if (structure.classes.size() != count || structure.storeys.size() != count || structure.primitives.size() != count)
    throw Error(
        "the structure's triangles have no class, storey or primitive",
        "wire the structure of layout.mesh or scene.merge, or read a mesh that io.write_mesh wrote (.ply, .obj)");
  for (const auto& triangle : structure.triangles)
    for (const auto v : triangle)
      if (v >= structure.vertices.size()) throw Error("a triangle of the structure names a vertex that is not there");
}

/// Coloured by class: a vertex has the colour of the last triangle that has it.
void colour(Mesh& mesh) {
  mesh.colours.assign(mesh.vertices.size(), class_colour(SurfaceClass::object));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const auto v : mesh.triangles[t]) mesh.colours[v] = class_colour(mesh.classes[t]);
}

/// Without its ceilings, and the vertices that only they have.
Mesh open_above(const Mesh& mesh) {
  constexpr auto none = std::numeric_limits<std::uint32_t>::max();
  Mesh result;
  result.origin = mesh.origin;
  std::vector<std::uint32_t> place(mesh.vertices.size(), none);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.classes[t] == SurfaceClass::ceiling) continue;
    std::array<std::uint32_t, 3> triangle = mesh.triangles[t];
    for (auto& v : triangle) {
      if (place[v] == none) {
        place[v] = static_cast<std::uint32_t>(result.vertices.size());
        result.vertices.push_back(mesh.vertices[v]);
        if (!mesh.colours.empty()) result.colours.push_back(mesh.colours[v]);
      }
      v = place[v];
    }
    result.triangles.push_back(triangle);
    result.classes.push_back(mesh.classes[t]);
    result.storeys.push_back(mesh.storeys[t]);
    result.primitives.push_back(mesh.primitives[t]);
  }
  return result;
}

}  // namespace

Join::Out Join::run(const In& in) {
  check_structure(*in.structure);
  Mesh structure = *in.structure;
  const bool colours = !structure.colours.empty() || (in.objects && !in.objects->colours.empty());
  if (colours && structure.colours.empty()) colour(structure);
  Out out;
  if (in.objects)
    out.objects = transformed(objects_of(*in.objects, colours), in.transform ? inverse(*in.transform) : Transform{});
  out.scene_without_ceiling = joined(open_above(structure), out.objects);
  out.scene = joined(std::move(structure), out.objects);
  return out;
}

}  // namespace atrium::scene
