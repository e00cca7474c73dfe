#pragma once
#include <vector>

#include "graph/api/context.hpp"
#include "modules/types/mesh.hpp"
#include "modules/types/textures.hpp"

namespace atrium::scene {

/// Where the images of a mesh's structural primitives lie (without pixels), by ascending primitive. Each covers its
/// triangles and is at most one pixel larger than their rectangle. Primitives without an area have none.
struct TextureSize {
  double pixel = 0.01;       ///< side, metres
  double max_side = 4096;    ///< of an image, pixels
  double max_pixels = 32e6;  ///< of all images
};
std::vector<FaceTexture> texture_frames(const Mesh& mesh, const TextureSize& size, const Context& context);

}  // namespace atrium::scene
