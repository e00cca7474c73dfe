#include "files.hpp"
#include "modules/io/read_scan.hpp"
#include "modules/io/write_cloud.hpp"

namespace atrium::io {
namespace {

class CloudFiles : public Files {
 protected:
  Cloud round_trip(const Cloud& cloud, const std::string& name, bool binary) {
    WriteCloud::run({input(cloud)}, {{name}, binary}, context);
    ReadScan::Params params;
    params.path.path = path(name);
    return ReadScan::run({}, params, context).cloud;
  }
};

/// columns: bit 0 normals, 1 colours, 2 intensities, 3 labels.
Cloud sample(std::size_t n, unsigned columns, const Eigen::Vector3d& origin = Eigen::Vector3d::Zero()) {
  Cloud cloud;
  cloud.origin = origin;
  Random random(columns + 7);
  for (std::size_t i = 0; i < n; ++i) {
    cloud.points.emplace_back(random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(0, 3));
    if ((columns & 1U) != 0)
      cloud.normals.push_back(Eigen::Vector3f(random.normal(), random.normal(), random.normal()).normalized());
    if ((columns & 2U) != 0)
      cloud.colours.push_back({static_cast<std::uint8_t>(random.index(256)),
                               static_cast<std::uint8_t>(random.index(256)),
                               static_cast<std::uint8_t>(random.index(256))});
    if ((columns & 4U) != 0) cloud.intensities.push_back(static_cast<float>(random.normal() * 100));
    if ((columns & 8U) != 0) cloud.labels.push_back(static_cast<std::int32_t>(random.index(2000)) - 1000);
  }
  return cloud;
}

TEST_F(CloudFiles, EveryFormatGivesTheSameColumnsBack) {
  for (unsigned columns = 0; columns < 16; ++columns) {
    const Cloud cloud = sample(57, columns);
    for (const std::string name : {"c.ply", "c.pcd", "c.xyz", "c.txt", "c.csv"}) {
      for (const bool binary : {false, true}) {
        SCOPED_TRACE(name + (binary ? " binary " : " text ") + std::to_string(columns));
        const Cloud back = round_trip(cloud, name, binary);
        EXPECT_EQ(back.points, cloud.points);
        EXPECT_EQ(back.colours, cloud.colours);
        EXPECT_EQ(back.intensities, cloud.intensities);
        EXPECT_EQ(back.labels, cloud.labels);
        ASSERT_EQ(back.normals.size(), cloud.normals.size());
        for (std::size_t i = 0; i < cloud.normals.size(); ++i)
          EXPECT_LT((back.normals[i] - cloud.normals[i]).norm(), 1e-6F);
      }
    }
  }
  EXPECT_TRUE(host->warnings.empty()) << warnings();
}

TEST_F(CloudFiles, GeoreferencedCloudsKeepTheirMillimetres) {
  const Cloud cloud = sample(100, 0, {500000, 5400000, 0});
  for (const std::string name : {"c.ply", "c.pcd", "c.xyz", "c.csv"}) {
    for (const bool binary : {false, true}) {
      const Cloud back = round_trip(cloud, name, binary);
      double worst = 0;
      for (std::size_t i = 0; i < cloud.size(); ++i)
        worst = std::max(
            worst,
            (back.origin + back.points[i].cast<double>() - cloud.origin - cloud.points[i].cast<double>()).norm());
      EXPECT_LT(worst, 1e-5) << name;
    }
  }
}

TEST_F(CloudFiles, KeepsOneSensorAndSaysWhenItCannot) {
  Cloud cloud = sample(5, 0, {500000, 5400000, 0});
  cloud.sensors = {{1, 2, 3}};
  for (const std::string name : {"c.ply", "c.pcd"}) {
    for (const bool binary : {false, true}) {
      const Cloud back = round_trip(cloud, name, binary);
      ASSERT_EQ(back.sensors.size(), 1U) << name;
      EXPECT_TRUE((back.origin + back.sensors[0].cast<double>()).isApprox(Eigen::Vector3d(500001, 5400002, 3), 1e-12));
    }
  }
  EXPECT_TRUE(host->warnings.empty()) << warnings();
  round_trip(cloud, "c.xyz", true);
  EXPECT_TRUE(warned("places of the 1 sensors"));
}

TEST_F(CloudFiles, AnEmptyCloudIsAValidFileWithAWarning) {
  for (const std::string name : {"e.ply", "e.pcd", "e.csv"}) {
    host->warnings.clear();
    WriteCloud::run({input(Cloud{})}, {{name}, true}, context);
    EXPECT_TRUE(warned("the cloud is empty"));
    EXPECT_TRUE(std::filesystem::exists(path(name)));
  }
  EXPECT_CONTAINS(error_of([&] { WriteCloud::run({input(Cloud{})}, {{"e.las"}, true}, context); }), "e.las");
}

}  // namespace
}  // namespace atrium::io
