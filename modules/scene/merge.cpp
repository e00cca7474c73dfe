#include "modules/scene/merge.hpp"

#include "modules/scene/mesh_parts.hpp"
#include "modules/types/palette.hpp"

namespace atrium::scene {
namespace {

void append(Mesh& mesh, const PlaneMesh& polygon, bool colours) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), polygon.corners.begin(), polygon.corners.end());
  if (colours) mesh.colours.resize(mesh.vertices.size(), class_colour(polygon.surface));
  for (std::uint32_t i = 2; i < polygon.corners.size(); ++i) {
    mesh.triangles.push_back({first, first + i - 1, first + i});
    mesh.classes.push_back(polygon.surface);
    mesh.storeys.push_back(polygon.storey);
    mesh.primitives.push_back(polygon.primitive);
  }
}

Mesh structure_of(const PlaneMeshes& meshes, bool colours, bool ceilings) {
  Mesh result;
  result.origin = meshes.origin;
  for (const auto& polygon : meshes.meshes)
    if (ceilings || polygon.surface != SurfaceClass::ceiling) append(result, polygon, colours);
  return result;
}

}  // namespace

Merge::Out Merge::run(const In& in, const Params& params) {
  const Transform back = params.frame == Frame::input && in.transform ? inverse(*in.transform) : Transform{};
  const bool colours = params.class_colours || (in.objects && !in.objects->colours.empty());
  Out out;
  out.structure = transformed(structure_of(*in.meshes, colours, true), back);
  if (in.objects) out.objects = transformed(objects_of(*in.objects, colours), back);
  out.scene = joined(out.structure, out.objects);
  out.scene_without_ceiling = joined(transformed(structure_of(*in.meshes, colours, false), back), out.objects);
  return out;
}

}  // namespace atrium::scene
