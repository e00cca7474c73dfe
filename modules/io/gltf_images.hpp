#pragma once
#include <Eigen/Core>
#include <array>
#include <map>
#include <memory>
#include <vector>

#include "modules/io/gltf_file.hpp"

namespace atrium::io {

/// An image as amounts of light are looked up in it: pixels of sRGB, row by row from the top.
struct GltfPicture {
  std::size_t width = 0, height = 0;
  std::vector<std::uint8_t> pixels;  ///< red, green, blue
  /// The light (linear, 0 … 1) at u, v: 0, 0 is the upper left corner, 1, 1 the lower right one; between the four
  /// pixels around. Beyond the picture, as `wrap` says along each axis.
  enum class Wrap : std::uint8_t { repeat, clamp, mirror };
  Eigen::Array3d light_at(double u, double v, const std::array<Wrap, 2>& wrap) const;
};

/// The images of a glTF file, each decoded when it is first asked for: PNG and JPEG.
class GltfImages {
 public:
  GltfImages(GltfFile& file, const Context& context) : file_(file), context_(context) {}
  /// The image of a texture reference, which has the key `index`; null if it is of another kind or cannot be decoded,
  /// with a warning. Throws Error if the references lead nowhere.
  const GltfPicture* of(const JsonField& reference);
  /// What the sampler of a texture reference says of the two axes.
  std::array<GltfPicture::Wrap, 2> wrap_of(const JsonField& reference) const;

 private:
  std::unique_ptr<const GltfPicture> decoded(const JsonField& image);

  GltfFile& file_;
  const Context& context_;
  std::map<std::uint64_t, std::unique_ptr<const GltfPicture>> pictures_;  // by image
};

/// Width and height that a PNG or JPEG says it has; zero for others. Nothing is decoded.
std::array<std::size_t, 2> image_size(const std::byte* data, std::size_t size);

}  // namespace atrium::io
