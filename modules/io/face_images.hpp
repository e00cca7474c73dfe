#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "graph/api/context.hpp"
#include "modules/types/mesh.hpp"
#include "modules/types/textures.hpp"

namespace atrium::io {

/// The images of a mesh's primitives, encoded, and where a vertex lies in them.
class FaceImages {
 public:
  FaceImages() = default;
  /// Encodes the images of those primitives that the mesh's structure has. Throws Error where an image is not sound
  /// (size, sides of no length, two of one primitive).
  FaceImages(const Textures& textures, const Mesh& mesh, const Context& context);

  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::size_t size() const { return images_.size(); }
  /// The image of triangles of this class and primitive, or none.
  std::size_t find(SurfaceClass surface, std::int32_t primitive) const;
  /// "wall_12": class and primitive.
  const std::string& name(std::size_t image) const { return images_[image].name; }
  const std::vector<std::uint8_t>& png(std::size_t image) const { return images_[image].png; }
  /// Shares of the image's width from the left and of its height from the top.
  Eigen::Vector2d place(std::size_t image, const Eigen::Vector3d& vertex) const;

 private:
  struct Image {
    std::int32_t primitive;
    std::string name;
    Eigen::Vector3d corner, across, down;  // in the mesh's coordinates; the sides divided by their squared lengths
    std::vector<std::uint8_t> png;
  };
  std::vector<Image> images_;  // by ascending primitive
};

}  // namespace atrium::io
