// glTF in: meshes and points of .glb and .gltf as they come from elsewhere, and our own.
#include <Eigen/Geometry>
#include <cmath>

#include "files.hpp"
#include "modules/io/read_mesh.hpp"
#include "modules/io/read_scan.hpp"
#include "modules/io/write_mesh.hpp"
#include "modules/types/palette.hpp"
#include "tests/support/gltf_builder.hpp"

namespace atrium::io::gltf_test {
namespace {

using Eigen::Vector3d;
using test::GltfBuilder;
using Corners = std::array<Vector3d, 3>;

/// A unit square in the plane z = 0, of two triangles.
const std::vector<float> square{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};

class GltfFiles : public Files {
 protected:
  Mesh read(const std::string& name) { return ReadMesh::run({{path(name)}}, context).mesh; }
  Mesh parse(const std::string& bytes, const std::string& name = "m.glb") {
    file(name, bytes);
    return read(name);
  }
  Cloud cloud(const std::string& bytes, const std::string& name = "m.glb") {
    file(name, bytes);
    ReadScan::Params params;
    params.path = {{path(name)}};
    params.mesh = ReadScan::MeshUse::vertices;
    return ReadScan::run(params, context).cloud;
  }
  std::string failure(const std::string& bytes, const std::string& name = "m.glb") {
    return error_of([&] { parse(bytes, name); });
  }
  static std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from << " in " << text;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
  }
  /// The same file with another JSON.
  static std::string changed(const GltfBuilder& builder, const std::string& from, const std::string& to) {
    return test::glb_file(replaced(builder.json(), from, to), builder.binary);
  }
};

std::vector<Corners> corners_of(const Mesh& mesh) {
  std::vector<Corners> all;
  for (const auto& [a, b, c] : mesh.triangles)
    all.push_back({mesh.origin + mesh.vertices[a], mesh.origin + mesh.vertices[b], mesh.origin + mesh.vertices[c]});
  return all;
}

double area_along(const Mesh& mesh, const Vector3d& axis) {
  double area = 0;
  for (const auto& [a, b, c] : corners_of(mesh)) area += (b - a).cross(c - a).dot(axis) / 2;
  return area;
}

GltfBuilder of_square() {
  GltfBuilder builder;
  builder.add(square, "VEC3", 3);
  builder.add(std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3}, "SCALAR", 1);
  builder.primitives = {R"({"attributes":{"POSITION":0},"indices":1})"};
  return builder;
}

TEST_F(GltfFiles, IndicesOfAnyWidthAndNoneGiveTheSameTriangles) {
  const Mesh wanted = parse(of_square().glb());
  ASSERT_EQ(wanted.triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(wanted.vertices[2], Vector3d(1, 1, 0));
  EXPECT_TRUE(wanted.colours.empty());
  EXPECT_TRUE(wanted.classes.empty());
  const auto with = [&](auto type) {
    GltfBuilder builder;
    builder.add(square, "VEC3", 3);
    builder.add(std::vector<decltype(type)>{0, 1, 2, 0, 2, 3}, "SCALAR", 1);
    builder.primitives = {R"({"attributes":{"POSITION":0},"indices":1})"};
    return parse(builder.glb());
  };
  EXPECT_EQ(with(std::uint8_t{}).triangles, wanted.triangles);
  EXPECT_EQ(with(std::uint32_t{}).triangles, wanted.triangles);
  GltfBuilder plain;  // corners that lie in one place are one vertex
  plain.add(std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, -0.0F, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3", 3);
  plain.primitives = {R"({"attributes":{"POSITION":0}})"};
  EXPECT_EQ(parse(plain.glb()).triangles, wanted.triangles);
  EXPECT_EQ(parse(plain.glb()).vertices.size(), 4U);
  EXPECT_TRUE(host->warnings.empty()) << warnings();
}

TEST_F(GltfFiles, StripsAndFansTurnAllTrianglesOneWay) {
  for (const std::string mode : {"5", "6"}) {
    GltfBuilder builder;
    builder.add(square, "VEC3", 3);
    builder.add(mode == "5" ? std::vector<std::uint16_t>{0, 1, 3, 2} : std::vector<std::uint16_t>{0, 1, 2, 3}, "SCALAR",
                1);
    builder.primitives = {R"({"attributes":{"POSITION":0},"indices":1,"mode":)" + mode + "}"};
    const Mesh mesh = parse(builder.glb());
    EXPECT_EQ(mesh.triangles.size(), 2U);
    EXPECT_NEAR(area_along(mesh, {0, 0, 1}), 1, 1e-12) << mode;
  }
}

TEST_F(GltfFiles, NodesPutMeshesWhereTheirTransformsSay) {
  GltfBuilder builder = of_square();
  // A quarter turn about x and a shift, within a node that is twice as large and stands at x = 10.
  builder.nodes = R"([{"children":[1],"matrix":[2,0,0,0, 0,2,0,0, 0,0,2,0, 10,0,0,1]},
    {"mesh":0,"rotation":[0.70710678118654757,0,0,0.70710678118654757],"translation":[0,0,3],"children":[2]},
    {"mesh":0,"scale":[1,1,-1]}])";
  const Mesh mesh = parse(builder.glb());
  ASSERT_EQ(mesh.triangles.size(), 4U);
  const auto corners = corners_of(mesh);
  EXPECT_LT((corners[0][2] - Vector3d(12, 0, 8)).norm(), 1e-9);  // (1, 1, 0) turned to (1, 0, 1), shifted, doubled
  EXPECT_NEAR(area_along(mesh, {0, -1, 0}), 0, 1e-9);            // its mirrored child shows the other side
  EXPECT_NEAR(
      area_along(mesh, {0, -1, 0}) +
          area_along({mesh.origin, mesh.vertices, {}, {mesh.triangles[2], mesh.triangles[3]}, {}, {}, {}}, {0, 1, 0}),
      4, 1e-9);
  builder.nodes = R"([{"mesh":0,"scale":[-1,1,1]}])";
  EXPECT_NEAR(area_along(parse(builder.glb()), {0, 0, 1}), 1, 1e-12);
}

