// Several files as one scan.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "files.hpp"
#include "modules/io/read_scan.hpp"
#include "modules/io/write_cloud.hpp"
#include "modules/io/write_mesh.hpp"

namespace atrium::io::several_test {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

class Several : public Files {
 protected:
  Cloud read(const std::vector<std::string>& names, double voxel = 0) {
    ReadScan::Params params;
    for (const auto& name : names) params.path.push_back({path(name)});
    params.voxel = voxel;
    return ReadScan::run(params, context).cloud;
  }
  std::string failure(const std::vector<std::string>& names) {
    return error_of([&] { read(names); });
  }
  void write(const Cloud& cloud, const std::string& name) {
    std::filesystem::create_directories((folder / name).parent_path());
    WriteCloud::run({input(cloud)}, {{name}, true}, context);
  }
};

/// Points of a station: a grid that begins at its place.
Cloud station(double east, std::size_t points = 20, bool coloured = true) {
  Cloud cloud;
  cloud.origin = {east, 5400000, 100};
  for (std::size_t i = 0; i < points; ++i) {
    cloud.points.emplace_back(0.125F * static_cast<float>(i % 5), 0.25F * static_cast<float>(i / 5), 0.5F);
    if (coloured) cloud.colours.push_back({static_cast<std::uint8_t>(i), 1, 2});
  }
  cloud.sensors = {{0.5F, 0.5F, 1.5F}};
  return cloud;
}

TEST_F(Several, PosesOriginsAndPlacesComeTogetherInDouble) {
  write(station(500000.25), "a.e57");
  write(station(500003.25, 30), "b.e57");
  const Cloud both = read({"a.e57", "b.e57"});
  ASSERT_EQ(both.size(), 50U);
  ASSERT_EQ(both.sensors.size(), 2U);
  ASSERT_EQ(both.colours.size(), 50U);
  EXPECT_EQ(both.source.front(), 0);
  EXPECT_EQ(both.source.back(), 1);
  for (std::size_t i = 0; i < 50; ++i) {
    const Cloud part = station(i < 20 ? 500000.25 : 500003.25, 30);
    const std::size_t k = i < 20 ? i : i - 20;
    EXPECT_LT((both.origin + both.points[i].cast<double>() - part.origin - part.points[k].cast<double>()).norm(), 1e-4);
    EXPECT_LT(
        (both.origin + both.sensors[both.source[i]].cast<double>() - part.origin - Vector3d(0.5, 0.5, 1.5)).norm(),
        1e-4);
    EXPECT_EQ(both.colours[i][0], k);
  }
  EXPECT_TRUE(host->warnings.empty()) << warnings();
}

TEST_F(Several, FormatsMixAndColumnsThatSomeLackAreLeftOut) {
  write(station(0), "a.e57");
  write(station(3, 20, false), "b.las");
  file("c.xyz", "1 5400000 100\n2 5400000 100\n3 5400000 100.5\n");
  const Cloud all = read({"a.e57", "b.las", "c.xyz"});
  EXPECT_EQ(all.size(), 43U);
  EXPECT_TRUE(all.colours.empty());
  EXPECT_TRUE(all.sensors.empty());
  EXPECT_TRUE(all.source.empty());
  EXPECT_TRUE(warned("2 of 3 files have no colours: they are left out")) << warnings();
  EXPECT_TRUE(warned("2 of 3 files do not say where their scanner stood")) << warnings();
}

TEST_F(Several, ThinningJoinsPointsOfAllFiles) {
  write(station(0), "a.e57");
  write(station(0), "b.e57");
  EXPECT_EQ(read({"a.e57"}, 0.01).size(), 20U);
  EXPECT_EQ(read({"a.e57", "b.e57"}, 0.01).size(), 20U);
}

TEST_F(Several, DigitsThatOneFileLostAreTold) {
  const auto write_at = [&]<class T>(const std::string& name, const std::string& type, T y) {
    std::string text = "ply\nformat binary_little_endian 1.0\nelement vertex 3\n";
    for (const char axis : {'x', 'y', 'z'}) text += fmt::format("property {} {}\n", type, axis);
    text += "end_header\n";
    for (const T number : {T{0}, y, T{0}, T{1}, y, T{0}, T{0}, y, T{1}})
      text.append(reinterpret_cast<const char*>(&number), sizeof(T));
    file(name, text);
  };
  write_at("a.ply", "double", 5.4e6);
  write_at("b.ply", "double", 5.4e6);
  read({"a.ply", "b.ply"});
  EXPECT_FALSE(warned("as float32 is so far from zero"));
  write_at("b.ply", "float", 5.4e6F);
  read({"a.ply", "b.ply"});
  EXPECT_TRUE(warned("coordinates along y are in steps of 0.5 m, as float32")) << warnings();
}

TEST_F(Several, AFolderIsTheScansInIt) {
  write(station(3), "stations/b.e57");
  write(station(0), "stations/a.las");
  file("stations/c.fls", "of a maker");
  file("stations/notes.txt", "Scanned on a Tuesday, 3 stations.\n");
  file("stations/photo.jpg", "\xFF\xD8\xFF");
  file("stations/nothing.xyz", "");
  file("stations/.hidden.xyz", "broken");
  file("stations/points.txt", "0 5400000 100\n1 5400000 100\n0 5400001 101\n");
  std::filesystem::create_directories(folder / "stations/more");
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  WriteMesh::run({input(mesh), {}, {}}, {{"stations/model.ply"}}, context);
  const Cloud all = read({"stations"});
  EXPECT_EQ(all.size(), 43U);
  const std::string said = warnings();
  for (const std::string part :
       {"passed over: ", "c.fls (a scan of FARO: export it as E57 from FARO SCENE)", "notes.txt (no rows of numbers)",
        "photo.jpg (of another format)", "nothing.xyz (empty)", "more (a folder)", "model.ply (a mesh)"})
    EXPECT_CONTAINS(said, part);
  EXPECT_EQ(said.find("hidden"), std::string::npos);
}

TEST_F(Several, WhatCannotBeJoinedIsAnErrorThatNamesTheFile) {
  std::filesystem::create_directories(folder / "bare");
  EXPECT_CONTAINS(failure({"bare"}), "bare: no file in this folder is a scan: it is empty");
  file("bare/photo.jpg", "x");
  EXPECT_CONTAINS(failure({"bare"}), "there are: photo.jpg (of another format)");
  EXPECT_CONTAINS(failure({}), "no scan is given");
  write(station(0), "a.e57");
  EXPECT_CONTAINS(failure({"a.e57", "a.e57"}), "a.e57: this file is given twice");
  EXPECT_CONTAINS(failure({"a.e57", "lost.e57"}), "lost.e57");
  const std::string whole = content("a.e57");
  std::filesystem::create_directories(folder / "cut");
  file("cut/a.e57", whole);
  file("cut/b.e57", whole.substr(0, 1500));  // a scan that is damaged is not passed over
  EXPECT_CONTAINS(failure({"cut"}), "cut/b.e57");
  file("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_CONTAINS(failure({"a.e57", "m.obj"}), "m.obj: it has faces");
  Cloud here = station(0), there = station(3);
  here.crs = "EPSG:25832";
  there.crs = "EPSG:25833";
  write(here, "here.las");
  write(there, "there.las");
  EXPECT_CONTAINS(failure({"here.las", "there.las"}),
                  "there.las is in another reference system than here.las: 'EPSG:25833', not 'EPSG:25832'");
  EXPECT_EQ(read({"here.las"}).crs, "EPSG:25832");
  read({"here.las", "a.e57"});
  EXPECT_TRUE(warned("here.las names a reference system and a.e57 does not")) << warnings();
}

TEST_F(Several, ViewpointsOfDepthImagesAreTheirSensors) {
  const auto pcd = [](const std::string& viewpoint) {
    return "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 3\nHEIGHT "
           "1\nVIEWPOINT " +
           viewpoint + " 1 0 0 0\nPOINTS 3\nDATA ascii\n0 0 0\n1 0 0\n0 1 0\n";
  };
  file("a.pcd", pcd("1 2 3"));
  file("b.pcd", pcd("4 5 6"));
  const Cloud both = read({"a.pcd", "b.pcd"});
  ASSERT_EQ(both.sensors.size(), 2U);
  EXPECT_EQ(both.sensors[1], Vector3f(4, 5, 6));
  EXPECT_EQ(both.source, (std::vector<std::uint16_t>{0, 0, 0, 1, 1, 1}));
}

}  // namespace
}  // namespace atrium::io::several_test
