#pragma once
#include <cstdint>
#include <vector>

#include "modules/synth/scan.hpp"

namespace atrium::synth {

enum class Material : std::uint8_t { opaque, glass, mirror };

/// All that rays can meet: the scene's triangles, panes in its windows, and the outside, as parallel columns.
struct World {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::int32_t> labels;  ///< those of the cloud
  std::vector<Colour> colours;
  std::vector<Material> materials;
  std::vector<bool> two_sided;  ///< whether the back gives points, too
  std::vector<bool> silent;     ///< whether it hides what is behind, but gives no points

  /// A convex polygon, counter-clockwise seen from its front.
  void add(const std::vector<Eigen::Vector3d>& corners, std::int32_t label, const Colour& colour,
           Material material = Material::opaque, bool both_sides = false);
};

/// Labels of what is no part of the scene.
inline std::int32_t outside_label(const SimulatedScene& scene) {
  return SimulatedScene::object_id(scene.objects.size());
}
inline std::int32_t pane_label(const SimulatedScene& scene) { return outside_label(scene) - 1; }
inline std::int32_t person_label(const SimulatedScene& scene) { return outside_label(scene) - 2; }

/// The scene itself.
World world_of(const SimulatedScene& scene, bool ceilings);
/// A pane in the middle of each window's reveal.
void add_panes(World& world, const SimulatedScene& scene);
/// Ground, houses across the street on all sides, hedges, trees; drawn from `random`.
void add_outside(World& world, const SimulatedScene& scene, Random random);

}  // namespace atrium::synth