TEST_F(GltfFiles, NodesThatAreNoTreesAreRefused) {
  GltfBuilder builder = of_square();
  const auto with = [&](const std::string& nodes) {
    builder.nodes = nodes;
    return failure(builder.glb());
  };
  EXPECT_CONTAINS(with(R"([{"children":[1]},{"children":[0],"mesh":0}])"),
                  "m.glb: nodes[1].children[0] is node 0, which is reached a second time");
  EXPECT_CONTAINS(with(R"([{"children":[1,1]},{"mesh":0}])"), "reached a second time");
  EXPECT_CONTAINS(with(R"([{"children":[7]},{"mesh":0}])"), "nodes[0].children[0] is 7, but the file has 2 nodes");
  EXPECT_CONTAINS(with(R"([{"mesh":3}])"), "nodes[0].mesh is 3, but the file has 1 meshes");
  EXPECT_CONTAINS(with(R"([{"mesh":0,"rotation":[0,0,0,0]}])"), "nodes[0].rotation is no rotation");
  EXPECT_CONTAINS(with(R"([{"mesh":0,"matrix":[1,0,0]}])"), "nodes[0].matrix has 3 numbers, not 16");
  EXPECT_CONTAINS(with(R"([{"mesh":0,"scale":[1e200,1,1],"children":[1]},{"scale":[1e200,1,1]}])"), "not finite");
}

TEST_F(GltfFiles, ColoursAreOfVerticesAndMaterialsAsSrgb) {
  GltfBuilder builder = of_square();
  builder.add(std::vector<std::uint16_t>{65535, 0, 13933, 65535, 65535, 0, 13933, 65535, 65535, 0, 13933, 65535, 65535,
                                         0, 13933, 65535},
              "VEC4", 4, R"(,"normalized":true)");
  builder.add(std::vector<float>{1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1}, "VEC3", 3);
  builder.more = R"(,"materials":[{"pbrMetallicRoughness":{"baseColorFactor":[0.2126,1,1,1]}}])";
  const auto colour = [&](const std::string& primitive) {
    builder.primitives = {primitive};
    const Mesh mesh = parse(builder.glb());
    return mesh.colours.empty() ? Colour{9, 9, 9} : mesh.colours[0];
  };
  EXPECT_EQ(colour(R"({"attributes":{"POSITION":0,"COLOR_0":2},"indices":1})"), (Colour{255, 0, 127}));
  EXPECT_EQ(colour(R"({"attributes":{"POSITION":0,"COLOR_0":2},"indices":1,"material":0})"), (Colour{127, 0, 127}));
  EXPECT_EQ(colour(R"({"attributes":{"POSITION":0,"COLOR_0":3},"indices":1})"), (Colour{255, 255, 255}));
  EXPECT_EQ(colour(R"({"attributes":{"POSITION":0},"indices":1,"material":0})"), (Colour{127, 255, 255}));
  EXPECT_EQ(colour(R"({"attributes":{"POSITION":0},"indices":1})"), (Colour{9, 9, 9}));
  builder.primitives = {R"({"attributes":{"POSITION":0,"COLOR_0":1},"indices":1})"};
  EXPECT_CONTAINS(failure(builder.glb()), "COLOR_0 has 6 entries of 1 numbers, but there are 4 vertices");
}

