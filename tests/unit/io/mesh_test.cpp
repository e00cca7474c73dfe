#include <algorithm>
#include <cmath>

#include "files.hpp"
#include "modules/io/read_mesh.hpp"
#include "modules/io/read_scan.hpp"
#include "modules/io/write_mesh.hpp"

namespace atrium::io::mesh_test {
namespace {

class MeshFiles : public Files {
 protected:
  Mesh read(const std::string& name) { return ReadMesh::run({{path(name)}}, context).mesh; }
  Mesh parse(const std::string& name, const std::string& text) {
    file(name, text);
    return read(name);
  }
  std::string failure(const std::string& name, const std::string& text) {
    return error_of([&] { parse(name, text); });
  }
  void write(const Mesh& mesh, const std::string& name, bool binary = true) {
    WriteMesh::run({input(mesh)}, {{name}, binary}, context);
  }
};

/// A tetrahedron with a class and primitive for each face.
Mesh tetrahedron() {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1.5, 0, 0}, {0, 2.25, 0}, {0, 0, 0.1}};
  mesh.colours = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {255, 0, 128}};
  mesh.triangles = {{0, 1, 3}, {0, 2, 1}, {1, 2, 3}, {0, 3, 2}};
  mesh.classes = {SurfaceClass::wall, SurfaceClass::floor, SurfaceClass::ceiling, SurfaceClass::wall};
  mesh.primitives = {5, -1, 11, 2};
  return mesh;
}

TEST_F(MeshFiles, ObjKeepsClassesAndPrimitivesAsGroups) {
  const Mesh mesh = tetrahedron();
  write(mesh, "m.obj");
  EXPECT_CONTAINS(content("m.obj"), "mtllib m.mtl");
  EXPECT_CONTAINS(content("m.obj"), "g wall_5\nusemtl wall\n");
  EXPECT_CONTAINS(content("m.mtl"), "newmtl ceiling\nKd ");
  const Mesh back = read("m.obj");
  EXPECT_EQ(back.vertices, mesh.vertices);
  EXPECT_EQ(back.colours, mesh.colours);
  ASSERT_EQ(back.triangles.size(), 4U);
  // Sorted by class and primitive: wall 2, wall 5, floor, ceiling 11.
  EXPECT_EQ(back.triangles[0], mesh.triangles[3]);
  EXPECT_EQ(back.classes,
            (std::vector{SurfaceClass::wall, SurfaceClass::wall, SurfaceClass::floor, SurfaceClass::ceiling}));
  EXPECT_EQ(back.primitives, (std::vector<std::int32_t>{2, 5, -1, 11}));
}

TEST_F(MeshFiles, ObjReadsAllFormsOfCorners) {
  const std::string vertices = "o Cube\nmtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n";
  for (const std::string face : {"1 2 3 4", "1/1 2/1 3/1 4/1", "1//1 2//1 3//1 4//1", "1/1/1 2/1/1 3/1/1 4/1/1",
                                 "-4 -3 -2 -1", "-4//-1 -3//-1 -2//-1 -1//-1 # all of it"}) {
    const Mesh mesh = parse("f.obj", vertices + "s off\nf " + face + "\n");
    EXPECT_EQ(mesh.vertices.size(), 4U);
    EXPECT_EQ(mesh.triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}})) << face;
    EXPECT_TRUE(mesh.classes.empty());
  }
  EXPECT_CONTAINS(failure("f.obj", vertices + "f 1 2 5\n"),
                  "f.obj:9: a face's corner is vertex 5, but there are 4 vertices (1 to 4)");
  EXPECT_CONTAINS(failure("f.obj", vertices + "f 1 2 -5\n"),
                  "f.obj:9: a face's corner is vertex 0, but there are 4 vertices (1 to 4)");
  EXPECT_CONTAINS(failure("f.obj", vertices + "f 1 2 0\n"), "f.obj:9: '0' is not a face's corner");
  EXPECT_CONTAINS(failure("f.obj", vertices + "f 1 2 3//2\n"),
                  "f.obj:9: a face's corner has normal 2, but there are 1");
  EXPECT_CONTAINS(failure("f.obj", "v 0 0\n"), "f.obj:1: the line ends before its third number");
  EXPECT_CONTAINS(failure("f.obj", "v 0 0 a\n"), "f.obj:1: 'a' is not a number");
}

