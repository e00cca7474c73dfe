#include "files.hpp"
#include "modules/io/read_scan.hpp"
#include "modules/io/write_cloud.hpp"
#include "tests/support/las_builder.hpp"

namespace atrium::io {
namespace {

using test::LasBuilder;

class Las : public Files {
 protected:
  Cloud read_file(const std::string& place, ReadScan::Unit unit = ReadScan::Unit::metre) {
    ReadScan::Params params;
    params.path = {{place}};
    params.unit = unit;
    return ReadScan::run(params, context).cloud;
  }
  Cloud read(const std::string& bytes, ReadScan::Unit unit = ReadScan::Unit::metre) {
    return read_file(file("scan.las", bytes), unit);
  }
  std::string failure(const std::string& bytes) {
    return error_of([&] { read(bytes); });
  }
};

LasBuilder of(int type, int minor, int extra = 0) {
  LasBuilder las;
  las.type = type;
  las.minor = minor;
  las.extra = extra;
  for (int i = 0; i < 5; ++i)
    las.add({1000 * i, -250 * i, 3 + i, static_cast<std::uint16_t>(100 * i), static_cast<std::uint8_t>(i + 1), i == 3,
             static_cast<std::uint16_t>(257 * i), 65535, 257});
  return las;
}

TEST_F(Las, EveryRecordTypeOfEveryVersion) {
  for (int type = 0; type <= 10; ++type) {
    for (int minor = type < 4 ? 0 : type < 6 ? 3 : 4; minor <= 4; ++minor) {
      for (const int extra : {0, 9}) {
        SCOPED_TRACE(std::to_string(type) + " in 1." + std::to_string(minor) + ", " + std::to_string(extra) + " more");
        const Cloud cloud = read(of(type, minor, extra).file());
        ASSERT_EQ(cloud.size(), 4U);  // one is withheld
        EXPECT_EQ(cloud.points[3], Eigen::Vector3f(4, -1, 0.007F));
        EXPECT_EQ(cloud.intensities, (std::vector<float>{0, 100, 200, 400}));
        EXPECT_EQ(cloud.labels, (std::vector<std::int32_t>{1, 2, 3, 5}));
        const bool coloured = type == 2 || type == 3 || type == 5 || type == 7 || type == 8 || type == 10;
        ASSERT_EQ(cloud.colours.size(), coloured ? 4U : 0U);
        if (coloured) {
          EXPECT_EQ(cloud.colours[3], (Colour{4, 255, 1}));
        }
      }
    }
  }
}

TEST_F(Las, ColoursThatNeverPass255Have8Bits) {
  LasBuilder las;
  las.type = 2;
  for (int i = 0; i < 20000; ++i) las.add({i, 0, 0, 0, 0, false, static_cast<std::uint16_t>(i % 256), 10, 20});
  EXPECT_EQ(read(las.file()).colours[300], (Colour{44, 10, 20}));
  las.add({1, 0, 0, 0, 0, false, 256, 0, 0});  // a single one far behind
  EXPECT_EQ(read(las.file()).colours[255], (Colour{1, 0, 0}));
}

TEST_F(Las, CoordinatesStayDouble) {
  LasBuilder las;
  las.offset = 5'400'000;
  las.scale = 1e-5;
  for (int i = 0; i < 9; ++i) las.add({i, 10 * i, 0});
  const Cloud cloud = read(las.file());
  EXPECT_EQ(cloud.origin, Eigen::Vector3d(5'400'000, 5'400'000, 5'400'000));
  EXPECT_NEAR(cloud.points[8].y(), 8e-4, 1e-9);
}

TEST_F(Las, KeepsTheReferenceSystemAndItsUnit) {
  const std::string keys = [] {
    std::string bytes;
    for (const int v : {1, 1, 0, 3, 1024, 0, 1, 1, 3072, 0, 1, 2225, 3076, 0, 1, 9003})
      LasBuilder::number(bytes, static_cast<std::uint16_t>(v));
    return bytes;
  }();
  const Cloud feet = read(of(0, 2).describe("LASF_Projection", 34735, keys).file(), ReadScan::Unit::automatic);
  EXPECT_EQ(feet.crs, "EPSG:2225");
  EXPECT_NEAR(feet.unit, 1200.0 / 3937, 1e-12);
  EXPECT_NEAR(feet.points[3].x(), 4 * 0.3048006F, 1e-6F);
  EXPECT_TRUE(warned("its coordinate reference system counts in units of 0.3048006 m")) << warnings();

  const std::string wkt =
      R"(COMPD_CS["c",PROJCS["UTM",GEOGCS["g",UNIT["degree",0.017]],PARAMETER["a",1],UNIT["metre",1,AUTHORITY["EPSG","9001"]]],VERT_CS["v",UNIT["ft",0.3]]])";
  LasBuilder with = of(6, 4);
  with.describe("LASF_Projection", 34735, keys).describe("LASF_Projection", 2112, wkt + std::string(3, '\0'));
  const Cloud metres = read(with.file(), ReadScan::Unit::automatic);
  EXPECT_EQ(metres.crs, wkt);
  EXPECT_EQ(metres.unit, 1.0);
  EXPECT_FALSE(warned("not lengths"));
  read(of(6, 4).describe("LASF_Projection", 2112, R"(GEOGCS["WGS 84",UNIT["degree",0.017]])").file());
  EXPECT_TRUE(warned("longitude and latitude")) << warnings();
}

TEST_F(Las, WhatDoesNotFitTogetherIsRefused) {
  const std::string good = of(3, 2).file();
  const auto changed = [&](std::size_t at, const std::string& bytes) {
    return failure(std::string(good).replace(at, bytes.size(), bytes));
  };
  EXPECT_CONTAINS(failure(good.substr(0, good.size() - 1)), "truncated: 5 × 34 bytes are to follow byte 227");
  EXPECT_CONTAINS(failure(good.substr(0, 100)), "truncated: 100 bytes are less than the header");
  EXPECT_CONTAINS(changed(0, "LASX"), "not a LAS file");
  EXPECT_CONTAINS(changed(25, "\x09"), "version 1.9 of LAS; 1.0 to 1.4 are known");
  EXPECT_CONTAINS(changed(104, "\x0B"), "byte 104: records of type 11; 0 to 10 are known");
  EXPECT_CONTAINS(changed(105, "\x10"), "byte 105: records of 16 bytes, but type 3 has 34");
  EXPECT_CONTAINS(changed(96, "\xFF\xFF"), "byte 96: the points are to begin at byte 65535");
  EXPECT_CONTAINS(changed(131, std::string(8, '\0')), "a scale of 0");
  EXPECT_CONTAINS(changed(107, std::string(4, '\0')), "no points");
  EXPECT_CONTAINS(changed(104, "\x83"), "without a record 'laszip encoded'");
  std::string waveforms = of(4, 3).file();
  waveforms[104] = static_cast<char>(0x84);
  EXPECT_CONTAINS(failure(waveforms), "compressed records of type 4, with waveforms");
}

Cloud surveyed(std::size_t n, bool colours) {
  Cloud cloud;
  Random random(n);
  cloud.origin = {500000, 5400000, 0};
  for (std::size_t i = 0; i < n; ++i) {
    const double s = static_cast<double>(i) * 0.01;
    cloud.points.emplace_back(9 * std::cos(s) + random.normal() * 0.01, 7 * std::sin(s),
                              random.index(40) == 0 ? 3 : 0.1 * s);
    if (colours)
      cloud.colours.push_back({static_cast<std::uint8_t>(i / 7),
                               static_cast<std::uint8_t>(random.index(5) == 0 ? 9 : i / 9),
                               static_cast<std::uint8_t>(random.index(256))});
    cloud.intensities.push_back(static_cast<float>(random.index(3000)));
    cloud.labels.push_back(static_cast<std::int32_t>(random.index(9) == 0 ? random.index(32) : 2));
  }
  return cloud;
}

/// Of the places of two clouds' points.
double largest_difference(const Cloud& a, const Cloud& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(
        largest, (a.origin + a.points[i].cast<double>() - b.origin - b.points[i].cast<double>()).cwiseAbs().maxCoeff());
  return largest;
}

TEST_F(Las, WrittenCloudsComeBackAndLazIsTheSame) {
  for (const bool colours : {false, true}) {
    for (const std::size_t n : {3U, 50000U, 50001U, 120000U}) {
      SCOPED_TRACE(n);
      Cloud cloud = surveyed(n, colours);
      cloud.crs = "EPSG:25832";
      for (const std::string name : {"w.las", "w.laz"}) WriteCloud::run({input(cloud)}, {{name}, true}, context);
      const Cloud las = read_file(path("w.las")), laz = read_file(path("w.laz"));
      ASSERT_EQ(las.size(), n);
      ASSERT_EQ(laz.size(), n);
      EXPECT_LT(largest_difference(las, laz), 1e-6);  // origins may differ by whole metres
      EXPECT_EQ(laz.intensities, cloud.intensities);
      EXPECT_EQ(laz.labels, cloud.labels);
      EXPECT_EQ(laz.colours, cloud.colours);
      EXPECT_EQ(las.colours, cloud.colours);
      EXPECT_EQ(laz.crs, "EPSG:25832");
      for (std::size_t i = 0; i < n; ++i)
        ASSERT_LT((las.origin + las.points[i].cast<double>() - cloud.origin - cloud.points[i].cast<double>()).norm(),
                  1e-4);
      if (n > 1000) {
        EXPECT_LT(content("w.laz").size(), content("w.las").size() / 2);
      }
    }
  }
  EXPECT_TRUE(host->warnings.empty()) << warnings();
}

TEST_F(Las, WritesWideLabelsAndSaysWhatItCannotKeep) {
  Cloud cloud = surveyed(10, true);
  cloud.labels[4] = 200;
  cloud.crs = "PROJCS[\"p\",UNIT[\"metre\",1]]";
  WriteCloud::run({input(cloud)}, {{"w.las"}, true}, context);
  const Cloud back = read_file(path("w.las"));
  EXPECT_EQ(back.labels, cloud.labels);
  EXPECT_EQ(back.crs, cloud.crs);
  EXPECT_TRUE(host->warnings.empty()) << warnings();
  WriteCloud::run({input(cloud)}, {{"w.laz"}, true}, context);
  EXPECT_TRUE(warned("labels from 2 to 200 are not kept: this format has 0 to 31")) << warnings();
  cloud.labels.clear();
  cloud.normals.assign(10, Eigen::Vector3f::UnitZ());
  cloud.sensors = {{1, 2, 3}};
  for (float& v : cloud.intensities) v /= 3000;
  WriteCloud::run({input(cloud)}, {{"w.las"}, true}, context);
  EXPECT_TRUE(warned("normals are not kept"));
  EXPECT_TRUE(warned("places of 1 sensor are"));
  const Cloud scaled = read_file(path("w.las"));
  EXPECT_NEAR(scaled.intensities[3] / 65535, cloud.intensities[3], 1e-5F);
}

TEST_F(Las, DamagedLazIsRefusedOrReadButNeverMore) {
  WriteCloud::run({input(surveyed(3000, true))}, {{"w.laz"}, true}, context);
  const std::string good = content("w.laz");
  const auto changed = [&](std::size_t at, const std::string& bytes) {
    return error_of([&] { read(std::string(good).replace(at, bytes.size(), bytes)); });
  };
  const std::size_t data = 227 + 54 + 46;
  EXPECT_CONTAINS(changed(data, std::string("\1\0\0\0\0\0\0\0", 8)), "LASzip's table of chunks is to be at byte 1,");
  EXPECT_CONTAINS(changed(107, "\xFF\xFF"), "the header promises 65535 points, but the 1 chunks have 15535 less");
  EXPECT_CONTAINS(changed(107, "\x10\x27"), "is damaged: it ends before its last point");  // 10000 of 3000
  EXPECT_CONTAINS(changed(227 + 54 + 12, std::string(4, '\0')), "chunks are to have 0 points");
  EXPECT_CONTAINS(changed(227 + 54, "\3"), "LASzip's compressor 3 for records of type 2");
  for (std::size_t cut = data; cut < good.size(); cut += 97)
    EXPECT_NE(error_of([&] { read(good.substr(0, cut)); }), "") << cut;
}

/// Where a .las stands beside a .laz it is the answer.
TEST_F(Las, FilesOfOthersAreReadRight) {
  const std::filesystem::path place = ATRIUM_SOURCE_DIR "/../shared/scans/formats/las";
  if (!std::filesystem::exists(place)) GTEST_SKIP() << "the files of others are not beside the checkout: " << place;
  const std::pair<const char*, const char*> twins[] = {{"1815.las", "1815.laz"},
                                                       {"extrabytes.las", "extrabytes.laz"},
                                                       {"point-color-time.las", "point-color-time.las.laz"},
                                                       {"point-color.las", "point-color.las.laz"},
                                                       {"point-time.las", "point-time.las.laz"},
                                                       {"point10.las", "point10.las.laz"}};
  for (const auto& [las, laz] : twins) {
    SCOPED_TRACE(laz);
    const Cloud a = read_file(place / las), b = read_file(place / laz);
    EXPECT_GT(a.size(), 1000U);
    EXPECT_EQ(a.origin, b.origin);
    EXPECT_EQ(a.points, b.points);
    EXPECT_EQ(a.colours, b.colours);
    EXPECT_EQ(a.intensities, b.intensities);
    EXPECT_EQ(a.labels, b.labels);
  }
  // The same ellipsoid pointwise, in layers, and in layers in another order.
  const Cloud one = read_file(place / "ellipsoid.laz"), layers = read_file(place / "ellipsoid-1.4.laz"),
              tree = read_file(place / "ellipsoid.copc.laz");
  EXPECT_EQ(one.points, layers.points);
  EXPECT_EQ(one.colours, layers.colours);
  EXPECT_EQ(one.labels, layers.labels);
  const auto sorted = [](const Cloud& cloud) {
    std::vector<std::array<std::int64_t, 3>> all;  // centimetres
    for (const auto& p : cloud.points) {
      const Eigen::Vector3d at = 100 * (cloud.origin + p.cast<double>());
      all.push_back({std::llround(at.x()), std::llround(at.y()), std::llround(at.z())});
    }
    std::sort(all.begin(), all.end());
    return all;
  };
  EXPECT_EQ(sorted(one), sorted(tree));
}

}  // namespace
}  // namespace atrium::io
