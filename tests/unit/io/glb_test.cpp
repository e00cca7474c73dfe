// GLB files as other programs see them: tinygltf reads them back, the Khronos validator judges them.
#include <tiny_gltf.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "files.hpp"
#include "modules/io/write_mesh.hpp"
#include "modules/scene/bake_textures.hpp"
#include "modules/synth/flat.hpp"
#include "modules/synth/scan.hpp"
#include "modules/types/palette.hpp"
#include "modules/types/turn_between.hpp"
#include "tests/support/lacking.hpp"
#include "tests/support/process.hpp"

namespace atrium::io::glb_test {
namespace {

using Eigen::Vector3d;
using nlohmann::json;

/// A floor, a wall and a ceiling on each of two storeys, all of different areas, and a coloured object.
Mesh two_storeys() {
  Mesh mesh;
  const auto face = [&](SurfaceClass surface, int storey, int primitive, const Vector3d& corner, const Vector3d& a,
                        const Vector3d& b) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Vector3d& p : {corner, Vector3d(corner + a), Vector3d(corner + a + b), Vector3d(corner + b)}) {
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
};

template <class T>
const T* column(const tinygltf::Model& model, int accessor, std::size_t i) {
  const auto& a = model.accessors.at(accessor);
  const auto& view = model.bufferViews.at(a.bufferView);
  const std::size_t step = a.ByteStride(view);
  return reinterpret_cast<const T*>(model.buffers.at(0).data.data() + view.byteOffset + a.byteOffset + i * step);
}

struct Corner {
  Vector3d place, normal;  // of the mesh's frame
  Eigen::Vector2d texture;
};

/// The corners of a glTF primitive's triangles, back in the frame of the mesh.
std::vector<Corner> corners(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
  const auto& extras = model.asset.extras.Get("origin");
  const Vector3d origin(extras.Get(0).GetNumberAsDouble(), extras.Get(1).GetNumberAsDouble(),
                        extras.Get(2).GetNumberAsDouble());
  const auto z_up = [](const float* p) { return Vector3d(p[0], -p[2], p[1]); };
  std::vector<Corner> result;
  for (std::size_t i = 0; i < model.accessors.at(primitive.indices).count; ++i) {
    const std::uint32_t v = *column<std::uint32_t>(model, primitive.indices, i);
    Corner corner;
    corner.place = origin + z_up(column<float>(model, primitive.attributes.at("POSITION"), v));
    corner.normal = Vector3d::Zero();
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

double area(const std::vector<Corner>& c) {
  double sum = 0;
  for (std::size_t i = 0; i + 2 < c.size(); i += 3)
    sum += (c[i + 1].place - c[i].place).cross(c[i + 2].place - c[i].place).norm() / 2;
  return sum;
}

TEST_F(GlbFiles, EachClassAndStoreyIsANamedMesh) {
  const auto model = write(two_storeys(), "m.glb");
  std::map<std::string, double> areas;
  for (const auto& node : model.nodes) {
    const auto& mesh = model.meshes.at(node.mesh);
    EXPECT_EQ(node.name, mesh.name);
    EXPECT_TRUE(node.translation.empty() && node.rotation.empty() && node.matrix.empty());
    for (const auto& primitive : mesh.primitives) areas[mesh.name] += area(corners(model, primitive));
  }
  const std::map<std::string, double> wanted{{"floor, storey 0", 12},
                                             {"floor, storey 1", 15},
                                             {"ceiling, storey 0", 12},
                                             {"ceiling, storey 1", 15},
                                             {"wall, storey 0", 17.5},
                                             {"wall, storey 1", 20},
                                             {"object", 1}};
  ASSERT_EQ(areas.size(), wanted.size());
  for (const auto& [name, value] : wanted) EXPECT_NEAR(areas[name], value, 1e-5) << name;
  EXPECT_EQ(model.scenes.at(0).nodes.size(), wanted.size());
  EXPECT_TRUE(model.extensionsUsed.empty());
}

TEST_F(GlbFiles, PrimitivesKeepTheirSourceNormalsAndMaterials) {
  const Mesh mesh = two_storeys();
  const auto model = write(mesh, "m.glb");
  std::map<int, const tinygltf::Primitive*> found;
  for (const auto& m : model.meshes)
    for (const auto& primitive : m.primitives) {
      const auto& extras = primitive.extras;
      const auto& material = model.materials.at(primitive.material);
      EXPECT_EQ(extras.Get("class").Get<std::string>(), m.name.substr(0, m.name.find(',')));
      if (!extras.Has("primitive")) {
        EXPECT_EQ(m.name, "object");
        EXPECT_FALSE(extras.Has("storey"));
        EXPECT_TRUE(material.doubleSided);
        continue;
      }
      EXPECT_EQ(m.name.substr(m.name.size() - 1), std::to_string(extras.Get("storey").GetNumberAsInt()));
      EXPECT_EQ(material.name, extras.Get("class").Get<std::string>());
      EXPECT_FALSE(material.doubleSided);
      found[extras.Get("primitive").GetNumberAsInt()] = &primitive;
      const auto c = corners(model, primitive);
      ASSERT_EQ(c.size(), 6U);
      EXPECT_EQ(model.accessors.at(primitive.attributes.at("POSITION")).count, 4U);
      for (std::size_t i = 0; i < 6; i += 3) {
        const Vector3d normal = (c[i + 1].place - c[i].place).cross(c[i + 2].place - c[i].place).normalized();
        for (std::size_t k = 0; k < 3; ++k) EXPECT_LT((c[i + k].normal - normal).norm(), 1e-6);
      }
    }
  ASSERT_EQ(found.size(), 8U);
  // Triangles in order: that of primitive 12 begins at number 12.
  const auto c = corners(model, *found.at(12));
  for (std::size_t k = 0; k < 3; ++k) EXPECT_LT((c[k].place - mesh.vertices[mesh.triangles[12][k]]).norm(), 1e-6);
}

TEST_F(GlbFiles, ColoursAreLinear) {
  const auto model = write(two_storeys(), "m.glb");
  for (const auto& mesh : model.meshes)
    for (const auto& primitive : mesh.primitives) {
      const auto& factor = model.materials.at(primitive.material).pbrMetallicRoughness.baseColorFactor;
      if (mesh.name != "object") {
        EXPECT_FALSE(primitive.attributes.contains("COLOR_0")) << "the class's colour says it";
        continue;
      }
      EXPECT_EQ(factor, (std::vector<double>{1, 1, 1, 1}));
      const auto* colour = column<std::uint16_t>(model, primitive.attributes.at("COLOR_0"), 0);
      EXPECT_EQ(colour[0], 65535);
      EXPECT_NEAR(colour[1] / 65535.0, 0.5029, 1e-4);  // sRGB 188
      EXPECT_EQ(colour[2], 0);
      EXPECT_EQ(colour[3], 65535);
    }
  for (const auto& material : model.materials)
    if (material.name == "floor") {  // 230, 159, 0
      EXPECT_NEAR(material.pbrMetallicRoughness.baseColorFactor[0], 0.7913, 1e-4);
      EXPECT_NEAR(material.pbrMetallicRoughness.baseColorFactor[1], 0.3467, 1e-4);
      EXPECT_EQ(material.pbrMetallicRoughness.metallicFactor, 0);
    }
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

TEST_F(GlbFiles, TheReferenceSystemStandsInTheExtras) {
  const auto system_of = [](const tinygltf::Model& model) {
    const auto& extras = model.scenes.at(0).extras;
    EXPECT_EQ(extras.Has("crs"), model.asset.extras.Has("crs"));
    return extras.Has("crs") ? extras.Get("crs").Get<std::string>() : std::string();
  };
  const auto written = [&](const WriteMesh::In& more, const std::string& crs) {
    WriteMesh::In in = more;
    in.mesh = input(two_storeys());
    WriteMesh::Params params;
    params.path.path = "crs.glb";
    params.crs = crs;
    WriteMesh::run(in, params, context);
    return read("crs.glb");
  };
  EXPECT_EQ(system_of(written({}, "")), "");
  Cloud scan;
  scan.crs = "EPSG:32633";
  WriteMesh::In of_scan;
  of_scan.scan = input(scan);
  EXPECT_EQ(system_of(written(of_scan, "")), "EPSG:32633");
  EXPECT_EQ(system_of(written(of_scan, "urn:ogc:def:crs:EPSG::25832")), "EPSG:25832");
  EXPECT_THROW(written({}, "UTM 32"), Error);
}

TEST_F(GlbFiles, GeoreferencedModelsStandNearZeroAndSayWhereTheyBelong) {
  Mesh mesh = two_storeys();
  mesh.origin = {500000.125, 5400000.25, 40};
  const auto far = write(mesh, "u.glb");
  const auto& origin = far.asset.extras.Get("origin");
  EXPECT_EQ(origin.Get(0).GetNumberAsDouble(), 500000.125);
  EXPECT_EQ(origin.Get(1).GetNumberAsDouble(), 5400000.25);
  for (auto& v : mesh.vertices) v += mesh.origin;
  mesh.origin.setZero();
  const auto shifted = write(mesh, "v.glb");
  EXPECT_EQ(shifted.asset.extras.Get("origin").Get(0).GetNumberAsDouble(), 500003);  // whole metres, in the middle
  for (const auto* model : {&far, &shifted}) {
    const auto c = corners(*model, model->meshes.at(1).primitives.at(0));
    const auto object = corners(*model, model->meshes.at(0).primitives.at(0));
    EXPECT_LT((object[0].place - mesh.vertices[mesh.vertices.size() - 4]).norm(), 1e-6);
    ASSERT_EQ(c.size(), 6U);
    for (const auto& accessor : model->accessors)
      for (const double limit : accessor.maxValues) EXPECT_LT(std::abs(limit), 1000);
  }
  // Small coordinates stay what they are.
  EXPECT_EQ(write(two_storeys(), "w.glb").asset.extras.Get("origin").Get(1).GetNumberAsDouble(), 0);
}

TEST_F(GlbFiles, FacesThatAreNotOfOnePlaneHaveNoCommonNormal) {
  Mesh mesh = two_storeys();
  mesh.vertices[2].z() += 0.3;  // the floor's first triangle and its second fold
  const auto model = write(mesh, "m.glb");
  for (const auto& m : model.meshes)
    for (const auto& primitive : m.primitives)
      if (primitive.extras.Has("primitive")) {
        EXPECT_EQ(primitive.attributes.contains("NORMAL"), primitive.extras.Get("primitive").GetNumberAsInt() != 0);
      }
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

/// The lowest and the highest corner of a file, in glTF's frame.
std::pair<Vector3d, Vector3d> bounds(const tinygltf::Model& model) {
  Vector3d low = Vector3d::Constant(1e9), high = -low;
  for (const auto& mesh : model.meshes)
    for (const auto& primitive : mesh.primitives) {
      const auto& a = model.accessors.at(primitive.attributes.at("POSITION"));
      low = low.cwiseMin(Vector3d(a.minValues[0], a.minValues[1], a.minValues[2]));
      high = high.cwiseMax(Vector3d(a.maxValues[0], a.maxValues[1], a.maxValues[2]));
    }
  return {low, high};
}

TEST_F(GlbFiles, StandsUprightWhateverIsUpInTheFrameOfTheMesh) {
  const Mesh upright = two_storeys();  // 5 × 3 × 5.5 m
  for (const Vector3d& up : {Vector3d(0, 0, 1), Vector3d(0, 1, 0), Vector3d(0, -1, 0), Vector3d(1, 0, 0),
                             Vector3d(-1, 0, 0), Vector3d(0.3, 0.8, -0.5).normalized()}) {
    Transform to_upright;
    to_upright.rotation = turn_between(up, Vector3d::UnitZ()).toRotationMatrix();
    Mesh mesh = upright;
    for (auto& v : mesh.vertices) v = to_upright.rotation.transpose() * v;
    WriteMesh::In in{input(mesh), {}};
    in.transform = input(to_upright);
    WriteMesh::run(in, {{"m.glb"}, true}, context);
    const auto [low, high] = bounds(read("m.glb"));
    EXPECT_NEAR(low.y(), 0, 1e-6) << up.transpose();
    EXPECT_NEAR(high.y(), 5.5, 1e-6) << up.transpose();
  }
}

TEST_F(GlbFiles, YUpStaysAsItIsAndASmallTiltStays) {
  Mesh mesh = two_storeys();
  WriteMesh::In in{input(mesh), {}};
  Transform y_up;  // y of the mesh becomes z
  y_up.rotation << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  in.transform = input(y_up);
  WriteMesh::run(in, {{"y.glb"}, true}, context);
  const auto [low, high] = bounds(read("y.glb"));
  EXPECT_NEAR((low - Vector3d(0, 0, 0)).norm() + (high - Vector3d(5, 3, 5.5)).norm(), 0, 1e-6);
  Transform tilted;
  tilted.rotation = Eigen::AngleAxisd(0.05, Vector3d::UnitX()).toRotationMatrix();  // 2.9 degrees
  in.transform = input(tilted);
  WriteMesh::run(in, {{"t.glb"}, true}, context);
  EXPECT_NEAR((bounds(read("t.glb")).second - Vector3d(5, 5.5, 0)).norm(), 0, 1e-6);
}

}  // namespace
}  // namespace atrium::io::glb_test
