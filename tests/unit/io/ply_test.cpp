#include <algorithm>

#include "files.hpp"
#include "modules/io/decode.hpp"
#include "modules/io/read_geometry.hpp"
#include "modules/io/read_mesh.hpp"
#include "modules/io/read_scan.hpp"
#include "modules/io/write_mesh.hpp"

namespace atrium::io::ply_test {
namespace {

class Ply : public Files {
 protected:
  Cloud read(const std::string& name, ReadScan::Params params = {}) {
    params.path = {{path(name)}};
    return ReadScan::run(params, context).cloud;
  }
  std::string failure(const std::string& text) {
    file("bad.ply", text);
    return error_of([&] { read("bad.ply"); });
  }
};

const char* const three = "0 0 0\n1 0 0\n0 1 0\n";

TEST_F(Ply, ReadsTextWithColumnsInAnyOrderAndSkipsWhatItDoesNotKnow) {
  file("a.ply",
       "ply\nformat ascii 1.0\ncomment x\nobj_info y\nelement junk 2\nproperty list uchar int values\nproperty int k\n"
       "element vertex 3\nproperty uchar blue\nproperty double z\nproperty list uchar float odd\nproperty float nx\n"
       "property float y\nproperty uchar green\nproperty uchar red\nproperty float ny\nproperty float x\nproperty "
       "float nz\n"
       "property float scalar_Intensity\nproperty int label\nend_header\n"
       "2 7 8 1\n0 1\n"
       "3 9 2 0.5 0.5 0 8 2 1 0 7 2 0.25 -4\n"
       "6 10 0 3 5 5 4 0 8 4 0.5 5\n\n"
       "0 11 1 1 0 9 0 0 0 9 1 0.75 6\n");
  const Cloud cloud = read("a.ply");
  ASSERT_EQ(cloud.size(), 3U);
  EXPECT_EQ(cloud.points[0], Eigen::Vector3f(7, 8, 9));
  EXPECT_EQ(cloud.points[2], Eigen::Vector3f(9, 9, 11));
  EXPECT_EQ(cloud.colours[0], (Colour{1, 2, 3}));
  EXPECT_EQ(cloud.colours[1], (Colour{4, 5, 6}));
  EXPECT_TRUE(cloud.normals[0].isApprox(Eigen::Vector3f(0, 0, 1)));
  EXPECT_TRUE(cloud.normals[1].isApprox(Eigen::Vector3f(0.6F, 0, 0.8F))) << cloud.normals[1];
  EXPECT_EQ(cloud.intensities, (std::vector<float>{0.25F, 0.5F, 0.75F}));
  EXPECT_EQ(cloud.labels, (std::vector<std::int32_t>{-4, 5, 6}));
  EXPECT_TRUE(cloud.origin.isZero(0));
  EXPECT_TRUE(host->warnings.empty()) << warnings();
}

/// The numbers 1 … 3n in every scalar type and both byte orders, with a list before and after.
template <class T>
void check_type(const std::string& type, bool big, const std::function<std::string(const std::string&)>& write,
                const std::function<Cloud()>& read) {
  std::string bytes = std::string("ply\r\nformat binary_") + (big ? "big" : "little") +
                      "_endian 1.0\r\nelement skipped 1\r\nproperty list ushort double values\r\nelement vertex 4\r\n"
                      "property " +
                      type + " y\r\nproperty uchar pad\r\nproperty " + type + " x\r\nproperty " + type +
                      " z\r\nelement face 1\r\nproperty list uint ushort vertex_index\r\nend_header\r\n";
  put<std::uint16_t>(bytes, 2, big);
  put(bytes, 1.5, big);
  put(bytes, 2.5, big);
  for (int i = 0; i < 4; ++i) {
    put(bytes, static_cast<T>(3 * i + 1), big);
    put<std::uint8_t>(bytes, 200);
    put(bytes, static_cast<T>(3 * i), big);
    put(bytes, static_cast<T>(3 * i + 2), big);
  }
  put<std::uint32_t>(bytes, 0, big);
  write(bytes);
  const Cloud cloud = read();
  ASSERT_EQ(cloud.size(), 4U) << type;
  for (int i = 0; i < 4; ++i)
    EXPECT_EQ(cloud.points[static_cast<std::size_t>(i)], Eigen::Vector3f(3 * i, 3 * i + 1, 3 * i + 2)) << type << big;
}

TEST_F(Ply, ReadsEveryScalarTypeInBothByteOrders) {
  const auto write = [&](const std::string& bytes) { return file("t.ply", bytes); };
  const auto load_it = [&] { return read("t.ply"); };
  for (const bool big : {false, true}) {
    for (const std::string name : {"char", "int8"}) check_type<std::int8_t>(name, big, write, load_it);
    for (const std::string name : {"uchar", "uint8"}) check_type<std::uint8_t>(name, big, write, load_it);
    for (const std::string name : {"short", "int16"}) check_type<std::int16_t>(name, big, write, load_it);
    for (const std::string name : {"ushort", "uint16"}) check_type<std::uint16_t>(name, big, write, load_it);
    for (const std::string name : {"int", "int32"}) check_type<std::int32_t>(name, big, write, load_it);
    for (const std::string name : {"uint", "uint32"}) check_type<std::uint32_t>(name, big, write, load_it);
    for (const std::string name : {"float", "float32"}) check_type<float>(name, big, write, load_it);
    for (const std::string name : {"double", "float64"}) check_type<double>(name, big, write, load_it);
  }
}

TEST_F(Ply, ColoursOfSixteenBitsAndOfFloatsBecomeBytes) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
  const auto colours = [&](const std::string& type, const std::string& rows) {
    file("c.ply", head + "property " + type + " red\nproperty " + type + " green\nproperty " + type +
                      " blue\nend_header\n" + rows);
    return read("c.ply").colours;
  };
  const std::vector<Colour> wanted = {{255, 0, 51}, {0, 255, 0}, {0, 0, 255}};
  EXPECT_EQ(colours("float", "0 0 0 1 0 0.2\n1 0 0 0 1 0\n0 1 0 0 0 1\n"), wanted);
  EXPECT_EQ(colours("uchar", "0 0 0 255 0 51\n1 0 0 0 255 0\n0 1 0 0 0 255\n"), wanted);
  EXPECT_EQ(colours("ushort", "0 0 0 65535 0 13107\n1 0 0 0 65535 0\n0 1 0 0 0 65535\n"), wanted);
}

TEST_F(Ply, DropsAndCountsWhatIsNotFinite) {
  file("n.ply",
       "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\nproperty uchar "
       "red\n"
       "property uchar green\nproperty uchar blue\nend_header\n"
       "nan 0 0 1 1 1\n1 2 3 4 5 6\n0 inf 0 1 1 1\n4 5 6 7 8 9\n0 0 1e30 1 1 1\n7 8 9 1 2 3\n");
  const Cloud cloud = read("n.ply");
  ASSERT_EQ(cloud.size(), 3U);
  EXPECT_EQ(cloud.points[1], Eigen::Vector3f(4, 5, 6));
  EXPECT_EQ(cloud.colours[2], (Colour{1, 2, 3}));
  EXPECT_TRUE(warned("3 of 6 points dropped")) << warnings();
}

TEST_F(Ply, LeavesOutNormalsOfWhichSomeAreBroken) {
  file("n.ply",
       "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty float "
       "nx\n"
       "property float ny\nproperty float nz\nend_header\n0 0 0 0 0 1\n1 0 0 0 0 0\n0 1 0 nan 0 1\nnan 0 0 0 0 0\n");
  EXPECT_FALSE(read("n.ply").has_normals());
  EXPECT_TRUE(warned("normals of 2 points")) << warnings();
}

TEST_F(Ply, KeepsTheNormalsWhenOnlyDroppedPointsLackThem) {
  file(
      "n.ply",
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty float "
      "nx\n"
      "property float ny\nproperty float nz\nend_header\n0 0 0 0 0 1\nnan 0 0 nan nan nan\n1 0 0 0 3 0\n0 1 0 0 0 1\n");
  const Cloud cloud = read("n.ply");
  ASSERT_EQ(cloud.normals.size(), 3U);
  EXPECT_EQ(cloud.normals[1], Eigen::Vector3f(0, 1, 0));
}

TEST_F(Ply, KeepsGeoreferencedMillimetresAndLeavesSmallCoordinatesAlone) {
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1000\nproperty double x\nproperty double y\nproperty "
      "double z\n"
      "end_header\n";
  std::vector<Eigen::Vector3d> truth;
  for (int i = 0; i < 1000; ++i) {
    truth.emplace_back(500000 + 0.01234 * i, 5400000 - 0.00567 * i, 231.7 + 0.001 * i);
    for (int a = 0; a < 3; ++a) put(bytes, truth.back()[a]);
  }
  file("utm.ply", bytes);
  const Cloud cloud = read("utm.ply");
  EXPECT_EQ(cloud.origin.z(), 0.0);
  EXPECT_EQ(cloud.origin.x(), std::floor(cloud.origin.x()));
  double worst = 0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    worst = std::max(worst, (cloud.origin + cloud.points[i].cast<double>() - truth[i]).norm());
  EXPECT_LT(worst, 1e-4);
}

TEST_F(Ply, AStrayPointAtZeroDoesNotSpoilAGeoreferencedCloud) {
  file("utm.ply",
       "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\nend_header\n"
       "500000.001 5400000.002 2\n500003.003 5400001.004 2\n0 0 0\n500004.005 5400002.006 2\n");
  const Cloud cloud = read("utm.ply");
  const Eigen::Vector3d first = cloud.origin + cloud.points[0].cast<double>();
  EXPECT_NEAR(first.x(), 500000.001, 1e-4);
  EXPECT_NEAR(first.y(), 5400000.002, 1e-4);
}

TEST_F(Ply, HintsAtMillimetresAndScales) {
  file("mm.ply",
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
       "end_header\n0 0 0\n5400 0 2900\n0 4300 0\n");
  EXPECT_EQ(read("mm.ply").points[1].x(), 5400.0F);
  EXPECT_TRUE(warned("if these are millimetres, set unit: mm (5.4 × 4.3 × 2.9 m)")) << warnings();
  host->warnings.clear();
  ReadScan::Params params;
  params.scale = 0.001;
  EXPECT_FLOAT_EQ(read("mm.ply", params).points[1].x(), 5.4F);
  EXPECT_TRUE(host->warnings.empty()) << warnings();
}

TEST_F(Ply, TakesTheSensorFromTheCameraOrFromTheParameter) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string camera =
      "element camera 1\nproperty float view_px\nproperty float view_py\nproperty float view_pz\n";
  file("plain.ply", head + "end_header\n" + three);
  file("zero.ply", head + camera + "end_header\n" + three + "0 0 0\n");
  file("there.ply", head + camera + "end_header\n" + three + "1 2 3\n");
  EXPECT_TRUE(read("plain.ply").sensors.empty());
  EXPECT_TRUE(read("zero.ply").sensors.empty());
  ASSERT_EQ(read("there.ply").sensors.size(), 1U);
  EXPECT_EQ(read("there.ply").sensors[0], Eigen::Vector3f(1, 2, 3));
  ReadScan::Params params;
  params.sensor = ReadScan::SensorUse::origin;
  EXPECT_EQ(read("plain.ply", params).sensors.at(0), Eigen::Vector3f(0, 0, 0));
  params.sensor = ReadScan::SensorUse::none;
  EXPECT_TRUE(read("there.ply", params).sensors.empty());
}

