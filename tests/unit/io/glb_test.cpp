// What the meshes, normals, materials and places of GLB files are.
#include <cmath>
#include <map>

#include "glb_files.hpp"
#include "modules/types/turn_between.hpp"

namespace atrium::io::glb_test {
namespace {

using Eigen::Vector3d;

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
