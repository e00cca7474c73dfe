// Numbers that must not become others without a word: decimal commas, comments, ranges of colours, columns without
// names, what is lacking; and faces that are not convex.
#include "modules/io/read_vg.hpp"
#include "text_files.hpp"

namespace atrium::io::odd_numbers_test {
namespace {

class OddNumbers : public TextFiles {
 protected:
  std::string scan_failure(const std::string& name, const std::string& text) {
    return error_of([&] { scan(name, text); });
  }
  std::string mesh_failure(const std::string& name, const std::string& text) {
    return error_of([&] { mesh(name, text); });
  }
  static std::string ply(const std::string& properties, const std::string& rows, int count) {
    return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(count) +
           "\nproperty float x\nproperty float y\nproperty float z\n" + properties + "end_header\n" + rows;
  }
};

double area_of(const Mesh& mesh) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    area += (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]).norm() / 2;
  return area;
}

TEST_F(OddNumbers, ADecimalCommaIsNamedWhereItIsNotRead) {
  const std::string wanted = "decimals follow a point";
  EXPECT_CONTAINS(mesh_failure("a.obj", "v 1,5 2,5 3,5\nv 4,5 0,5 0,5\nv 0,5 1,5 0,5\nf 1 2 3\n"), wanted);
  EXPECT_CONTAINS(mesh_failure("b.obj", "v 0,5 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), wanted);
  EXPECT_CONTAINS(scan_failure("a.ply", ply("", "0,5 0 0\n1 0 0\n0 1 0\n", 3)), wanted);
  EXPECT_CONTAINS(scan_failure("a.pcd",
                               "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 3\nHEIGHT 1\n"
                               "POINTS 3\nDATA ascii\n0 0 0\n1 0,5 0\n0 1 0\n"),
                  wanted);
  EXPECT_CONTAINS(mesh_failure("a.stl",
                               "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1,5 0 0\nvertex 0 1 0\n"
                               "endloop\nendfacet\nendsolid\n"),
                  wanted);
}

TEST_F(OddNumbers, ACommentBehindNumbersIsNoNumber) {
  EXPECT_CONTAINS(mesh_failure("a.obj", "v 0 0 0\nv 1 0 0#b\nv 0 1 0\nf 1 2 3\n"), "'0#b' is not a number");
  EXPECT_CONTAINS(scan_failure("a.xyz", "1 2 3\n4 5 6#c\n7 8 9\n1 1 1\n"), "'6#c' is not a number");
  EXPECT_EQ(scan("b.xyz", "1 2 3 # the first\n4 5 6\n7 8 9 # c\n").size(), 3U);
  EXPECT_EQ(scan("b.pts", "3 # points\n1 2 3 # a\n4 5 6\n7 8 9\n").size(), 3U);
  const Cloud cloud = scan("c.xyz", "1 2 3\n4 5 6\n7 8 9\n1.#QNAN -1.#IND 1.#INF\n");
  EXPECT_EQ(cloud.size(), 3U);
}

TEST_F(OddNumbers, FloatColoursAboveOneAreCut) {
  const std::string floats = "property float red\nproperty float green\nproperty float blue\n";
  std::string rows;
  for (int i = 0; i < 299; ++i) rows += std::to_string(i) + " 0 0 1 0 0\n";
  const Cloud labels = scan("a.ply", ply(floats, rows + "0 1 1 1.0000001 0 0\n", 300));
  EXPECT_EQ(labels.colours[0], (Colour{255, 0, 0}));
  EXPECT_EQ(labels.colours[299], (Colour{255, 0, 0}));
  const Cloud bright = scan("b.ply", ply(floats, "1 2 3 0.5 0.5 0.5\n2 2 3 2.5 0.5 0.5\n3 2 3 2.5 0 0\n", 3));
  EXPECT_EQ(bright.colours[0], (Colour{128, 128, 128}));
  EXPECT_EQ(bright.colours[1], (Colour{255, 128, 128}));
  EXPECT_CONTAINS(warnings(), "they are cut to it");
}

TEST_F(OddNumbers, TheTypeInTheHeaderSaysWhatColoursAre) {
  const std::string bytes = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  const Cloud cloud = scan("a.ply", ply(bytes, "1 2 3 1 1 0\n4 5 6 1 0 0\n7 8 9 0 0 1\n", 3));
  EXPECT_EQ(cloud.colours[0], (Colour{1, 1, 0}));
  const Cloud pcd = scan("a.pcd",
                         "VERSION .7\nFIELDS x y z r g b\nSIZE 4 4 4 1 1 1\nTYPE F F F U U U\nCOUNT 1 1 1 1 1 1\n"
                         "WIDTH 3\nHEIGHT 1\nPOINTS 3\nDATA ascii\n0 0 0 1 1 0\n1 0 0 1 0 0\n0 1 0 0 0 1\n");
  EXPECT_EQ(pcd.colours[0], (Colour{1, 1, 0}));
}

TEST_F(OddNumbers, ColumnsWithoutNamesAreTakenForWhatTheyCanBe) {
  const Cloud behind = scan("a.xyz", "1 2 3 10 20 30 0.5\n4 5 6 30 40 50 0.7\n5 6 7 1 2 3 0.3\n");
  EXPECT_EQ(behind.colours[0], (Colour{10, 20, 30}));
  EXPECT_FLOAT_EQ(behind.intensities[0], 0.5F);
  EXPECT_CONTAINS(warnings(), "columns without names");
  const Cloud before = scan("b.xyz", "1 2 3 0.5 10 20 30\n4 5 6 0.7 30 40 50\n5 6 7 0.3 1 2 3\n");
  EXPECT_EQ(before.colours[0], (Colour{10, 20, 30}));
  EXPECT_CONTAINS(scan_failure("c.xyz", "1 2 3 500 20 30 0.5\n4 5 6 30 40 50 0.7\n5 6 7 1 2 3 700\n"),
                  "7 columns without names");
  const Cloud turned = scan("d.xyz", "1 2 3 255 0 0 0 0 1 0.5\n4 5 6 0 255 0 0 1 0 0.5\n7 8 9 1 2 3 1 0 0 0.7\n");
  EXPECT_EQ(turned.colours[0], (Colour{255, 0, 0}));
  EXPECT_EQ(turned.normals[1], Eigen::Vector3f(0, 1, 0));
  EXPECT_FLOAT_EQ(turned.intensities[2], 0.7F);
  EXPECT_CONTAINS(scan_failure("e.xyz", "1 2 3 4 5 6 7 8 9 10\n1 2 3 4 5 6 7 8 9 11\n1 2 3 4 5 6 7 8 9 12\n"),
                  "10 columns without names");
  EXPECT_EQ(scan("f.xyzn", "1 2 3 2 0 0\n4 5 6 0 2 0\n7 8 9 0 0 2\n").normals[1], Eigen::Vector3f(0, 1, 0));
  EXPECT_EQ(scan("f.xyzrgb", "1 2 3 1 0 0\n4 5 6 0 1 0\n7 8 9 0 0 1\n").colours[1], (Colour{0, 255, 0}));
}

TEST_F(OddNumbers, WhatIsLackingIsCounted) {
  const Cloud cloud = scan("a.csv", "x,y,z,r,g,b,i\n1,2,3,,,,\n4,5,6,10,20,30,7\n7,8,9,-5,5,6,nan\n");
  EXPECT_EQ(cloud.colours[0], (Colour{0, 0, 0}));
  EXPECT_CONTAINS(warnings(), "4 of the colours' values are empty, not finite or negative");
  EXPECT_CONTAINS(warnings(), "2 intensities are empty or not finite");
  scan("b.csv", "x,y,z,label\n1,2,3,1.5\n4,5,6,99999999999\n7,8,9,3\n");
  EXPECT_CONTAINS(warnings(), "2 labels are no whole numbers");
}

TEST_F(OddNumbers, QuotedFieldsAndSurveyorsNamesAreRead) {
  const Cloud quoted = scan("a.csv", "name,x,y,z\n\"a,b\",1,2,3\n\"c\",4,5,6\n\"d,,e\",7,8,9\n");
  ASSERT_EQ(quoted.size(), 3U);
  EXPECT_EQ(quoted.points[2], Eigen::Vector3f(7, 8, 9));
  const Cloud places = scan("b.csv", "point,northing,easting,elevation\n1,20,10,3\n2,21,12,4\n3,22,13,5\n");
  EXPECT_EQ(places.points[1], Eigen::Vector3f(12, 21, 4));
  const Cloud own = scan("c.csv", "x,y,z,height\n1,2,3,9\n4,5,6,9\n7,8,9,9\n");
  EXPECT_EQ(own.points[0], Eigen::Vector3f(1, 2, 3));
}

TEST_F(OddNumbers, FacesThatAreNotConvexKeepTheirArea) {
  const std::string corners = "v 4 0 0\nv 1 1 0\nv 0 4 0\nv 0 0 0\n";
  EXPECT_NEAR(area_of(mesh("a.obj", corners + "f 1 2 3 4\n")), 4, 1e-9);
  EXPECT_NEAR(area_of(mesh("b.obj", corners + "f 4 3 2 1\n")), 4, 1e-9);
  EXPECT_NEAR(area_of(mesh("c.obj", corners + "f +1 +2 +3\nf 1 2 3 4\n")), 8, 1e-9);
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n";
  EXPECT_NEAR(area_of(mesh("a.ply", head + "4 0 0\n1 1 0\n0 4 0\n0 0 0\n4 0 1 2 3\n")), 4, 1e-9);
  EXPECT_NEAR(area_of(mesh("d.obj", "v 8 0 0 2\nv 2 2 0 2\nv 0 8 0 2\nv 0 0 0 2\nf 1 2 3 4\n")), 4, 1e-9);
}

TEST_F(OddNumbers, APlaneFileMustNameWhatFollows) {
  const std::string head = "num_points:3\n0 0 0\n1 0 0\n0 1 0\n";
  const std::string rest =
      "num_normals: 0\nnum_groups: 1\ngroup_type: 0\nnum_group_parameters: 4\ngroup_parameters: 0 0 1 0\n"
      "group_label: a\ngroup_color: 1 0 0\ngroup_num_point: 3\n0 1 2\nnum_children: 0\n";
  EXPECT_EQ(ReadVg::run({{file("a.vg", head + "num_colors: 0\n" + rest)}}, context).planes.primitives.size(), 1U);
  EXPECT_CONTAINS(error_of([&] { ReadVg::run({{file("b.vg", head + rest)}}, context); }), "'num_colors:' is missing");
}

TEST_F(OddNumbers, PlaneFilesAreReadWithAnyLineEndsAndAMarkInFront) {
  const std::string plain =
      "num_points: 3\n0 0 0\n1 0 0\n0 1 0\nnum_colors: 0\nnum_normals: 0\nnum_groups: 1\ngroup_type: 0\n"
      "num_group_parameters: 4\ngroup_parameters: 0 0 1 0\ngroup_label: a\ngroup_color: 1 0 0\ngroup_num_point: 3\n"
      "0 1 2\nnum_children: 0\n";
  const auto with_ends = [&](const std::string& end) {
    std::string text;
    for (const char c : plain) text += c == '\n' ? end : std::string(1, c);
    return text;
  };
  for (const std::string& text : {with_ends("\r\n"), with_ends("\r"), with_ends(" \t\n"), "\xEF\xBB\xBF" + plain})
    EXPECT_EQ(ReadVg::run({{file("a.vg", text)}}, context).planes.primitives.size(), 1U);
}

TEST_F(OddNumbers, StlInOneLineIsRead) {
  EXPECT_EQ(mesh("a.stl",
                 "solid one facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet "
                 "endsolid one")
                .triangles.size(),
            1U);
}

TEST_F(OddNumbers, AnIndexOutOfRangeIsSaidPlainly) {
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n";
  const std::string message = mesh_failure("a.ply", text);
  EXPECT_CONTAINS(message, "a.ply:13: a face's corner is vertex 3");
  EXPECT_EQ(message.find("lines are counted"), std::string::npos) << message;
}

}  // namespace
}  // namespace atrium::io::odd_numbers_test