TEST_F(Ply, NamesWhatIsWrongAndWhere) {
  const std::string head = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n";
  EXPECT_CONTAINS(failure(""), "the file is empty");
  EXPECT_CONTAINS(failure("solid"), "not a PLY file");
  EXPECT_CONTAINS(failure("ply\nformat ascii 1.0\nelement vertex -3\n"),
                  "bad.ply:3: an element needs a name and a count");
  EXPECT_CONTAINS(failure("ply\nformat ascii 1.0\nelement vertex 99999999999999999999999\n"), "bad.ply:3:");
  EXPECT_CONTAINS(failure("ply\nformat utf8 1.0\n"), "bad.ply:2: unknown format 'utf8'");
  EXPECT_CONTAINS(failure(head + "property quad z\nend_header\n"), "bad.ply:6: unknown property type 'quad'");
  EXPECT_CONTAINS(failure(head + "property float z\n"), "without 'end_header'");
  EXPECT_CONTAINS(failure(head + "property float z\nend_heder\n"), "bad.ply:7: unknown keyword 'end_heder'");
  EXPECT_CONTAINS(failure("ply\nelement vertex 3\nproperty float x\nend_header\n"), "no line 'format'");
  EXPECT_CONTAINS(failure("ply\nformat ascii 1.0\nproperty float x\n"), "bad.ply:3: a property before");
  EXPECT_CONTAINS(failure(head + "end_header\n0 0\n0 0\n0 0\n"), "no coordinates x, y, z (there are: x, y)");
  EXPECT_CONTAINS(failure("ply\nformat ascii 1.0\nelement point 3\nproperty float x\nend_header\n1\n1\n1\n"),
                  "no element 'vertex'");
  const std::string whole = head + "property float z\nend_header\n";
  EXPECT_CONTAINS(failure(whole + "0 0 0\n1 1 1\n"), "truncated: 3 lines of element 'vertex' are expected");
  EXPECT_CONTAINS(failure(whole + "0 0 0\n1 1 1\n"), "after 2 of them (line 9)");
  EXPECT_CONTAINS(failure(whole + "0 0 0\n1 one 1\n2 2 2\n"), "bad.ply:9: 'one' is not a number ('y')");
  EXPECT_CONTAINS(failure(whole + "0 0 0\n1 1\n2 2 2\n"),
                  "bad.ply:9: vertex has 3 properties, but the line ends before 'z'");
  EXPECT_CONTAINS(failure(whole + "0 0 0\n1 1 1 1\n2 2 2\n"), "bad.ply:9: vertex has 3 properties, but '1' follows");
  EXPECT_CONTAINS(failure(whole + "nan 0 0\nnan 1 1\nnan 2 2\n"), "none of the 3 points has finite coordinates");
  EXPECT_CONTAINS(failure(whole + "nan 0 0\n1 1 1\n2 2 2\n"), "only 2 of 3 points have finite");
  EXPECT_CONTAINS(
      failure("ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
              "end_header\n0 0 0\n1 1 1\n"),
      "only 2 points");
  EXPECT_CONTAINS(
      failure("ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float z\n"
              "end_header\n"),
      "no points");
  EXPECT_CONTAINS(error_of([&] { read("absent.ply"); }), "absent.ply: No such file");
  EXPECT_CONTAINS(error_of([&] { ReadMesh::run({{path(".")}}, context); }), "Is a directory");
}

