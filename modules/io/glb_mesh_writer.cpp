#include <fmt/format.h>
#include <tiny_gltf.h>

#include <Eigen/Geometry>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "graph/api/error.hpp"
#include "modules/io/glb_buffer.hpp"
#include "modules/io/glb_groups.hpp"
#include "modules/io/mesh_writers.hpp"
#include "modules/types/palette.hpp"

namespace atrium::io {
namespace {

using Object = tinygltf::Value::Object;
using tinygltf::Value;

/// Builds the model: nodes and meshes of a class and storey, primitives of a plane, and their materials.
class GlbModel {
 public:
  GlbModel(const Mesh& mesh, const FaceImages& images, const Eigen::Vector3d& up, const std::string& crs)
      : mesh_(mesh),
        images_(images),
        offset_(glb_offset(mesh)),
        turn_(glb_rotation(up)),
        corners_(mesh.vertices.size()) {
    describe(crs);
    image_materials_.assign(images.size(), -1);
    for (const auto& group : glb_groups(mesh)) add(group);
    buffer_.finish(model_);
  }
  const tinygltf::Model& model() const { return model_; }

 private:
  void describe(const std::string& crs) {
    model_.asset.version = "2.0";
    model_.asset.generator = "Atrium";
    Object extras;
    extras["origin"] = Value(Value::Array{Value(offset_.x()), Value(offset_.y()), Value(offset_.z())});
    extras["unit"] = Value(std::string("metre"));
    extras["frame"] = Value(frame_text());
    extras["to_true"] = Value(to_true());
    if (!crs.empty()) extras["crs"] = Value(crs);
    model_.asset.extras = Value(extras);
    model_.scenes.emplace_back();
    model_.scenes[0].name = "Atrium";
    model_.scenes[0].extras = Value(extras);
    model_.defaultScene = 0;
  }

  /// How true coordinates follow from those of the file.
  std::string frame_text() const {
    std::string text;
    for (int i = 0; i < 3; ++i) {
      text += fmt::format("{}{} = origin[{}]", i == 0 ? "" : ", ", "xyz"[i], i);
      for (int k = 0; k < 3; ++k) {
        const double factor = turn_(k, i);  // of the inverse
        if (factor == 0) continue;
        const double size = std::abs(factor);
        text += fmt::format(" {} {}{}", factor < 0 ? '-' : '+', size == 1 ? "" : fmt::format("{} ", size), "XYZ"[k]);
      }
    }
    return text;
  }

  /// The same as a matrix, column after column, as a node's.
  Value::Array to_true() const {
    Value::Array matrix;
    for (int c = 0; c < 4; ++c)
      for (int r = 0; r < 4; ++r)
        matrix.emplace_back(c == 3 ? (r == 3 ? 1.0 : offset_[r]) : r == 3 ? 0.0 : turn_(c, r));  // turn_: inverse
    return matrix;
  }

  void add(const GlbGroup& group) {
    tinygltf::Mesh& mesh = mesh_of(group);
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    const auto used = corners_.gather(mesh_, group.triangles);
    primitive.indices = buffer_.indices(model_, used.corners);
    primitive.attributes["POSITION"] = add_positions(used.vertices);
    if (const auto normal = common_normal(mesh_, group))
      primitive.attributes["NORMAL"] =
          buffer_.vectors(model_, std::vector<Eigen::Vector3f>(used.vertices.size(), (turn_ * *normal).cast<float>()));
    const std::size_t image = images_.find(group.surface, group.primitive);
    const bool coloured = image == FaceImages::none && has_own_colours(used.vertices, group);
    if (image != FaceImages::none) primitive.attributes["TEXCOORD_0"] = add_places(used.vertices, image);
    if (coloured) primitive.attributes["COLOR_0"] = add_colours(used.vertices);
    primitive.material = image != FaceImages::none ? image_material(group, image) : class_material(group, coloured);
    primitive.extras = Value(extras_of(group, true));
    mesh.primitives.push_back(std::move(primitive));
  }

  tinygltf::Mesh& mesh_of(const GlbGroup& group) {
    std::string name = mesh_.classes.empty() ? "mesh" : std::string(name_of(group.surface));
    if (group.storey >= 0) name += fmt::format(", storey {}", group.storey);
    if (model_.meshes.empty() || model_.meshes.back().name != name) {
      tinygltf::Node node;
      node.name = name;
      node.mesh = static_cast<int>(model_.meshes.size());
      node.extras = Value(extras_of(group, false));
      model_.scenes[0].nodes.push_back(static_cast<int>(model_.nodes.size()));
      model_.nodes.push_back(node);
      model_.meshes.emplace_back();
      model_.meshes.back().name = name;
    }
    return model_.meshes.back();
  }

  Object extras_of(const GlbGroup& group, bool primitive) const {
    Object extras;
    extras["class"] = Value(std::string(name_of(group.surface)));
    if (group.storey >= 0) extras["storey"] = Value(group.storey);
    if (primitive && group.primitive >= 0) extras["primitive"] = Value(group.primitive);
    return extras;
  }

