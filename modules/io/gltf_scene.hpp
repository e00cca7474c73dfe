#pragma once
#include <Eigen/Geometry>
#include <vector>

#include "modules/io/gltf_file.hpp"

namespace atrium::io {

/// A mesh where a node puts it.
struct GltfPlacement {
  JsonField node;
  JsonField mesh;
  Eigen::Affine3d to_scene = Eigen::Affine3d::Identity();
};

/// Every mesh of the scene that the file shows first, once for each node that has it, with the transforms of all nodes
/// above; without scenes, of all nodes; without nodes, every mesh as it is. Throws Error if a node's transform is not
/// finite, and if a node is reached twice: nodes form trees. Warns of what is passed over: other scenes, skins,
/// instances.
std::vector<GltfPlacement> gltf_placements(const GltfFile& file, const Context& context);

/// Throws Error if the file needs an extension that is not read, and says what to export instead.
void refuse_gltf_extensions(const GltfFile& file);

}  // namespace atrium::io