TEST_F(Ply, WildCountsAndTruncationAreErrorsBeforeMemoryIsTaken) {
  const std::string head = "ply\nformat binary_little_endian 1.0\nelement vertex ";
  const std::string xyz = "\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string body(36, '\0');
  EXPECT_CONTAINS(failure(head + "18446744073709551615" + xyz + "end_header\n" + body), "truncated");
  EXPECT_CONTAINS(failure(head + "4" + xyz + "end_header\n" + body),
                  "truncated: 4 × vertex of 12 bytes are to follow byte 115, but the file has 151 bytes");
  const std::string face = "element face 1\nproperty list uint int vertex_indices\nend_header\n";
  std::string wild = head + "3" + xyz + face + body;
  put<std::uint32_t>(wild, 4000000000U);
  EXPECT_CONTAINS(failure(wild), "truncated in face 0 of 1");
  std::string outside = head + "3" + xyz + face + body;
  put<std::uint32_t>(outside, 3);
  for (const int corner : {0, 1, 3}) put(outside, corner);
  EXPECT_CONTAINS(failure(outside), "a face's corner is vertex 3, but there are 3 vertices (0 to 2)");
}

Mesh sample_mesh() {
  Mesh mesh;
  mesh.origin = {500000, 5400000, 0};
  mesh.vertices = {{0.125, 0, 0}, {1.0001, 0, 0}, {1, 1, 2.3}, {0, 1, 0}};
  mesh.colours = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {255, 0, 128}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.classes = {SurfaceClass::wall, SurfaceClass::ceiling};
  mesh.storeys = {0, -1};
  mesh.primitives = {12, -1};
  return mesh;
}