TEST_F(MeshFiles, ObjVerticesMayBeAPointCloudWithColoursAndNormals) {
  ReadScan::Params params;
  params.path = {{file("p.obj", "v 0 0 0 1 0 0\nvn 0 0 1\nv 1 0 0 0 1 0\nvn 0 1 0\nv 0 1 0 0 0 1\nvn 1 0 0\n")}};
  const Cloud cloud = ReadScan::run(params, context).cloud;
  EXPECT_EQ(cloud.colours, (std::vector<Colour>{{255, 0, 0}, {0, 255, 0}, {0, 0, 255}}));
  ASSERT_EQ(cloud.normals.size(), 3U);
  EXPECT_EQ(cloud.normals[1], Eigen::Vector3f(0, 1, 0));
}

TEST_F(MeshFiles, ObjPiecesAreJoinedInOrder) {
  // Several pieces of a megabyte; relative indices and a group that reach over their borders.
  std::string text = "g floor_3\n";
  constexpr int n = 40000;
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < 3; ++k) text += "v " + std::to_string(i) + " " + std::to_string(k) + " 0.5\n";
    text += "f -3 -2 -1\n";
  }
  const Mesh mesh = parse("p.obj", text);
  ASSERT_EQ(mesh.triangles.size(), static_cast<std::size_t>(n));
  bool right = true;
  for (std::uint32_t i = 0; i < n; ++i)
    right = right && mesh.triangles[i] == std::array<std::uint32_t, 3>{3 * i, 3 * i + 1, 3 * i + 2} &&
            mesh.classes[i] == SurfaceClass::floor && mesh.primitives[i] == 3 &&
            mesh.origin.x() + mesh.vertices[3 * i].x() == i;
  EXPECT_TRUE(right);
}

TEST_F(MeshFiles, StlJoinsEqualCorners) {
  for (const bool binary : {false, true}) {
    const Mesh mesh = tetrahedron();
    write(mesh, "m.stl", binary);
    const Mesh back = read("m.stl");
    EXPECT_EQ(back.vertices.size(), 4U);
    ASSERT_EQ(back.triangles.size(), 4U);
    for (std::size_t t = 0; t < 4; ++t)
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_LT((back.vertices[back.triangles[t][k]] - mesh.vertices[mesh.triangles[t][k]]).norm(), 1e-7);
  }
}

TEST_F(MeshFiles, StlNamesWhatIsWrong) {
  write(tetrahedron(), "m.stl");
  const std::string bytes = content("m.stl");
  EXPECT_CONTAINS(failure("a.stl", bytes.substr(0, bytes.size() - 1)), "truncated: 4 facets of 50 bytes");
  EXPECT_CONTAINS(failure("a.stl", bytes.substr(0, 60)), "truncated: an STL file has a head of 84 bytes");
  // Binary files that begin with "solid" are binary all the same.
  EXPECT_EQ(parse("b.stl", "solid" + bytes.substr(5)).triangles.size(), 4U);
  EXPECT_CONTAINS(failure("a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"),
                  "a.stl:4: the file ends within");
  EXPECT_CONTAINS(failure("a.stl", "solid a\n"), "without 'endsolid'");
  EXPECT_CONTAINS(failure("a.stl", "solid a\nouter loop\nvertex 0 0\n"),
                  "a.stl:3: the file ends within a facet (truncated?)");
  EXPECT_CONTAINS(failure("a.stl", "solid a\nouter loop\nvertex 0 0 0\nendloop\n"), "a.stl:4: a facet of 1 vertex");
  EXPECT_CONTAINS(failure("a.stl", "solid a\nvertex 0 0 0\n"), "a.stl:2: a vertex outside of");
  EXPECT_CONTAINS(failure("a.stl", "solid a\nedge 1 2\n"), "a.stl:2: unknown keyword 'edge'");
}