  int add_positions(const std::vector<std::uint32_t>& vertices) {
    const Eigen::Vector3d shift = mesh_.origin - offset_;
    std::vector<Eigen::Vector3f> places;
    places.reserve(vertices.size());
    for (const auto v : vertices) places.emplace_back((turn_ * (mesh_.vertices[v] + shift)).cast<float>());
    return buffer_.positions(model_, places);
  }
  int add_places(const std::vector<std::uint32_t>& vertices, std::size_t image) {
    std::vector<Eigen::Vector2f> places;
    places.reserve(vertices.size());
    for (const auto v : vertices) places.emplace_back(images_.place(image, mesh_.vertices[v]).cast<float>());
    return buffer_.places(model_, places);
  }
  int add_colours(const std::vector<std::uint32_t>& vertices) {
    std::vector<std::array<std::uint16_t, 4>> colours;
    colours.reserve(vertices.size());
    for (const auto v : vertices) colours.push_back(linear16(mesh_.colours[v]));
    return buffer_.colours(model_, colours);
  }
  /// Colours that say no more than the class are left to the material.
  bool has_own_colours(const std::vector<std::uint32_t>& vertices, const GlbGroup& group) const {
    if (mesh_.colours.empty()) return false;
    if (mesh_.classes.empty()) return true;
    const Colour usual = class_colour(group.surface);
    return std::any_of(vertices.begin(), vertices.end(), [&](auto v) { return mesh_.colours[v] != usual; });
  }

  tinygltf::Material material_of(const std::string& name, const GlbGroup& group) const {
    tinygltf::Material material;
    material.name = name;
    material.pbrMetallicRoughness.metallicFactor = 0;
    material.pbrMetallicRoughness.roughnessFactor = 1;
    material.doubleSided = group.surface == SurfaceClass::object;
    return material;
  }
  int class_material(const GlbGroup& group, bool coloured) {
    int& index = class_materials_[static_cast<std::size_t>(group.surface)][coloured ? 1 : 0];
    if (index >= 0) return index;
    std::string name(name_of(group.surface));
    auto material = material_of(coloured ? name + ", coloured" : name, group);
    if (!coloured) {
      const auto [red, green, blue] = linear(class_colour(group.surface));
      material.pbrMetallicRoughness.baseColorFactor = {red, green, blue, 1};
    }
    model_.materials.push_back(material);
    return index = static_cast<int>(model_.materials.size()) - 1;
  }
  /// A photograph carries its light with it: unlit.
  int image_material(const GlbGroup& group, std::size_t image) {
    if (image_materials_[image] >= 0) return image_materials_[image];
    const std::string& name = images_.name(image);
    if (model_.samplers.empty()) {
      tinygltf::Sampler sampler;
      sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
      sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
      sampler.wrapS = sampler.wrapT = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
      model_.samplers.push_back(sampler);
      model_.extensionsUsed.emplace_back("KHR_materials_unlit");
    }
    tinygltf::Image file;
    file.name = name;
    file.mimeType = "image/png";
    file.bufferView = buffer_.image(model_, images_.png(image));
    model_.images.push_back(file);
    tinygltf::Texture texture;
    texture.sampler = 0;
    texture.source = static_cast<int>(model_.images.size()) - 1;
    model_.textures.push_back(texture);
    auto material = material_of(name, group);
    material.pbrMetallicRoughness.baseColorTexture.index = static_cast<int>(model_.textures.size()) - 1;
    material.extensions["KHR_materials_unlit"] = Value(Object{});
    model_.materials.push_back(material);
    return image_materials_[image] = static_cast<int>(model_.materials.size()) - 1;
  }

  const Mesh& mesh_;
  const FaceImages& images_;
  Eigen::Vector3d offset_;
  Eigen::Matrix3d turn_;  ///< from the mesh's frame to glTF's
  GroupCorners corners_;
  GlbBuffer buffer_;
  tinygltf::Model model_;
  std::array<std::array<int, 2>, 4> class_materials_{{{-1, -1}, {-1, -1}, {-1, -1}, {-1, -1}}};
  std::vector<int> image_materials_;
};

}  // namespace

void write_glb(const Mesh& mesh, const FaceImages& images, const Eigen::Vector3d& up, const std::string& crs,
               AtomicFile& file) {
  const GlbModel glb(mesh, images, up, crs);
  std::ofstream stream(file.path(), std::ios::binary);
  tinygltf::TinyGLTF writer;
  errno = 0;
  const bool written = writer.WriteGltfSceneToStream(&glb.model(), stream, false, true);
  if (!written || !stream.flush())
    throw Error("cannot write " + file.path().string() + ": " + std::strerror(errno == 0 ? EIO : errno));
}

}  // namespace atrium::io
