#include "modules/synth/world.hpp"

namespace atrium::synth {
namespace {

Material material_of(const SimulatedScene& scene, std::int32_t surface) {
  if (surface >= 0) return Material::opaque;
  const auto& name = scene.objects[static_cast<std::size_t>(-2 - surface)];
  if (name == "mirror") return Material::mirror;
  return name == "glass" ? Material::glass : Material::opaque;
}

}  // namespace

void World::add(const std::vector<Eigen::Vector3d>& corners, std::int32_t label, const Colour& colour,
                Material material, bool both_sides) {
  const auto first = static_cast<std::uint32_t>(vertices.size());
  vertices.insert(vertices.end(), corners.begin(), corners.end());
  for (std::uint32_t i = 2; i < corners.size(); ++i) {
    triangles.push_back({first, first + i - 1, first + i});
    labels.push_back(label);
    colours.push_back(colour);
    materials.push_back(material);
    two_sided.push_back(both_sides);
    silent.push_back(false);
  }
}

World world_of(const SimulatedScene& scene, bool ceilings) {
  World world;
  world.vertices = scene.vertices;
  world.triangles = scene.triangles;
  world.labels = scene.surfaces;
  world.colours = scene.colours;
  for (const std::int32_t surface : scene.surfaces) {
    world.materials.push_back(material_of(scene, surface));
    world.two_sided.push_back(false);
    world.silent.push_back(!ceilings && surface >= 0 &&
                           scene.truth.faces[static_cast<std::size_t>(surface)].surface == SurfaceClass::ceiling);
  }
  return world;
}

void add_panes(World& world, const SimulatedScene& scene) {
  constexpr Colour glass{190, 210, 214};
  for (const auto& opening : scene.truth.openings) {
    if (opening.kind != "window") continue;
    const Eigen::Vector3d inwards =
        scene.truth.faces[static_cast<std::size_t>(opening.face_a)].plane.normal * (opening.thickness / 2);
    std::vector<Eigen::Vector3d> pane = opening.outline;
    for (auto& corner : pane) corner -= inwards;
    world.add(pane, pane_label(scene), glass, Material::glass, true);
  }
}

}  // namespace atrium::synth