TEST_F(MeshFiles, GeoreferencedMeshesStayExactOrAreRefused) {
  Mesh mesh = tetrahedron();
  mesh.origin = {500000, 5400000, 0};
  for (const std::string name : {"u.ply", "u.obj"}) {
    write(mesh, name);
    const Mesh back = read(name);
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_LT((back.origin + back.vertices[i] - mesh.origin - mesh.vertices[i]).norm(), 1e-8) << name;
  }
  write(mesh, "u.stl", false);
  const Mesh back = read("u.stl");
  EXPECT_LT((back.origin + back.vertices[0] - mesh.origin - mesh.vertices[0]).norm(), 1e-8);
  EXPECT_CONTAINS(error_of([&] { write(mesh, "v.stl", true); }), "lose its millimetres");
  EXPECT_FALSE(std::filesystem::exists(path("v.stl")));
}

TEST_F(MeshFiles, AScanOfAMeshIsSampledOnItsFaces) {
  Mesh mesh = tetrahedron();
  mesh.origin = {500000, 5400000, 0};
  write(mesh, "m.ply");
  ReadScan::Params params;
  params.path = {{path("m.ply")}};
  EXPECT_EQ(ReadScan::run(params, context).cloud.size(), 4U);  // as many as vertices
  params.samples = 500;
  const Cloud cloud = ReadScan::run(params, context).cloud;
  ASSERT_EQ(cloud.size(), 500U);
  ASSERT_EQ(cloud.normals.size(), 500U);
  EXPECT_EQ(cloud.colours.size(), 500U);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d p = cloud.origin + cloud.points[i].cast<double>() - mesh.origin;
    // On one of the planes x = 0, y = 0, z = 0, or the slanted one.
    const double slanted = p.x() / 1.5 + p.y() / 2.25 + p.z() / 0.1 - 1.0;
    EXPECT_LT(std::min({std::abs(p.x()), std::abs(p.y()), std::abs(p.z()), 0.09 * std::abs(slanted)}), 1e-4);
  }
  params.mesh = ReadScan::MeshUse::vertices;
  EXPECT_TRUE(ReadScan::run(params, context).cloud.normals.empty());
}

TEST_F(MeshFiles, AMeshWithoutSurfaceCannotBeSampled) {
  ReadScan::Params params;
  params.path = {{file("flat.obj", "v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\n")}};
  EXPECT_CONTAINS(error_of([&] { ReadScan::run(params, context); }), "flat.obj: ");
  params.path = {{file("nan.obj", "v 0 0 0\nv 1 0 1\nv nan 2 2\nf 1 2 3\n")}};
  EXPECT_CONTAINS(error_of([&] { ReadScan::run(params, context); }), "nan.obj: ");
}

TEST_F(MeshFiles, EmptyMeshesAreValidFiles) {
  for (const std::string name : {"e.ply", "e.obj", "e.stl"}) {
    host->warnings.clear();
    write(Mesh{}, name);
    EXPECT_TRUE(warned("the mesh is empty"));
    EXPECT_TRUE(read(name).triangles.empty());
    EXPECT_TRUE(warned("has no triangles"));
  }
}

TEST_F(MeshFiles, TrianglesOnBrokenVerticesAreDropped) {
  const Mesh mesh =
      parse("n.ply",
            "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
            "element face 3\nproperty list uchar int vertex_indices\nproperty int primitive\nend_header\n"
            "0 0 0\nnan 0 0\n1 0 0\n0 1 0\n3 0 1 2 7\n3 0 2 3 8\n2 0 2 9\n");
  EXPECT_EQ(mesh.vertices.size(), 3U);
  EXPECT_EQ(mesh.triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}}));
  EXPECT_EQ(mesh.primitives, (std::vector<std::int32_t>{8}));
  EXPECT_TRUE(warned("1 of 4 vertices and 1 of 2 triangles dropped")) << warnings();
  EXPECT_TRUE(warned("1 face of fewer than three corners skipped"));
}

}  // namespace
}  // namespace atrium::io::mesh_test
