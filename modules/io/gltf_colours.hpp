#pragma once
#include <Eigen/Core>
#include <vector>

#include "modules/io/gltf_accessors.hpp"
#include "modules/io/gltf_images.hpp"
#include "modules/types/cloud.hpp"

namespace atrium::io {

/// An amount of light, 0 … 1, as a byte of sRGB (IEC 61966-2-1).
std::uint8_t srgb_byte(double linear);

/// Colours of the vertices of a glTF primitive: those of the vertices (COLOR_0) times its material's base colour and
/// the light of that colour's image there. `plain_material` false: a material's colour alone, without an image, says
/// nothing. Empty if it has none of them, or is plain white.
std::vector<Colour> gltf_colours(GltfFile& file, GltfImages& images, const JsonField& primitive, std::size_t vertices,
                                 bool plain_material);

}  // namespace atrium::io