/// 16 × 8 pixels of red 200, green 30, blue 60.
const std::string jpeg =
    "/9j/4AAQSkZJRgABAQAAAQABAAD/2wBDABsSFBcUERsXFhceHBsgKEIrKCUlKFE6PTBCYFVlZF9VXVtqeJmBanGQc1tdhbWGkJ6jq62rZ4C8ybqm"
    "x5moq6T/2wBDARweHigjKE4rK06kbl1upKSkpKSkpKSkpKSkpKSkpKSkpKSkpKSkpKSkpKSkpKSkpKSkpKSkpKSkpKSkpKSkpKT/wAARCAAIABAD"
    "ASIAAhEBAxEB/8QAFQABAQAAAAAAAAAAAAAAAAAAAAT/xAAUEAEAAAAAAAAAAAAAAAAAAAAA/8QAFQEBAQAAAAAAAAAAAAAAAAAAAwX/xAAUEQEA"
    "AAAAAAAAAAAAAAAAAAAA/9oADAMBAAIRAxEAPwCIAaw//9k=";

TEST_F(GltfFiles, ImagesColourTheVertices) {
  GltfBuilder builder = of_square();
  builder.add(std::vector<float>{0, 0, 1, 0, 1, 1, 0, 1}, "VEC2", 2);
  builder.primitives = {R"({"attributes":{"POSITION":0,"TEXCOORD_0":2},"indices":1,"material":0})"};
  const auto with_image = [&](const std::string& uri) {
    builder.more =
        R"(,"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],"textures":[{"source":0}],)"
        R"("images":[{"uri":")" +
        uri + "\"}]";
    return parse(builder.glb());
  };
  const Mesh mesh = with_image("data:image/jpeg;base64," + jpeg);
  ASSERT_EQ(mesh.colours.size(), 4U) << warnings();
  const int red = mesh.colours[0][0], green = mesh.colours[2][1], blue = mesh.colours[3][2];
  EXPECT_LT(std::abs(red - 200) + std::abs(green - 30) + std::abs(blue - 60), 12);
  EXPECT_TRUE(host->warnings.empty()) << warnings();
  EXPECT_TRUE(with_image("data:image/jpeg;base64," + jpeg.substr(0, 300)).colours.empty());  // before its pixels
  EXPECT_TRUE(warned("m.glb: images[0] cannot be decoded: its colours are not read")) << warnings();
  EXPECT_TRUE(with_image("data:image/webp;base64,UklGRg==").colours.empty());
  EXPECT_TRUE(warned("images[0] is neither PNG nor JPEG")) << warnings();
  std::string vast = "\x89PNG\r\n\x1A\n";
  vast += std::string("\0\0\0\rIHDR\0\0\x40\0\0\0\x40\0\x08\x02\0\0\0", 21);
  EXPECT_TRUE(with_image("data:image/png;base64," + test::base64(vast)).colours.empty());
  EXPECT_TRUE(warned("images[0] is of 16384 × 16384 pixels, more than its 29 bytes can hold")) << warnings();
}

TEST_F(GltfFiles, OurOwnImagesComeBackAsColours) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {2, 0, 0}, {2, 0, 1}, {0, 0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.classes = {SurfaceClass::wall, SurfaceClass::wall};
  mesh.primitives = {3, 3};
  FaceTexture image{3, {0, 0, 1}, {2, 0, 0}, {0, 0, -1}, 2, 1, {250, 0, 0, 0, 0, 250}};  // red left, blue right
  Textures textures;
  textures.faces.push_back(image);
  WriteMesh::run({input(mesh), input(textures), {}}, {{"own.glb"}}, context);
  const Mesh back = read("own.glb");
  ASSERT_EQ(back.colours.size(), 4U);
  for (std::size_t v = 0; v < 4; ++v) {
    const bool left = back.vertices[v].x() < 1;
    EXPECT_GT(back.colours[v][left ? 0 : 2], back.colours[v][left ? 2 : 0]) << v;
  }
}

