#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <vector>

namespace atrium {

/// One image on the plane of a primitive: it covers all faces of that primitive.
struct FaceTexture {
  static constexpr auto members() {
    return std::tuple{&FaceTexture::primitive, &FaceTexture::corner, &FaceTexture::across, &FaceTexture::down,
                      &FaceTexture::width,     &FaceTexture::height, &FaceTexture::pixels};
  }
  std::int32_t primitive = -1;                        ///< as in Mesh::primitives
  Eigen::Vector3d corner = Eigen::Vector3d::Zero();   ///< of the image's first pixel's outer corner, relative to origin
  Eigen::Vector3d across = Eigen::Vector3d::UnitX();  ///< from there along the whole first row, metres
  Eigen::Vector3d down = -Eigen::Vector3d::UnitZ();   ///< from there along the whole first column, metres; ⟂ across
  std::int32_t width = 0;                             ///< pixels
  std::int32_t height = 0;
  std::vector<std::uint8_t> pixels;  ///< red, green, blue; rows in the direction of `down`, without padding
};

/// Pictures of the surfaces of a structural mesh, in its frame. Seen from the side that the faces' normals point to,
/// the images are not mirrored.
struct Textures {
  static constexpr std::string_view port_type = "Textures";
  static constexpr auto members() { return std::tuple{&Textures::origin, &Textures::faces}; }
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  std::vector<FaceTexture> faces;  ///< at most one per primitive
};

}  // namespace atrium
