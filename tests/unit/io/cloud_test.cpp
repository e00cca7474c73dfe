#include "files.hpp"
#include "modules/io/read_scan.hpp"
#include "modules/io/write_cloud.hpp"

namespace atrium::io::cloud_test {
namespace {

class CloudFiles : public Files {
 protected:
  Cloud round_trip(const Cloud& cloud, const std::string& name, bool binary) {
    WriteCloud::run({input(cloud)}, {{name}, binary}, context);
    ReadScan::Params params;
    params.path = {{path(name)}};
    return ReadScan::run(params, context).cloud;
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
    for (const std::string name : {"c.ply", "c.pcd", "c.e57", "c.xyz", "c.txt", "c.csv"}) {
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
  for (const std::string name : {"c.ply", "c.pcd", "c.e57", "c.xyz", "c.csv"}) {
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
  for (const std::string name : {"c.ply", "c.pcd", "c.e57"}) {
    for (const bool binary : {false, true}) {
      const Cloud back = round_trip(cloud, name, binary);
      ASSERT_EQ(back.sensors.size(), 1U) << name;
      EXPECT_TRUE((back.origin + back.sensors[0].cast<double>()).isApprox(Eigen::Vector3d(500001, 5400002, 3), 1e-12));
    }
  }
  EXPECT_TRUE(host->warnings.empty()) << warnings();
  round_trip(cloud, "c.xyz", true);
  EXPECT_TRUE(warned("places of 1 sensor are"));
}

TEST_F(CloudFiles, PlyKeepsWhereEachPointWasSeenFrom) {
  Cloud cloud = sample(40, 2, {500000, 5400000, 0});
  cloud.sensors = {{1, 2, 3}, {-4, 5, 1.5}, {0, 0.25, 1}};
  for (std::size_t i = 0; i < cloud.size(); ++i) cloud.source.push_back(static_cast<std::uint16_t>(i * 7 % 3));
  for (const bool binary : {false, true}) {
    const Cloud back = round_trip(cloud, "s.ply", binary);
    EXPECT_EQ(back.source, cloud.source);
    EXPECT_EQ(back.colours, cloud.colours);
    ASSERT_EQ(back.sensors.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_LT((back.origin + back.sensors[i].cast<double>() - cloud.origin - cloud.sensors[i].cast<double>()).norm(),
                1e-4);
  }
  EXPECT_TRUE(host->warnings.empty()) << warnings();
  ReadScan::Params params;
  params.path = {{path("s.ply")}};
  params.sensor = ReadScan::SensorUse::none;
  const Cloud none = ReadScan::run(params, context).cloud;
  EXPECT_TRUE(none.sensors.empty() && none.source.empty());
  params.sensor = ReadScan::SensorUse::origin;
  const Cloud one = ReadScan::run(params, context).cloud;
  EXPECT_EQ(one.sensors.size(), 1U);
  EXPECT_TRUE(one.source.empty());
  params.sensor = ReadScan::SensorUse::automatic;
  params.scale = 0.001;
  const Cloud small = ReadScan::run(params, context).cloud;
  EXPECT_NEAR(small.origin.x() + small.sensors.at(1).x(), 499.996, 1e-4);
  round_trip(cloud, "s.pcd", true);
  EXPECT_TRUE(warned("places of 3 sensors"));
}

TEST_F(CloudFiles, SensorsThatMakeNoSenseAreRefusedAndThoseOfOthersSkipped) {
  const auto ply = [](const std::string& sensor, const std::string& rows, const std::string& sources) {
    return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty "
           "int "
           "source\n" +
           sensor + "end_header\n0 0 0 " + sources[0] + "\n1 0 0 " + sources[1] + "\n0 1 0 " + sources[2] + "\n" + rows;
  };
  const auto read = [&](const std::string& text) {
    ReadScan::Params params;
    params.path = {{file("s.ply", text)}};
    return ReadScan::run(params, context).cloud;
  };
  const std::string two = "element sensor 2\nproperty float x\nproperty float y\nproperty float z\n";
  EXPECT_EQ(read(ply(two, "0 0 1\n1 1 1\n", "010")).source, (std::vector<std::uint16_t>{0, 1, 0}));
  EXPECT_CONTAINS(error_of([&] { read(ply(two, "0 0 1\n1 1 1\n", "012")); }),
                  "the source of point 2 is sensor 2, but there are 2 sensors");
  EXPECT_CONTAINS(error_of([&] { read(ply(two, "0 0 1\n1 nan 1\n", "010")); }), "the place of sensor 1 is not finite");
  EXPECT_CONTAINS(error_of([&] { read(ply(two, "0 0 1\n", "010")); }), "truncated");
  const Cloud other = read(ply("element sensor 1\nproperty int serial\n", "77\n", "019"));
  EXPECT_TRUE(other.sensors.empty() && other.source.empty());
  EXPECT_TRUE(read(ply("", "", "019")).source.empty());
}

TEST_F(CloudFiles, AnEmptyCloudIsAValidFileWithAWarning) {
  for (const std::string name : {"e.ply", "e.pcd", "e.e57", "e.las", "e.laz", "e.csv"}) {
    host->warnings.clear();
    WriteCloud::run({input(Cloud{})}, {{name}, true}, context);
    EXPECT_TRUE(warned("the cloud is empty"));
    EXPECT_TRUE(std::filesystem::exists(path(name)));
  }
  EXPECT_CONTAINS(error_of([&] { WriteCloud::run({input(Cloud{})}, {{"e.rcp"}, true}, context); }), "e.rcp");
}

}  // namespace
}  // namespace atrium::io::cloud_test