TEST_F(GltfFiles, PrimitivesShareTheirVertices) {
  GltfBuilder builder;
  builder.add(square, "VEC3", 3);
  builder.add(std::vector<std::uint16_t>{0, 1, 2}, "SCALAR", 1);
  builder.add(std::vector<std::uint16_t>{0, 2, 3}, "SCALAR", 1);
  builder.primitives = {R"({"attributes":{"POSITION":0},"indices":1})", R"({"attributes":{"POSITION":0},"indices":2})",
                        R"({"attributes":{"POSITION":0},"mode":1})"};
  const Mesh mesh = parse(builder.glb());
  EXPECT_EQ(mesh.vertices.size(), 4U);
  EXPECT_EQ(mesh.triangles.size(), 2U);
  EXPECT_TRUE(warned("1 primitive is of lines")) << warnings();
}

TEST_F(GltfFiles, QuantisedCoordinatesAndSparseOnesAreRead) {
  GltfBuilder builder;
  builder.add(std::vector<std::int16_t>{0, 0, 0, 32767, 0, 0, 32767, 32767, 0, 0, 32767, 0}, "VEC3", 3,
              R"(,"normalized":true)");
  builder.add(std::vector<std::uint8_t>{0, 1, 2, 0, 2, 3}, "SCALAR", 1);
  builder.primitives = {R"({"attributes":{"POSITION":0},"indices":1})"};
  builder.more = R"(,"extensionsRequired":["KHR_mesh_quantization"])";
  EXPECT_NEAR(area_along(parse(builder.glb()), {0, 0, 1}), 1, 1e-12);

  GltfBuilder sparse = of_square();
  sparse.add(std::vector<std::uint16_t>{1, 2}, "SCALAR", 1);
  sparse.add(std::vector<float>{3, 0, 0, 3, 1, 0}, "VEC3", 3);
  const std::string there = R"("sparse":{"count":2,"indices":{"bufferView":2,"componentType":5123},)"
                            R"("values":{"bufferView":3}})";
  const int moved =
      sparse.add_accessor(R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3",)" + there + "}");
  const int bare = sparse.add_accessor(R"({"componentType":5126,"count":4,"type":"VEC3",)" + there + "}");
  sparse.primitives = {R"({"attributes":{"POSITION":)" + std::to_string(moved) + R"(},"indices":1})"};
  EXPECT_NEAR(area_along(parse(sparse.glb()), {0, 0, 1}), 3, 1e-12);
  EXPECT_CONTAINS(failure(changed(sparse, R"("sparse":{"count":2)", R"("sparse":{"count":5)")), "sparse.count is more");
  sparse.primitives = {R"({"attributes":{"POSITION":)" + std::to_string(bare) + R"(},"indices":1})"};
  EXPECT_NEAR(area_along(parse(sparse.glb()), {0, 0, 1}), 1.5, 1e-12);  // the other two are zero
}

TEST_F(GltfFiles, TextWithDataOrAFileBesideItIsTheSame) {
  const GltfBuilder builder = of_square();
  const Mesh wanted = parse(builder.glb());
  EXPECT_EQ(corners_of(parse(builder.gltf(), "m.gltf")), corners_of(wanted));
  EXPECT_EQ(corners_of(parse("\xEF\xBB\xBF" + builder.gltf(), "by_content.dat")), corners_of(wanted));
  EXPECT_EQ(corners_of(parse(builder.glb(), "by_content.ply")), corners_of(wanted));
  file("the part.bin", builder.binary);
  EXPECT_EQ(corners_of(parse(builder.json("the%20part.bin"), "m.gltf")), corners_of(wanted));
  EXPECT_CONTAINS(failure(builder.json("lost.bin"), "m.gltf"),
                  "m.gltf: buffers[0].uri is 'lost.bin': there is no such file beside this one");
  EXPECT_CONTAINS(failure(builder.json("https://example.org/a.bin"), "m.gltf"), "only files beside this one are read");
  EXPECT_CONTAINS(failure(builder.json("/etc/hostname"), "m.gltf"), "only files beside this one are read");
  EXPECT_CONTAINS(failure(builder.json("data:;base64,!!!!"), "m.gltf"), "buffers[0].uri is not base 64");
  file("the part.bin", builder.binary.substr(0, 20));
  EXPECT_CONTAINS(failure(builder.json("the%20part.bin"), "m.gltf"),
                  "buffers[0].byteLength is 60, but from the part.bin byte 0 on there are 20 bytes");
}

