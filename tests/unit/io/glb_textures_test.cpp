// The images of GLB and OBJ files; the Khronos validator judges all kinds of GLB files.
#include <cmath>
#include <nlohmann/json.hpp>

#include "glb_files.hpp"
#include "modules/scene/bake_textures.hpp"
#include "modules/synth/flat.hpp"
#include "modules/synth/scan.hpp"
#include "tests/support/lacking.hpp"
#include "tests/support/process.hpp"

namespace atrium::io::glb_textures_test {
namespace {

using Eigen::Vector3d;
using nlohmann::json;

/// A test image for a wall of two_storeys: red falls from left to right, green from the top down.
FaceTexture slope(int primitive, const Vector3d& corner, const Vector3d& across, const Vector3d& down) {
  FaceTexture image{primitive, corner, across, down, 64, 32, {}};
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x) {
      image.pixels.push_back(static_cast<std::uint8_t>(255 - 4 * x));
      image.pixels.push_back(static_cast<std::uint8_t>(255 - 8 * y));
      image.pixels.push_back(17);
    }
  return image;
}

TEST_F(GlbFiles, TexturesLieWhereTheirRectanglesAre) {
  const Mesh mesh = two_storeys();
  Textures textures;
  textures.origin = {100, 200, 300};  // another than the mesh's
  // Larger than the wall by 0.5 m at each side: from (-0.5, 3, 3) to (4.5, 3, -0.5).
  textures.faces.push_back(slope(2, Vector3d(-0.5, 3, 3) - textures.origin, {5, 0, 0}, {0, 0, -3.5}));
  textures.faces.push_back(slope(99, {0, 0, 0}, {5, 0, 0}, {0, 0, -3.5}));  // of no face: not written
  const auto model = write(mesh, "t.glb", &textures);
  EXPECT_EQ(model.extensionsUsed, std::vector<std::string>{"KHR_materials_unlit"});
  ASSERT_EQ(model.images.size(), 1U);
  const auto& image = model.images[0];
  EXPECT_EQ(image.name, "wall_2");
  ASSERT_EQ(image.width, 64);
  ASSERT_EQ(image.height, 32);
  const auto& sampler = model.samplers.at(model.textures.at(0).sampler);
  EXPECT_EQ(sampler.wrapS, TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE);
  EXPECT_EQ(sampler.wrapT, TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE);
  int textured = 0;
  for (const auto& m : model.meshes)
    for (const auto& primitive : m.primitives) {
      const auto& material = model.materials.at(primitive.material);
      if (material.pbrMetallicRoughness.baseColorTexture.index < 0) continue;
      ++textured;
      EXPECT_EQ(primitive.extras.Get("primitive").GetNumberAsInt(), 2);
      EXPECT_TRUE(material.extensions.contains("KHR_materials_unlit"));
      for (const auto& corner : corners(model, primitive)) {
        const double u = (corner.place.x() + 0.5) / 5, v = (3 - corner.place.z()) / 3.5;
        EXPECT_NEAR(corner.texture.x(), u, 1e-6);
        EXPECT_NEAR(corner.texture.y(), v, 1e-6);
        const auto x = static_cast<int>(corner.texture.x() * 64), y = static_cast<int>(corner.texture.y() * 32);
        const auto* pixel = &image.image[static_cast<std::size_t>(y * 64 + x) * image.component];
        EXPECT_EQ(pixel[0], 255 - 4 * static_cast<int>(u * 64));
        EXPECT_EQ(pixel[1], 255 - 8 * static_cast<int>(v * 32));
        EXPECT_EQ(pixel[2], 17);
      }
    }
  EXPECT_EQ(textured, 1);
}

TEST_F(GlbFiles, ObjNamesTheSameImages) {
  Textures textures;
  textures.faces.push_back(slope(2, {-0.5, 3, 3}, {5, 0, 0}, {0, 0, -3.5}));
  WriteMesh::run({input(two_storeys()), input(textures)}, {{"m.obj"}, true}, context);
  const auto model = write(two_storeys(), "m.glb", &textures);
  const auto& view = model.bufferViews.at(model.images.at(0).bufferView);
  const auto* png = reinterpret_cast<const char*>(model.buffers.at(0).data.data() + view.byteOffset);
  EXPECT_EQ(content("m_wall_2.png"), std::string(png, view.byteLength));
  EXPECT_CONTAINS(content("m.mtl"), "newmtl wall_2\nKd 1 1 1\nillum 0\nmap_Kd -clamp on m_wall_2.png\n");
  const std::string obj = content("m.obj");
  // The wall's first corner is (0, 3, 0): 0.5 m of 5 m from the left, 0.5 m of 3.5 m from below.
  EXPECT_CONTAINS(obj, "g wall_2\nusemtl wall_2\nvt 0.1 0.1428571\n");
  EXPECT_CONTAINS(obj, "\nf 9/1 10/2 11/3\n");
  EXPECT_CONTAINS(obj, "g wall_3\nusemtl wall\nf ");
  EXPECT_TRUE(host->warnings.empty()) << warnings();
}

TEST_F(GlbFiles, UnsoundTexturesAreRefused) {
  const Mesh mesh = two_storeys();
  Textures textures;
  const FaceTexture sound = slope(2, {0, 3, 3}, {5, 0, 0}, {0, 0, -3.5});
  const auto failure = [&](const std::vector<FaceTexture>& faces) {
    textures.faces = faces;
    return error_of([&] { write(mesh, "x.glb", &textures); });
  };
  FaceTexture thin = sound, small = sound, empty = sound;
  thin.across.setZero();
  small.pixels.pop_back();
  empty.width = 0;
  EXPECT_CONTAINS(failure({thin}), "the texture of primitive 2 has no rectangle");
  EXPECT_CONTAINS(failure({small}), "64 × 32 pixels has 6143 bytes");
  EXPECT_CONTAINS(failure({empty}), "0 × 32 pixels");
  EXPECT_CONTAINS(failure({sound, sound}), "primitive 2 has two textures");
  EXPECT_TRUE(std::filesystem::is_empty(folder));
  textures.faces = {sound};
  WriteMesh::run({input(mesh), input(textures)}, {{"x.stl"}, true}, context);
  EXPECT_TRUE(warned("textures are not written to .stl"));
}

/// A simulated flat as the scan shows it, with its true structure and a ball of 2,000 coloured triangles.
Mesh flat_with_ball(Textures& textures, Context& context) {
  const auto scene = synth::Flat::run({}, context).scene;
  synth::Scan::Params params;
  params.points = 100000;
  params.offset = {500000, 5400000, 100};
  const auto scan = synth::Scan::run({input(scene)}, params, context);
  scene::BakeTextures::Params bake;
  bake.resolution = 0.04;
  textures = scene::BakeTextures::run({input(scan.cloud), input(scan.mesh)}, bake, context).textures;
  Mesh mesh = scan.mesh;
  mesh.colours.assign(mesh.vertices.size(), {200, 200, 200});
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  constexpr std::uint32_t around = 50, rings = 20;
  for (std::uint32_t r = 0; r <= rings; ++r)
    for (std::uint32_t i = 0; i < around; ++i) {
      const double a = 2 * M_PI * i / around, b = M_PI * (r + 0.5) / (rings + 1);
      mesh.vertices.emplace_back(Vector3d(3, 3, 1) + 0.4 * Vector3d(cos(a) * sin(b), sin(a) * sin(b), -cos(b)));
      mesh.colours.push_back({static_cast<std::uint8_t>(5 * i), static_cast<std::uint8_t>(10 * r), 0});
      if (r == rings) continue;
      const std::uint32_t p = first + r * around + i, q = first + r * around + (i + 1) % around;
      mesh.triangles.push_back({p, q, p + around});
      mesh.triangles.push_back({q, q + around, p + around});
    }
  mesh.classes.resize(mesh.triangles.size(), SurfaceClass::object);
  mesh.primitives.resize(mesh.triangles.size(), -1);
  if (!mesh.storeys.empty()) mesh.storeys.resize(mesh.triangles.size(), -1);
  return mesh;
}

TEST_F(GlbFiles, KhronosValidatorFindsNoFault) {
  Mesh triangle;
  triangle.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  triangle.triangles = {{0, 1, 2}};
  Mesh coloured = triangle;
  coloured.colours = {{255, 0, 0}, {0, 128, 0}, {0, 0, 7}};
  Mesh utm = two_storeys();
  utm.origin = {500000.123456, 5400000.654321, -3.3};
  Textures textures;
  const Mesh flat = flat_with_ball(textures, context);
  EXPECT_GE(textures.faces.size(), 20U);
  write(triangle, "triangle.glb");
  write(coloured, "coloured.glb");
  write(two_storeys(), "storeys.glb");
  write(utm, "utm.glb");
  const auto model = write(flat, "flat.glb", &textures);
  EXPECT_EQ(model.images.size(), textures.faces.size());
  WriteMesh::run({input(Mesh{}), {}}, {{"empty.glb"}, true}, context);

  const auto build = std::filesystem::path(ATRIUM_PROGRAM).parent_path().parent_path();
  std::vector<std::string> command{ATRIUM_SOURCE_DIR "/tests/validate-glb", build / "tests/gltf-validator"};
  for (const std::string name : {"triangle", "coloured", "storeys", "utm", "flat", "empty"})
    command.push_back(path(name + ".glb"));
  const auto result = test::run_process(command);
  if (result.exit_code == 77) ATRIUM_SKIP_LACKING("the glTF validator cannot be had: " << result.err);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::istringstream lines(result.out);
  int reports = 0;
  for (std::string line; std::getline(lines, line); ++reports) {
    const json report = json::parse(line);
    const json& issues = report["issues"];
    EXPECT_EQ(issues["numErrors"], 0) << line;
    EXPECT_EQ(issues["numWarnings"], 0) << line;
    for (const auto& message : issues["messages"])
      EXPECT_EQ(message["code"], "IMAGE_NPOT_DIMENSIONS") << message;  // of no concern since WebGL 2
  }
  EXPECT_EQ(reports, 6);
}

}  // namespace
}  // namespace atrium::io::glb_textures_test
