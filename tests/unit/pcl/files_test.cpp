#include <gtest/gtest.h>

#include "modules/io/read_scan.hpp"
#include "modules/io/write_cloud.hpp"
#include "modules/pcl/read.hpp"
#include "modules/pcl/write.hpp"
#include "tests/unit/building/writing_host.hpp"

namespace atrium::pcl_nodes::files_test {
namespace {

class PclFiles : public testing::Test {
 protected:
  Cloud read(const std::string& name) { return Read::run({{path(name)}}, context_).cloud; }
  Cloud read_ours(const std::string& name) {
    io::ReadScan::Params params;
    params.path = {{path(name)}};
    return io::ReadScan::run(params, context_).cloud;
  }
  void write(const Cloud& cloud, const std::string& name, bool binary = true, bool compressed = false) {
    Write::run({input(cloud)}, {{name}, binary, compressed}, context_);
  }
  void write_ours(const Cloud& cloud, const std::string& name, bool binary = true) {
    io::WriteCloud::run({input(cloud)}, {{name}, binary}, context_);
  }
  std::string path(const std::string& name) const { return (host_->folder / name).string(); }

  std::shared_ptr<test::WritingHost> host_ = std::make_shared<test::WritingHost>();
  Context context_{1, host_, false};
};

/// With every column that PCL's files carry.
Cloud all_columns() {
  Cloud cloud;
  for (int i = 0; i < 100; ++i) {
    cloud.points.emplace_back(0.1F * static_cast<float>(i), 1.0F / static_cast<float>(i + 1), -3);
    cloud.normals.emplace_back(0, 0.6F, 0.8F);
    cloud.colours.push_back({static_cast<std::uint8_t>(i), 20, 255});
    cloud.intensities.push_back(0.25F * static_cast<float>(i));
    cloud.labels.push_back(i % 7);
  }
  return cloud;
}

void expect_same(const Cloud& a, const Cloud& b) {
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(a.normals.size(), b.normals.size());
  EXPECT_EQ(a.colours, b.colours);
  EXPECT_EQ(a.labels, b.labels);
  EXPECT_EQ(a.intensities, b.intensities);
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Eigen::Vector3d gap = a.origin + a.points[i].cast<double>() - b.origin - b.points[i].cast<double>();
    EXPECT_LT(gap.norm(), 1e-6);
    if (a.has_normals() && b.has_normals()) {
      EXPECT_LT((a.normals[i] - b.normals[i]).norm(), 1e-6F);
    }
  }
}

TEST_F(PclFiles, WhatPclWritesBothReadersRead) {
  for (const std::string name : {"binary.pcd", "text.pcd", "packed.pcd", "binary.ply", "text.ply"}) {
    SCOPED_TRACE(name);
    write(all_columns(), name, name.substr(0, 4) != "text", name == "packed.pcd");
    expect_same(read(name), all_columns());
    expect_same(read_ours(name), all_columns());
  }
}

TEST_F(PclFiles, WhatOursWritesPclReads) {
  for (const std::string name : {"binary.pcd", "text.pcd"}) {
    SCOPED_TRACE(name);
    write_ours(all_columns(), name, name != "text.pcd");
    expect_same(read(name), all_columns());
  }
  Cloud plain = all_columns();
  plain.colours.clear();
  plain.labels.clear();
  plain.intensities.clear();
  write_ours(plain, "plain.ply");
  expect_same(read("plain.ply"), plain);
}

TEST_F(PclFiles, DoublesFarFromZeroAreRead) {
  Cloud cloud;
  cloud.origin = {500000, 5400000, 100};
  cloud.points = {{0.001F, 0, 0}, {0.002F, 0, 0}, {1, 2, 3}};
  write_ours(cloud, "far.pcd");
  const Cloud back = read("far.pcd");
  EXPECT_NEAR(back.origin.y(), 5400000, 10);
  expect_same(back, cloud);
}

TEST_F(PclFiles, RoundingOfPclsFloatsIsSaid) {
  Cloud cloud;
  cloud.origin = {500000, 5400000, 100};
  cloud.points = {{0.1F, 0.1F, 0}, {1, 2, 3}};
  write(cloud, "far.pcd");
  ASSERT_EQ(host_->warnings.size(), 1U);
  EXPECT_NE(host_->warnings[0].find("moved by up to 0.1"), std::string::npos) << host_->warnings[0];
}

TEST_F(PclFiles, ScannersPlaceIsPcdsViewpoint) {
  test::write_text(path("seen.pcd"),
                   "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 1\n"
                   "VIEWPOINT 1 2 3 1 0 0 0\nPOINTS 2\nDATA ascii\n0 0 0\nnan 1 1\n");
  const Cloud cloud = read("seen.pcd");
  ASSERT_EQ(cloud.sensors.size(), 1U);
  EXPECT_EQ(cloud.sensors[0], Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(cloud.size(), 1U);  // a point that is not finite is left out
  ASSERT_EQ(host_->warnings.size(), 1U);
  EXPECT_EQ(host_->warnings[0], "1 of 2 points are not finite: left out");
}

TEST_F(PclFiles, AFileWithoutPointsIsAnEmptyCloud) {
  test::write_text(path("empty.pcd"),
                   "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 0\nHEIGHT 1\n"
                   "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 0\nDATA ascii\n");
  EXPECT_EQ(read("empty.pcd").size(), 0U);
}

TEST_F(PclFiles, BadFilesAreErrors) {
  test::write_text(path("broken.pcd"), "no header\n");
  test::write_text(path("broken.ply"), "no header\n");
  test::write_text(path("no_z.pcd"),
                   "VERSION .7\nFIELDS x y\nSIZE 4 4\nTYPE F F\nCOUNT 1 1\nWIDTH 1\nHEIGHT 1\n"
                   "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 1\nDATA ascii\n0 0\n");
  for (const std::string name : {"broken.pcd", "broken.ply", "no_z.pcd", "lacking.pcd", "cloud.las"})
    EXPECT_THROW(read(name), Error) << name;
}

TEST_F(PclFiles, WhatCannotBeWrittenIsAnErrorAndLeavesNoFile) {
  EXPECT_THROW(write(all_columns(), "cloud.las"), Error);
  EXPECT_THROW(write(all_columns(), "cloud.ply", true, true), Error);
  EXPECT_THROW(write(all_columns(), "cloud.pcd", false, true), Error);
  EXPECT_THROW(write(Cloud{}, "cloud.pcd"), Error);
  EXPECT_TRUE(std::filesystem::is_empty(host_->folder.path()));
}

}  // namespace
}  // namespace atrium::pcl_nodes::files_test