TEST_F(Ply, WritesAMeshThatIsReadBackWhole) {
  const Mesh mesh = sample_mesh();
  for (const bool binary : {false, true}) {
    WriteMesh::run({input(mesh)}, {{"out/m.ply"}, binary}, context);
    const Mesh back = decode_mesh(read_geometry(path("out/m.ply"), context), 1.0, context);
    ASSERT_EQ(back.vertices.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_EQ(Eigen::Vector3d(back.origin + back.vertices[i]), Eigen::Vector3d(mesh.origin + mesh.vertices[i]));
    EXPECT_EQ(back.colours, mesh.colours);
    EXPECT_EQ(back.triangles, mesh.triangles);
    EXPECT_EQ(back.classes, mesh.classes);
    EXPECT_EQ(back.storeys, mesh.storeys);
    EXPECT_EQ(back.primitives, mesh.primitives);
  }
}

TEST_F(Ply, WritesAnEmptyMeshWithAWarning) {
  WriteMesh::run({input(Mesh{})}, {{"e.ply"}, true}, context);
  EXPECT_TRUE(warned("the mesh is empty"));
  EXPECT_CONTAINS(content("e.ply"), "element face 0");
  EXPECT_EQ(read_geometry(path("e.ply"), context).count, 0U);
}

TEST_F(Ply, RefusesABrokenMeshAndLeavesNoFile) {
  Mesh mesh = sample_mesh();
  mesh.vertices[1].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_CONTAINS(error_of([&] { WriteMesh::run({input(mesh)}, {{"b.ply"}, true}, context); }), "vertex 1");
  mesh = sample_mesh();
  mesh.triangles[1][2] = 4;
  EXPECT_CONTAINS(error_of([&] { WriteMesh::run({input(mesh)}, {{"b.ply"}, true}, context); }), "triangle 1");
  mesh = sample_mesh();
  mesh.classes.pop_back();
  EXPECT_CONTAINS(error_of([&] { WriteMesh::run({input(mesh)}, {{"b.ply"}, true}, context); }), "'classes'");
  EXPECT_CONTAINS(error_of([&] { WriteMesh::run({input(sample_mesh())}, {{"b.fbx"}, true}, context); }), "b.fbx");
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

TEST_F(Ply, SaysWhatFloat32LostFarFromZero) {
  const auto written = [&](const std::string& type, double y) {
    std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex 9\n";
    for (const char axis : {'x', 'y', 'z'}) bytes += "property " + type + " " + axis + "\n";
    bytes += "end_header\n";
    for (int i = 0; i < 9; ++i)
      for (const double v : {500000.0 + i, y + 0.5 * i, 0.25 * i}) {
        if (type == "float")
          put(bytes, static_cast<float>(v));
        else
          put(bytes, v);
      }
    host->warnings.clear();
    file("far.ply", bytes);
    read("far.ply");
    return warnings();
  };
  EXPECT_CONTAINS(written("float", 5'400'000), "far.ply: coordinates along y are in steps of 0.5 m, as float32");
  EXPECT_CONTAINS(written("float", 0), "coordinates along x are in steps of 0.031 m");
  EXPECT_EQ(written("double", 5'400'000), "");
}

}  // namespace
}  // namespace atrium::io::ply_test