TEST_F(GltfFiles, WhatIsNotReadIsRefusedOrSaid) {
  GltfBuilder builder = of_square();
  const auto needs = [&](const std::string& extension) {
    builder.more = R"(,"extensionsRequired":[")" + extension + "\"]";
    file("m.glb", builder.glb());
    try {
      read("m.glb");
    } catch (const Error& error) {
      return std::string(error.what()) + "; " + error.help();
    }
    return std::string();
  };
  EXPECT_CONTAINS(needs("KHR_draco_mesh_compression"), "the mesh is compressed, which is not read; export it without");
  EXPECT_CONTAINS(needs("EXT_meshopt_compression"), "extensionsRequired[0] is EXT_meshopt_compression");
  EXPECT_CONTAINS(needs("ACME_everything"), "ACME_everything, without which the file must not be shown");
  EXPECT_EQ(needs("KHR_materials_unlit"), "");
  builder.more = "";
  EXPECT_CONTAINS(failure(test::glb_file("{}", "", 1)), "byte 4: glTF of version 1, and 2 is read");
  EXPECT_CONTAINS(failure(changed(builder, R"("version":"2.0")", R"("version":"1.0")")), "asset.version is 1.0");
  EXPECT_CONTAINS(failure(changed(builder, R"("indices":1)", R"("indices":1,"mode":9)")), "mode is none of glTF's");
  EXPECT_CONTAINS(failure(changed(builder, R"("scenes":[{"nodes":[0]}])", R"("scenes":[{"nodes":[0]}],"scene":4)")),
                  "scene is 4, but the file has 1 scenes");
  EXPECT_EQ(parse(changed(builder, R"("scenes":[{"nodes":[0]}],)", "")).triangles.size(), 2U);  // all nodes
  EXPECT_EQ(parse(builder.glb() + "more").triangles.size(), 2U);
  EXPECT_TRUE(warned("4 bytes follow its end at byte")) << warnings();
}

TEST_F(GltfFiles, DamageIsSaidWithItsPlace) {
  const GltfBuilder builder = of_square();
  const std::string whole = builder.glb();
  EXPECT_CONTAINS(failure(whole.substr(0, 7)), "truncated: a .glb has a head of 12 bytes, but the file has 7");
  EXPECT_CONTAINS(failure(whole.substr(0, whole.size() - 5)),
                  "truncated: byte 8 says that it has " + std::to_string(whole.size()) + " bytes, but it has ");
  std::string part = whole;
  part[14] = 1;  // 65536 bytes of JSON more
  EXPECT_CONTAINS(failure(part), "truncated: the part at byte 12 is to have ");
  EXPECT_CONTAINS(failure(changed(builder, R"("buffer":0)", R"("buffer" 0)")), "m.glb: byte ");
  EXPECT_CONTAINS(failure(changed(builder, R"("count":4)", R"("count":5)")),
                  "accessors[0] needs 5 elements of 12 bytes from byte 0 of its buffer view on, which has 48 bytes");
  EXPECT_CONTAINS(failure(changed(builder, R"("count":4)", R"("count":-4)")), "count is not a whole number");
  EXPECT_CONTAINS(failure(changed(builder, R"("count":4)", R"("count":4000000000)")),
                  "accessors[0].count is 4000000000, more than the file's ");
  EXPECT_CONTAINS(failure(changed(builder, R"("byteLength":60)", R"("byteLength":64)")),
                  "buffers[0].byteLength is 64, but from byte ");
  EXPECT_CONTAINS(failure(changed(builder, R"("byteLength":48)", R"("byteLength":480)")),
                  "bufferViews[0] is bytes 0 to 480 of a buffer that has 60 bytes");
  EXPECT_CONTAINS(failure(changed(builder, R"("componentType":5126)", R"("componentType":5127)")), "is none of glTF's");
  GltfBuilder high = of_square();
  high.add(std::vector<std::uint16_t>{0, 1, 4}, "SCALAR", 1);
  high.primitives = {R"({"attributes":{"POSITION":0},"indices":2})"};
  EXPECT_CONTAINS(failure(high.glb()), "accessors[2] has at place 2 the index 4, but there are 4 vertices");
}

TEST_F(GltfFiles, ASmallFileDoesNotStandForAWorld) {
  GltfBuilder builder;
  builder.add(std::vector<float>(3 * 4000, 1), "VEC3", 3);
  builder.nodes = R"([{"children":[1)";
  std::string rest;
  for (int n = 2; n < 5000; ++n) builder.nodes += "," + std::to_string(n);
  builder.nodes += "]}";
  for (int n = 1; n < 5000; ++n) builder.nodes += R"(,{"mesh":0})";
  builder.nodes += "]";
  builder.primitives = {R"({"attributes":{"POSITION":0}})"};
  EXPECT_CONTAINS(failure(builder.glb()), "by nodes that repeat a mesh");
}

