#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <map>

#include "files.hpp"
#include "modules/filter/voxel_grid.hpp"
#include "modules/io/read_scan.hpp"
#include "modules/io/write_cloud.hpp"

namespace atrium::io {
namespace {

class Thin : public Files {
 protected:
  Cloud read(const std::string& name, double voxel, ReadScan::Unit unit = ReadScan::Unit::metre, double share = 0) {
    ReadScan::Params params;
    params.voxel_share = share;
    params.path = {{path(name)}};
    params.voxel = voxel;
    params.unit = unit;
    return ReadScan::run(params, context).cloud;
  }
  Cloud gridded(const Cloud& cloud, double size) {
    return *filter::VoxelGrid::run({input(cloud)}, {size}, context).cloud;
  }
};

void expect_same(const Cloud& a, const Cloud& b) {
  EXPECT_EQ(a.origin, b.origin);
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.normals, b.normals);
  EXPECT_EQ(a.colours, b.colours);
  EXPECT_EQ(a.intensities, b.intensities);
  EXPECT_EQ(a.labels, b.labels);
  EXPECT_EQ(a.source, b.source);
  EXPECT_EQ(a.sensors, b.sensors);
  EXPECT_EQ(a.crs, b.crs);
}

/// The walls of a room, seen from three places.
Cloud room(std::size_t n) {
  Cloud cloud;
  Random random(4);
  cloud.origin = {500000, 5400000, 0};
  cloud.sensors = {{1, 2, 1.5F}, {4, 1, 1.5F}, {2, 3, 1.5F}};
  for (std::size_t i = 0; i < n; ++i) {
    const double u = random.uniform(-2, 6), v = random.uniform(0, 3), e = 0.01 * random.normal();
    cloud.points.push_back(i % 3 == 0   ? Eigen::Vector3f(u, e, v)
                           : i % 3 == 1 ? Eigen::Vector3f(e, u, v)
                                        : Eigen::Vector3f(u, v, e));
    cloud.normals.push_back(Eigen::Vector3f(random.normal(), random.normal(), random.normal()).normalized());
    cloud.colours.push_back({static_cast<std::uint8_t>(random.index(256)), static_cast<std::uint8_t>(i % 256), 9});
    cloud.intensities.push_back(static_cast<float>(random.index(60000)));
    cloud.labels.push_back(static_cast<std::int32_t>(random.index(5)));
    cloud.source.push_back(static_cast<std::uint16_t>(3 * i / n));
  }
  return cloud;
}

TEST_F(Thin, GivesWhatTheVoxelGridGives) {
  const Cloud cloud = room(30'000);
  for (const std::string name : {"a.e57", "a.ply", "a.las", "a.laz", "a.pcd", "a.csv"}) {
    SCOPED_TRACE(name);
    WriteCloud::run({input(cloud)}, {{name}, true}, context);
    const Cloud whole = read(name, 0);
    EXPECT_EQ(whole.size(), cloud.size());
    for (const double size : {0.02, 0.15}) {
      const Cloud thin = read(name, size);
      EXPECT_LT(thin.size(), whole.size());
      expect_same(thin, gridded(whole, size));
    }
  }
}

// Rows of text are parsed block by block where they are thinned, and all at once where they are not.
TEST_F(Thin, TextOfManyBlocksGivesWhatTheVoxelGridGives) {
  const Cloud cloud = room(60'000);
  const std::map<std::string, std::string> names{
      {"bytes", "x y z n r g b"}, {"shares", "x y z n r g b"}, {"wide", "x y z n r g b"}, {"none", "x y z n"}};
  for (const auto& [kind, header] : names) {
    SCOPED_TRACE(kind);
    std::string text = "# points\n" + header + "\n";
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Eigen::Vector3d p = cloud.origin + cloud.points[i].cast<double>();
      const Colour& c = cloud.colours[i];
      text += fmt::format("{:.4f} {:.4f} {:.4f} {}", p.x(), p.y(), p.z(), i);
      if (kind == "bytes") text += fmt::format(" {} {} {}", c[0], c[1], c[2]);
      if (kind == "shares") text += fmt::format(" {:.3f} {:.3f} {:.3f}", c[0] / 255.0, c[1] / 255.0, c[2] / 255.0);
      if (kind == "wide") text += fmt::format(" {} {} {}", 257 * c[0], 257 * c[1], 257 * c[2]);
      text += '\n';
    }
    EXPECT_GT(text.size(), std::size_t{2} << 20U) << "some blocks";
    file("a.txt", text);
    const Cloud whole = read("a.txt", 0);
    EXPECT_EQ(whole.size(), cloud.size());
    EXPECT_EQ(whole.colours.size(), kind == "none" ? 0 : cloud.size());
    expect_same(read("a.txt", 0.1), gridded(whole, 0.1));
    file("a.txt", text + "1 2 3\n");
    EXPECT_CONTAINS(error_of([&] { read("a.txt", 0.1); }), "a.txt:60003: 3 values instead of");
  }
}

TEST_F(Thin, OfSeveralBadLinesOfTextTheFirstIsNamed) {
  std::string text;
  for (int i = 0; i < 400'000; ++i) {
    const bool bad = i == 50'000 || i == 350'000;
    text += bad ? "1 2\n" : fmt::format("{:.3f} {:.3f} 0.123\n", i * 1e-5, (i % 77) * 0.01);
  }
  EXPECT_GT(text.size(), std::size_t{4} << 20U) << "some blocks";
  file("a.xyz", text);
  for (int i = 0; i < 5; ++i)
    EXPECT_CONTAINS(error_of([&] { read("a.xyz", 0.1); }), "a.xyz:50001: 2 values instead of");
}

TEST_F(Thin, TextWithoutAFinitePlaceIsRefused) {
  std::string text;
  for (int i = 0; i < 300'000; ++i) text += "nan nan nan\n";
  file("a.xyz", text);
  EXPECT_CONTAINS(error_of([&] { read("a.xyz", 0.1); }), "a.xyz");
}

/// A floor of 50 x 50 voxels of 2 cm with 20 points each, and single points over it, two voxels apart at least.
Cloud floor_with_strays(int strays) {
  Cloud cloud;
  const auto add = [&](int x, int y, int z) {
    cloud.points.emplace_back(0.02F * (static_cast<float>(x) + 0.5F), 0.02F * (static_cast<float>(y) + 0.5F),
                              0.02F * (static_cast<float>(z) + 0.5F));
  };
  for (int i = 0; i < 20 * 2500; ++i) add(i % 50, i / 50 % 50, 0);
  for (int i = 0; i < strays; ++i) add(2 * (i % 25), 2 * (i / 25 % 25), 10 + 2 * (i / 625));
  return cloud;
}

TEST_F(Thin, LeavesOutNoiseAndSaysWhereThatIsMuch) {
  const auto thinned = [&](int strays, double share) {
    WriteCloud::run({input(floor_with_strays(strays))}, {{"s.ply"}, true}, context);
    return read("s.ply", 0.02, ReadScan::Unit::metre, share).size();
  };
  EXPECT_EQ(thinned(100, 0), 2600U);
  EXPECT_EQ(thinned(100, 0.05), 2500U);
  EXPECT_FALSE(warned("are left out as noise"));
  EXPECT_EQ(thinned(3000, 0.05), 2500U);
  EXPECT_TRUE(warned("3000 of 5500 voxels are left out as noise: they hold 5.7 % of the points")) << warnings();
}

TEST_F(Thin, GivesTheSameBytesWithAnyNumberOfThreads) {
  WriteCloud::run({input(room(40'000))}, {{"a.e57"}, true}, context);
  Cloud one, four;
  tbb::task_arena(1).execute([&] { one = read("a.e57", 0.1); });
  tbb::task_arena(4).execute([&] { four = read("a.e57", 0.1); });
  expect_same(one, four);
}

TEST_F(Thin, KeepsWildPointsAndRefusesMany) {
  Cloud cloud = room(2000);
  for (int i = 0; i < 3; ++i) {
    const auto at = static_cast<std::size_t>(500 * i + 7);
    cloud.points[at] = Eigen::Vector3f(0, 0, 200'000);
  }
  WriteCloud::run({input(cloud)}, {{"a.ply"}, true}, context);
  const Cloud thin = read("a.ply", 0.1);
  EXPECT_TRUE(warned("3 points lie more than")) << warnings();
  EXPECT_EQ(thin.points.back().z(), 200'000);
  EXPECT_EQ(thin.points[thin.size() - 3].z(), 200'000);
  EXPECT_LT(thin.points[thin.size() - 4].z(), 4);
  EXPECT_EQ(thin.colours.back(), cloud.colours[1007]);
  EXPECT_CONTAINS(error_of([&] { read("a.ply", 1e-6); }), "too far for voxels of 1e-06 m");
}

TEST_F(Thin, TheVoxelIsInMetresOfTheCloud) {
  Cloud cloud = room(30'000);
  cloud.origin = {0, 0, 0};
  cloud.sensors.clear();
  cloud.source.clear();
  for (auto& p : cloud.points) p *= 1000;  // millimetres
  WriteCloud::run({input(cloud)}, {{"a.ply"}, true}, context);
  const Cloud thin = read("a.ply", 0.2, ReadScan::Unit::millimetre);
  expect_same(thin, gridded(read("a.ply", 0, ReadScan::Unit::millimetre), 0.2));
  const Cloud guessed = read("a.ply", 0.2, ReadScan::Unit::automatic);
  EXPECT_EQ(guessed.unit, 0.001) << warnings();
  EXPECT_EQ(guessed.points, thin.points);
}

}  // namespace
}  // namespace atrium::io
