#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace tinygltf {
class Model;
}

namespace atrium::io {

/// Columns of a GLB file's binary part: one view of each kind, with an accessor per glTF primitive, and one per image.
/// The calls give the index of the accessor (of the view, for images).
class GlbBuffer {
 public:
  int indices(tinygltf::Model& model, const std::vector<std::uint32_t>& values);
  int positions(tinygltf::Model& model, const std::vector<Eigen::Vector3f>& values);
  int vectors(tinygltf::Model& model, const std::vector<Eigen::Vector3f>& values);
  int places(tinygltf::Model& model, const std::vector<Eigen::Vector2f>& values);
  int colours(tinygltf::Model& model, const std::vector<std::array<std::uint16_t, 4>>& values);
  int image(tinygltf::Model& model, const std::vector<std::uint8_t>& bytes);
  /// Puts all into the model's buffer. Throws Error beyond 2 GiB.
  void finish(tinygltf::Model& model);

 private:
  struct View {
    int index = -1;
    std::vector<std::uint8_t> bytes;
  };
  struct Kind {
    int target, component, type;
    std::size_t size;  // of an element
  };
  int add(tinygltf::Model& model, View& view, const Kind& kind, const void* data, std::size_t count);
  int make_view(tinygltf::Model& model, View& view);

  View indices_, positions_, vectors_, places_, colours_;
  std::vector<View> images_;
};

}  // namespace atrium::io
