// Clouds as GLB files, which viewers open.
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "files.hpp"
#include "modules/io/read_scan.hpp"
#include "modules/io/write_cloud.hpp"
#include "tests/support/lacking.hpp"
#include "tests/support/process.hpp"

namespace atrium::io::cloud_glb_test {
namespace {

using nlohmann::json;

Cloud coloured(std::size_t n, const Eigen::Vector3d& origin = Eigen::Vector3d::Zero()) {
  Cloud cloud;
  cloud.origin = origin;
  Random random(5);
  for (std::size_t i = 0; i < n; ++i) {
    cloud.points.emplace_back(random.uniform(-60, 60), random.uniform(-20, 20), random.uniform(0, 6));
    cloud.colours.push_back({static_cast<std::uint8_t>(random.index(256)), static_cast<std::uint8_t>(i % 256),
                             static_cast<std::uint8_t>(random.index(40))});
  }
  return cloud;
}

class CloudGlb : public Files {
 protected:
  void write(const Cloud& cloud, const std::string& name, std::int64_t most = 0) {
    WriteCloud::Params params;
    params.path = {name};
    params.max_points = most;
    WriteCloud::run({input(cloud)}, params, context);
  }
  Cloud read(const std::string& name) {
    ReadScan::Params params;
    params.path = {{path(name)}};
    return ReadScan::run(params, context).cloud;
  }
  json description(const std::string& name) const {
    const std::string bytes = content(name);
    std::uint32_t size = 0;
    std::memcpy(&size, bytes.data() + 12, 4);
    return json::parse(bytes.substr(20, size));
  }
};

/// Points come back tile by tile: each of these has one there within `reach`, of its colour.
void expect_same(const Cloud& expected, const Cloud& found, double reach) {
  ASSERT_EQ(found.size(), expected.size());
  ASSERT_EQ(found.colours.size(), expected.colours.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const Eigen::Vector3d at = expected.origin + expected.points[i].cast<double>();
    double least = 1;
    std::size_t nearest = 0;
    for (std::size_t j = 0; j < found.size(); ++j) {
      const double d = (found.origin + found.points[j].cast<double>() - at).cwiseAbs().maxCoeff();
      if (d < least) nearest = j;
      least = std::min(least, d);
    }
    ASSERT_LT(least, reach) << i;
    if (!expected.colours.empty()) {
      EXPECT_EQ(found.colours[nearest], expected.colours[i]) << i;
    }
  }
}

TEST_F(CloudGlb, KeepsPlacesToAMillimetreAndColoursToTheBit) {
  for (const Eigen::Vector3d& origin : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(500000.25, 5400000.5, 300)}) {
    const Cloud cloud = coloured(700, origin);
    write(cloud, "c.glb");
    expect_same(cloud, read("c.glb"), 0.0006);
    EXPECT_GT(description("c.glb")["nodes"].size(), 1U) << "tiles";
  }
}

TEST_F(CloudGlb, StandsUprightWhereTheScanHasAnotherAxisUp) {
  Cloud cloud;
  for (int i = 0; i <= 30; ++i) {  // y up
    const float t = static_cast<float>(i);
    cloud.points.emplace_back(t / 30, t / 6, t / 15);
  }
  Transform to_upright;
  to_upright.rotation << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  WriteCloud::Params params;
  params.path = {"c.glb"};
  WriteCloud::run({input(cloud), input(to_upright)}, params, context);
  const json node = description("c.glb")["nodes"][0];
  EXPECT_EQ(node["scale"][1], 65.535) << "whole millimetres";
  EXPECT_EQ(description("c.glb")["accessors"][0]["max"], json({1000, 5000, 2000})) << "glTF's y is up";
  expect_same(cloud, read("c.glb"), 0.0006);
}

TEST_F(CloudGlb, WritesAtMostSoManyPoints) {
  const Cloud cloud = coloured(1000);
  write(cloud, "c.glb", 300);
  const Cloud few = read("c.glb");
  EXPECT_EQ(few.size(), 300U);
  write(cloud, "c.ply", 300);
  const Cloud other = read("c.ply");
  ASSERT_EQ(other.size(), 300U);
  EXPECT_EQ(other.points[3], cloud.points[10]) << "evenly";
  EXPECT_EQ(other.colours[299], cloud.colours[996]);
  write(cloud, "all.ply", 1000);
  EXPECT_EQ(read("all.ply").size(), 1000U);
}

TEST_F(CloudGlb, OfACloudWithoutColoursShowsIntensitiesAsGreys) {
  Cloud cloud;
  for (int i = 0; i < 100; ++i) {
    cloud.points.emplace_back(0.1F * static_cast<float>(i), 0.5F, 1);
    cloud.intensities.push_back(1000.0F * static_cast<float>(i));
  }
  cloud.intensities[7] = std::numeric_limits<float>::quiet_NaN();
  write(cloud, "c.glb");
  const Cloud found = read("c.glb");
  ASSERT_EQ(found.colours.size(), 100U);
  EXPECT_EQ(found.colours[0][0], found.colours[0][2]);
  EXPECT_LT(found.colours[0][0], found.colours[50][0]);
  EXPECT_LT(found.colours[50][0], found.colours[99][0]);
  cloud.intensities.clear();
  write(cloud, "plain.glb");
  EXPECT_TRUE(read("plain.glb").colours.empty());
}

TEST_F(CloudGlb, RefusesNumbersThatAreNotFiniteAndLeavesNoFile) {
  Cloud cloud = coloured(10);
  cloud.points[3].y() = std::numeric_limits<float>::quiet_NaN();
  try {
    write(cloud, "c.glb");
    FAIL() << "NaN was written";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "point 3 of the cloud is not finite");
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

TEST_F(CloudGlb, OfWildPointsHasFewTiles) {
  Cloud cloud = coloured(20);
  for (int i = 0; i < 3000; ++i) {
    cloud.points.emplace_back(100.0F * static_cast<float>(i), 7, 1);
    cloud.colours.push_back({1, 2, 3});
  }
  write(cloud, "c.glb");
  EXPECT_LE(description("c.glb")["nodes"].size(), 512U);
  EXPECT_EQ(read("c.glb").size(), 3020U);
}

TEST_F(CloudGlb, WithoutPointsIsAValidFileWithAWarning) {
  write(Cloud{}, "c.glb");
  ASSERT_EQ(host->warnings.size(), 1U);
  EXPECT_NE(host->warnings[0].find("c.glb has no points"), std::string::npos);
  EXPECT_FALSE(description("c.glb").contains("nodes"));
}

TEST_F(CloudGlb, IsValidByKhronosValidator) {
  write(coloured(500), "c.glb");
  write(Cloud{}, "empty.glb");
  Cloud one;
  one.points = {{1, 2, 3}};
  write(one, "one.glb");
  const auto build = std::filesystem::path(ATRIUM_PROGRAM).parent_path().parent_path();
  std::vector<std::string> command{ATRIUM_SOURCE_DIR "/tests/validate-glb", build / "tests/gltf-validator"};
  for (const std::string name : {"c", "empty", "one"}) command.push_back(path(name + ".glb"));
  const auto result = test::run_process(command);
  if (result.exit_code == 77) ATRIUM_SKIP_LACKING("the glTF validator cannot be had: " << result.err);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::istringstream lines(result.out);
  int reports = 0;
  for (std::string line; std::getline(lines, line); ++reports) {
    const json issues = json::parse(line)["issues"];
    EXPECT_EQ(issues["numErrors"], 0) << line;
    EXPECT_EQ(issues["numWarnings"], 0) << line;
  }
  EXPECT_EQ(reports, 3);
}

}  // namespace
}  // namespace atrium::io::cloud_glb_test
