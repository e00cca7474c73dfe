#include "modules/synth/write_scan.hpp"

#include <gtest/gtest.h>

#include "modules/io/read_scan.hpp"
#include "modules/synth/flat.hpp"
#include "tests/support/temporary_folder.hpp"

namespace atrium::synth::write_scan_test {
namespace {

class Host : public ContextHost {
 public:
  explicit Host(std::filesystem::path folder) : folder_(std::move(folder)) {}
  std::filesystem::path output_folder() override { return folder_; }

 private:
  std::filesystem::path folder_;
};

class WrittenScan : public ::testing::Test {
 protected:
  Cloud written(const WriteScan::Params& params) {
    WriteScan::run({scene_}, params, context_);
    io::ReadScan::Params read;
    read.path = {{(folder_ / params.path.path).string()}};
    return io::ReadScan::run(read, context_).cloud;
  }
  Cloud wanted(const WriteScan::Params& from) {
    Scan::Params params;
    params.points = from.points;
    params.pattern = from.pattern;
    params.positions = from.positions;
    params.yaw = from.yaw;
    params.offset = from.offset;
    params.sensors = from.sensors;
    return Scan::run({scene_}, params, context_).cloud;
  }
  static Eigen::Vector3d place(const Cloud& cloud, const Eigen::Vector3f& local) {
    return cloud.origin + local.cast<double>();
  }

  test::TemporaryFolder folder_;
  Context context_{7, std::make_shared<Host>(folder_.path())};
  Input<SimulatedScene> scene_ = input(Flat::run({}, context_).scene);
};

TEST_F(WrittenScan, IsTheScanPointByPoint) {
  WriteScan::Params params;
  params.points = 20001;
  params.yaw = 30;
  params.offset = {500000, 5400000, 200};
  for (const std::string name : {"scan.e57", "scan.las", "scan.ply"}) {
    SCOPED_TRACE(name);
    params.path.path = name;
    const Cloud got = written(params), want = wanted(params);
    ASSERT_EQ(got.size(), want.size());
    for (std::size_t i = 0; i < got.size(); i += 7) {
      ASSERT_LT((place(got, got.points[i]) - place(want, want.points[i])).norm(), 2e-4) << i;
      ASSERT_EQ(got.colours[i], want.colours[i]) << i;
    }
    if (name == "scan.las") continue;
    EXPECT_EQ(got.labels, want.labels);
    EXPECT_EQ(got.source, want.source);
    ASSERT_EQ(got.sensors.size(), want.sensors.size());
    for (std::size_t s = 0; s < got.sensors.size(); ++s)
      EXPECT_LT((place(got, got.sensors[s]) - place(want, want.sensors[s])).norm(), 1e-4);
  }
}

TEST_F(WrittenScan, PositionsMayBeLeftOutAndOthersThanThreeFormatsAreRefused) {
  WriteScan::Params params;
  params.points = 5000;
  params.pattern = Scan::Pattern::uniform_area;
  EXPECT_TRUE(written(params).sensors.empty());
  params.pattern = Scan::Pattern::spherical;
  params.sensors = false;
  EXPECT_EQ(written(params).size(), 5000U);
  EXPECT_TRUE(written(params).sensors.empty());
  params.path.path = "scan.pcd";
  EXPECT_THROW(WriteScan::run({scene_}, params, context_), Error);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "scan.pcd"));
}

}  // namespace
}  // namespace atrium::synth::write_scan_test