TEST_F(GltfFiles, PointsAreACloudThatUsuallyHasYUp) {
  GltfBuilder builder;
  builder.add(square, "VEC3", 3);
  builder.add(std::vector<std::uint8_t>{255, 0, 0, 255, 255, 0, 0, 255, 255, 0, 0, 255, 255, 0, 0, 255}, "VEC4", 4,
              R"(,"normalized":true)");
  builder.primitives = {R"({"attributes":{"POSITION":0,"COLOR_0":1},"mode":0})"};
  const Cloud points = cloud(builder.glb(), "named.dat");
  ASSERT_EQ(points.size(), 4U);
  EXPECT_EQ(points.colours[3], (Colour{255, 0, 0}));
  EXPECT_TRUE(points.y_up);
  EXPECT_TRUE(points.normals.empty());
}

TEST_F(GltfFiles, NormalsTurnWithTheirNodes) {
  GltfBuilder builder = of_square();
  builder.add(std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3);
  builder.primitives = {R"({"attributes":{"POSITION":0,"NORMAL":2},"indices":1})"};
  builder.nodes = R"([{"mesh":0,"rotation":[0.70710678118654757,0,0,0.70710678118654757],"scale":[5,1,1]}])";
  const Cloud points = cloud(builder.glb());
  ASSERT_EQ(points.normals.size(), 4U);
  EXPECT_LT((points.normals[1] - Eigen::Vector3f(0, -1, 0)).norm(), 1e-6F);
}

TEST_F(GltfFiles, OurOwnFilesComeBackInTheFrameThatTheyWereWrittenFrom) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}, {0, 0, 2.5}, {4, 0, 2.5}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 4, 5}, {0, 5, 1}};
  mesh.classes = {SurfaceClass::floor, SurfaceClass::floor, SurfaceClass::wall, SurfaceClass::wall};
  mesh.storeys = {0, 0, 0, 0};
  mesh.primitives = {1, 1, 7, 7};
  for (const double east : {0.0, 500000.125}) {
    mesh.origin = {east, 10 * east, 3};
    WriteMesh::run({input(mesh), {}, {}}, {{"own.glb"}}, context);
    const Mesh back = read("own.glb");
    const auto wanted = corners_of(mesh), got = corners_of(back);
    ASSERT_EQ(got.size(), 4U);
    for (std::size_t t = 0; t < 4; ++t)  // walls come before floors there
      for (std::size_t c = 0; c < 3; ++c) EXPECT_LT((got[t][c] - wanted[(t + 2) % 4][c]).norm(), 1e-4);
    EXPECT_EQ(back.vertices.size(), 6U);
    EXPECT_EQ(back.classes,
              (std::vector{SurfaceClass::wall, SurfaceClass::wall, SurfaceClass::floor, SurfaceClass::floor}));
    EXPECT_EQ(back.storeys, mesh.storeys);
    EXPECT_EQ(back.primitives, (std::vector<std::int32_t>{7, 7, 1, 1}));
    EXPECT_TRUE(back.colours.empty());
  }
  mesh.origin.setZero();
  mesh.classes.clear();
  mesh.storeys.clear();
  mesh.primitives.clear();
  for (std::uint8_t i = 0; i < 6; ++i) mesh.colours.push_back({i, static_cast<std::uint8_t>(50 * i), 255});
  Transform tilted;
  tilted.rotation = Eigen::AngleAxisd(1.3, Vector3d(1, 0.2, 0).normalized()).toRotationMatrix();
  WriteMesh::run({input(mesh), {}, input(tilted)}, {{"own.glb"}}, context);
  const Mesh back = read("own.glb");
  EXPECT_EQ(back.colours, mesh.colours);
  EXPECT_EQ(back.triangles, mesh.triangles);
  EXPECT_TRUE(back.classes.empty());
  for (std::size_t v = 0; v < 6; ++v) EXPECT_LT((back.vertices[v] - mesh.vertices[v]).norm(), 1e-5);
  ReadScan::Params params;
  params.path = {{path("own.glb")}};
  params.mesh = ReadScan::MeshUse::vertices;
  EXPECT_FALSE(ReadScan::run(params, context).cloud.y_up);
}

}  // namespace
}  // namespace atrium::io::gltf_test
