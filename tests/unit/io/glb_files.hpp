#pragma once
#include <tiny_gltf.h>

#include <Eigen/Geometry>

#include "files.hpp"
#include "modules/io/write_mesh.hpp"
#include "modules/types/palette.hpp"

namespace atrium::io {

/// GLB files as other programs see them: tinygltf reads them back.
class GlbFiles : public Files {
 protected:
  tinygltf::Model write(const Mesh& mesh, const std::string& name, const Textures* textures = nullptr) {
    WriteMesh::In in{input(mesh), {}};
    if (textures != nullptr) in.textures = input(*textures);
    WriteMesh::run(in, {{name}, true}, context);
    return read(name);
  }
  tinygltf::Model read(const std::string& name) {
    tinygltf::Model model;
    std::string error, warning;
    tinygltf::TinyGLTF loader;
    EXPECT_TRUE(loader.LoadBinaryFromFile(&model, &error, &warning, path(name))) << error;
    EXPECT_EQ(error + warning, "");
    return model;
  }

  /// A floor, a wall and a ceiling on each of two storeys, all of different areas, and a coloured object.
  static Mesh two_storeys() {
    Mesh mesh;
    const auto face = [&](SurfaceClass surface, int storey, int primitive, const Eigen::Vector3d& corner,
                          const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
      const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
      for (const Eigen::Vector3d& p :
           {corner, Eigen::Vector3d(corner + a), Eigen::Vector3d(corner + a + b), Eigen::Vector3d(corner + b)}) {
        mesh.vertices.push_back(p);
        mesh.colours.push_back(class_colour(surface));
      }
      for (std::uint32_t i = 2; i < 4; ++i) {
        mesh.triangles.push_back({first, first + i - 1, first + i});
        mesh.classes.push_back(surface);
        mesh.storeys.push_back(storey);
        mesh.primitives.push_back(primitive);
      }
    };
    for (const int s : {0, 1}) {
      const double z = 3.0 * s, wide = 4 + s;
      face(SurfaceClass::floor, s, 10 * s, {0, 0, z}, {wide, 0, 0}, {0, 3, 0});
      face(SurfaceClass::ceiling, s, 10 * s + 1, {0, 0, z + 2.5}, {0, 3, 0}, {wide, 0, 0});
      face(SurfaceClass::wall, s, 10 * s + 2, {0, 3, z}, {wide, 0, 0}, {0, 0, 2.5});
      face(SurfaceClass::wall, s, 10 * s + 3, {0, 0, z}, {0, 3, 0}, {0, 0, 2.5});
    }
    face(SurfaceClass::object, -1, -1, {1, 1, 1}, {1, 0, 0}, {0, 1, 0});
    for (std::size_t i = 0; i < 4; ++i) mesh.colours[mesh.colours.size() - 1 - i] = {255, 188, 0};
    return mesh;
  }

  template <class T>
  static const T* column(const tinygltf::Model& model, int accessor, std::size_t i) {
    const auto& a = model.accessors.at(accessor);
    const auto& view = model.bufferViews.at(a.bufferView);
    const std::size_t step = a.ByteStride(view);
    return reinterpret_cast<const T*>(model.buffers.at(0).data.data() + view.byteOffset + a.byteOffset + i * step);
  }

  struct Corner {
    Eigen::Vector3d place, normal;  // of the mesh's frame
    Eigen::Vector2d texture;
  };

  /// The corners of a glTF primitive's triangles, back in the frame of the mesh.
  static std::vector<Corner> corners(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
    const auto& extras = model.asset.extras.Get("origin");
    const Eigen::Vector3d origin(extras.Get(0).GetNumberAsDouble(), extras.Get(1).GetNumberAsDouble(),
                                 extras.Get(2).GetNumberAsDouble());
    const auto z_up = [](const float* p) { return Eigen::Vector3d(p[0], -p[2], p[1]); };
    std::vector<Corner> result;
    for (std::size_t i = 0; i < model.accessors.at(primitive.indices).count; ++i) {
      const std::uint32_t v = *column<std::uint32_t>(model, primitive.indices, i);
      Corner corner;
      corner.place = origin + z_up(column<float>(model, primitive.attributes.at("POSITION"), v));
      corner.normal = Eigen::Vector3d::Zero();
      if (primitive.attributes.contains("NORMAL"))
        corner.normal = z_up(column<float>(model, primitive.attributes.at("NORMAL"), v));
      corner.texture = {-1, -1};
      if (primitive.attributes.contains("TEXCOORD_0")) {
        const float* t = column<float>(model, primitive.attributes.at("TEXCOORD_0"), v);
        corner.texture = {t[0], t[1]};
      }
      result.push_back(corner);
    }
    return result;
  }

  static double area(const std::vector<Corner>& c) {
    double sum = 0;
    for (std::size_t i = 0; i + 2 < c.size(); i += 3)
      sum += (c[i + 1].place - c[i].place).cross(c[i + 2].place - c[i].place).norm() / 2;
    return sum;
  }
};

}  // namespace atrium::io
