#include "files.hpp"
#include "modules/io/crc32c.hpp"
#include "modules/io/read_mesh.hpp"
#include "modules/io/read_scan.hpp"
#include "modules/io/write_cloud.hpp"
#include "tests/support/e57_builder.hpp"

namespace atrium::io {
namespace {

using test::E57Builder;
using test::E57TestScan;
using test::f32;
using test::f64;
using test::integers;

class E57 : public Files {
 protected:
  Cloud read(const std::string& bytes) {
    ReadScan::Params params;
    params.path = {{file("scan.e57", bytes)}};
    return ReadScan::run(params, context).cloud;
  }
  Cloud read(const E57TestScan& scan) { return read(E57Builder().add(scan).file()); }
  std::string failure(const std::string& bytes) {
    return error_of([&] { read(bytes); });
  }
};

std::vector<double> some(std::size_t n, std::uint64_t seed = 1) {
  Random random(seed);
  std::vector<double> values;
  for (std::size_t i = 0; i < n; ++i) values.push_back(random.uniform(0.5, 5));
  return values;
}

E57TestScan cartesian(std::size_t n, const std::string& xml = {}) {
  return {{f32("cartesianX", some(n, 1)), f32("cartesianY", some(n, 2)), f64("cartesianZ", some(n, 3))}, xml};
}

std::string pose(const std::string& turn, const std::string& place) {
  const auto element = [](const std::string& name, const std::string& value) {
    return "<" + name + " type=\"Float\">" + value + "</" + name + ">";
  };
  const auto parts = [&](const std::string& names, const std::string& numbers) {
    std::string xml;
    std::istringstream stream(numbers);
    for (const char name : names) {
      std::string value;
      stream >> value;
      xml += element(std::string(1, name), value);
    }
    return xml;
  };
  return "<pose type=\"Structure\"><rotation type=\"Structure\">" + parts("wxyz", turn) +
         "</rotation><translation type=\"Structure\">" + parts("xyz", place) + "</translation></pose>";
}

TEST(Crc32c, HasTheKnownValues) {
  const auto crc = [](const std::string& text) {
    return crc32c(reinterpret_cast<const std::byte*>(text.data()), text.size());
  };
  EXPECT_EQ(crc("123456789"), 0xE3069283U);
  EXPECT_EQ(crc(std::string(32, '\0')), 0x8A9136AAU);
  EXPECT_EQ(crc(""), 0U);
}

TEST_F(E57, IntegersOfAnyWidthCrossPackets) {
  constexpr std::size_t n = 61;
  for (unsigned bits = 0; bits <= 64; ++bits) {
    SCOPED_TRACE(bits);
    Random random(bits);
    const std::int64_t low = bits == 64 ? std::numeric_limits<std::int64_t>::min() : -5;
    const std::uint64_t range = bits == 0 ? 0 : bits == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
    std::vector<std::int64_t> values;
    for (std::size_t i = 0; i < n; ++i) {
      const std::uint64_t any = random.index(1U << 31U) << 33U ^ random.index(1U << 31U) << 11U ^ random.index(2048);
      values.push_back(static_cast<std::int64_t>(static_cast<std::uint64_t>(low) + (range == 0 ? 0 : any & range)));
    }
    // Brought to some metres, whatever the width.
    const double scale = std::ldexp(1.0, 3 - static_cast<int>(bits));
    E57TestScan scan = cartesian(n);
    std::ostringstream more;
    more.precision(17);
    more << "scale=\"" << scale << "\" offset=\"0.25\"";
    scan.streams[1] = integers("cartesianY", low, static_cast<std::int64_t>(static_cast<std::uint64_t>(low) + range),
                               values, more.str());
    ASSERT_EQ(scan.streams[1].bits, bits);
    scan.packet_bytes = 5;
    const Cloud cloud = read(scan);
    ASSERT_EQ(cloud.size(), n);
    for (std::size_t i = 0; i < n; ++i)
      ASSERT_EQ(cloud.points[i].y(), static_cast<float>(static_cast<double>(values[i]) * scale + 0.25)) << i;
  }
}

TEST_F(E57, FloatsAndOtherPackets) {
  E57TestScan scan = cartesian(500);
  scan.other_packets = true;
  const Cloud cloud = read(scan);
  ASSERT_EQ(cloud.size(), 500U);
  for (std::size_t i = 0; i < 500; ++i)
    EXPECT_EQ(cloud.points[i], Eigen::Vector3f(static_cast<float>(some(500, 1)[i]), static_cast<float>(some(500, 2)[i]),
                                               static_cast<float>(some(500, 3)[i])));
  EXPECT_TRUE(cloud.sensors.empty());
  EXPECT_EQ(cloud.unit, 1.0);
}

TEST_F(E57, ManyRecordsAreReadInBlocks) {
  E57TestScan scan = cartesian(30000);
  scan.packet_bytes = 3001;
  const Cloud cloud = read(scan);
  ASSERT_EQ(cloud.size(), 30000U);
  const auto x = some(30000, 1), z = some(30000, 3);
  for (std::size_t i = 0; i < 30000; ++i) {
    ASSERT_EQ(cloud.points[i].x(), static_cast<float>(x[i])) << i;
    ASSERT_EQ(cloud.points[i].z(), static_cast<float>(z[i])) << i;
  }
}

TEST_F(E57, SphericalCoordinatesAreAroundTheScanner) {
  const double deg = EIGEN_PI / 180;
  const Cloud cloud = read(
      {{f64("sphericalRange", {2, 2, 4, 0, 3}), f64("sphericalAzimuth", {0, 90 * deg, 180 * deg, 0, 1}),
        f64("sphericalElevation", {0, 0, 30 * deg, 0, 1}), integers("sphericalInvalidState", 0, 2, {0, 0, 0, 0, 1})},
       pose("1 0 0 0", "10 20 30")});
  ASSERT_EQ(cloud.size(), 3U);  // neither the range of 0 nor the direction without a range
  EXPECT_LT((cloud.points[0] - Eigen::Vector3f(12, 20, 30)).norm(), 1e-5F);
  EXPECT_LT((cloud.points[1] - Eigen::Vector3f(10, 22, 30)).norm(), 1e-5F);
  EXPECT_LT((cloud.points[2] - Eigen::Vector3f(10 - 3.4641F, 20, 32)).norm(), 1e-4F);
  ASSERT_EQ(cloud.sensors.size(), 1U);
  EXPECT_EQ(cloud.sensors[0], Eigen::Vector3f(10, 20, 30));
}

TEST_F(E57, InvalidStatesAndZerosAreNoPoints) {
  const std::vector<double> x{1, 0, 2, 3, 0, 4}, zero(6, 0);
  E57TestScan scan{{f32("cartesianX", x), f32("cartesianY", zero), f32("cartesianZ", zero)}, {}};
  EXPECT_EQ(read(scan).size(), 4U);  // two at exactly zero: rays that hit nothing
  scan.streams[0] = f32("cartesianX", {1, 0, 2, 3, 5, 4});
  EXPECT_EQ(read(scan).size(), 6U);  // a single one may be a point
  scan.xml = pose("1 0 0 0", "0 0 1");
  EXPECT_EQ(read(scan).size(), 5U);  // but not where the scanner stood
  scan.xml = {};
  scan.streams.push_back(integers("cartesianInvalidState", 0, 2, {0, 0, 1, 2, 0, 0}));
  EXPECT_EQ(read(scan).size(), 4U);
  for (const char* name : {"rowIndex", "columnIndex"}) scan.streams.push_back(integers(name, 0, 9, {0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(read(scan).size(), 3U);
}

TEST_F(E57, ScansStandWhereTheirPosesSay) {
  const std::vector<double> zero(3, 0), one{1, 2, 3};
  const std::string half = "0.70710678118654757";
  E57Builder builder;
  builder.add({{f32("cartesianX", one), f32("cartesianY", zero), f32("cartesianZ", zero)},
               pose(half + " 0 0 " + half, "10 0 2")});
  builder.add_xml("<vectorChild type=\"Structure\"><name type=\"String\">empty</name></vectorChild>");
  builder.add({{f32("cartesianX", one), f32("cartesianY", zero), f32("cartesianZ", zero)}, pose("1 0 0 0", "0 0 0")});
  const Cloud cloud = read(builder.file());
  ASSERT_EQ(cloud.size(), 6U);
  EXPECT_LT((cloud.points[1] - Eigen::Vector3f(10, 2, 2)).norm(), 1e-5F);
  EXPECT_LT((cloud.points[4] - Eigen::Vector3f(2, 0, 0)).norm(), 1e-5F);
  ASSERT_EQ(cloud.sensors.size(), 2U);
  EXPECT_EQ(cloud.sensors[0], Eigen::Vector3f(10, 0, 2));
  EXPECT_EQ(cloud.sensors[1], Eigen::Vector3f(0, 0, 0));  // the other one is set, so this is as well
  EXPECT_EQ(cloud.source, (std::vector<std::uint16_t>{0, 0, 0, 1, 1, 1}));
}

TEST_F(E57, PosesThatNobodySetTellNoPlace) {
  E57Builder builder;
  builder.add(cartesian(4, pose("1 0 0 0", "0 0 0"))).add(cartesian(5, pose("1 0 0 0", "0 0 0")));
  const Cloud cloud = read(builder.file());
  EXPECT_EQ(cloud.size(), 9U);
  EXPECT_TRUE(cloud.sensors.empty() && cloud.source.empty());
}

TEST_F(E57, GeoreferencedPosesKeepMillimetres) {
  const Cloud cloud = read(cartesian(100, pose("1 0 0 0", "500000.125 5400000.5 300")));
  EXPECT_EQ(cloud.origin.x(), 500002);
  const auto x = some(100, 1);
  for (std::size_t i = 0; i < 100; ++i)
    EXPECT_NEAR(cloud.origin.x() + static_cast<double>(cloud.points[i].x()), 500000.125 + x[i], 1e-6);
}

TEST_F(E57, ColoursAreScaledByTheirLimits) {
  const auto with = [&](const std::string& xml, unsigned bits, const std::vector<std::int64_t>& v) {
    E57TestScan scan = cartesian(4, xml);
    for (const char* name : {"colorRed", "colorGreen", "colorBlue"})
      scan.streams.push_back(integers(name, 0, (std::int64_t{1} << bits) - 1, v));
    std::vector<int> red;
    for (const auto& c : read(scan).colours) red.push_back(c[0]);
    return red;
  };
  const auto limits = [](const std::string& most) {
    std::string xml = "<colorLimits type=\"Structure\">";
    for (const std::string name : {"colorRed", "colorGreen", "colorBlue"})
      xml += "<" + name + "Minimum type=\"Integer\"/><" + name + "Maximum type=\"Integer\">" + most + "</" + name +
             "Maximum>";
    return xml + "</colorLimits>";
  };
  EXPECT_EQ(with({}, 8, {0, 1, 128, 255}), (std::vector<int>{0, 1, 128, 255}));
  EXPECT_EQ(with({}, 16, {0, 257, 32896, 65535}), (std::vector<int>{0, 1, 128, 255}));
  EXPECT_EQ(with(limits("255"), 16, {0, 1, 128, 255}), (std::vector<int>{0, 1, 128, 255}));  // room for 16, but 8
  EXPECT_EQ(with(limits("65535"), 16, {0, 257, 32896, 65535}), (std::vector<int>{0, 1, 128, 255}));
  EXPECT_EQ(with(limits("0"), 8, {0, 1, 128, 255}), (std::vector<int>{0, 1, 128, 255}));  // no limits at all
  E57TestScan real = cartesian(4);
  for (const char* name : {"colorRed", "colorGreen", "colorBlue"}) real.streams.push_back(f32(name, {0, 0.5, 1, 0.25}));
  EXPECT_EQ(read(real).colours[1], (Colour{128, 128, 128}));
}

TEST_F(E57, IntensitiesAreScaledByTheirLimitsOrKept) {
  const auto with = [&](const std::string& xml, const test::E57Stream& stream) {
    E57TestScan scan = cartesian(4, xml);
    scan.streams.push_back(stream);
    return read(scan).intensities;
  };
  EXPECT_EQ(with({}, f32("intensity", {-3, 0, 7.5, 1e6})), (std::vector<float>{-3, 0, 7.5F, 1e6F}));
  EXPECT_EQ(with({}, integers("intensity", -66, 66, {-66, 0, 33, 66})), (std::vector<float>{0, 0.5F, 0.75F, 1}));
  const std::string limits =
      "<intensityLimits type=\"Structure\"><intensityMinimum type=\"ScaledInteger\" "
      "scale=\"0.1\">-20</intensityMinimum>"
      "<intensityMaximum type=\"Float\">2</intensityMaximum></intensityLimits>";
  EXPECT_EQ(with(limits, f32("intensity", {-2, 0, 1, 2})), (std::vector<float>{0, 0.5F, 0.75F, 1}));
}

TEST_F(E57, ExtensionsAndMissingNamespaces) {
  const std::string half = "0.70710678118654757";
  E57TestScan scan = cartesian(3, pose(half + " 0 0 " + half, "0 0 5") + "<x:odd x:of=\"3\"><y:more/></x:odd>");
  scan.streams.push_back(integers("x:mystery", 0, 1000, {1, 2, 3}));
  scan.streams.push_back(f32("nor:normalX", {2, 1, 1}));
  scan.streams.push_back(f32("nor:normalY", {0, 0, 0}));
  scan.streams.push_back(f32("nor:normalZ", {0, 0, 0}));
  scan.streams.push_back(integers("classification", 0, 255, {2, 6, 7}));
  E57Builder builder;
  builder.before_root = "\xEF\xBB\xBF";
  builder.root_xml = "<coordinateMetadata type=\"String\"><![CDATA[ PROJCS[\"a\"] ]]></coordinateMetadata>";
  const Cloud cloud = read(builder.add(scan).file());
  EXPECT_EQ(cloud.labels, (std::vector<std::int32_t>{2, 6, 7}));
  ASSERT_EQ(cloud.normals.size(), 3U);
  EXPECT_LT((cloud.normals[0] - Eigen::Vector3f::UnitY()).norm(), 1e-6F);
  EXPECT_EQ(cloud.crs, "PROJCS[\"a\"]");
}

TEST_F(E57, WhatOnlySomeScansHaveIsLeftOutAndSaid) {
  E57TestScan coloured = cartesian(4);
  for (const char* name : {"colorRed", "colorGreen", "colorBlue"})
    coloured.streams.push_back(integers(name, 0, 255, {1, 2, 3, 4}));
  const Cloud cloud = read(E57Builder().add(coloured).add(cartesian(5)).file());
  EXPECT_EQ(cloud.size(), 9U);
  EXPECT_TRUE(cloud.colours.empty());
  EXPECT_TRUE(warned("only some of the 2 scans have colorRed, colorGreen, colorBlue")) << warnings();
}

TEST_F(E57, DamagedPagesAreNamedByTheirByte) {
  E57TestScan scan = cartesian(2000);
  scan.packet_bytes = 900;
  const std::string good = E57Builder().add(scan).file();
  EXPECT_EQ(read(good).size(), 2000U);
  for (const std::size_t at : {std::size_t{100}, std::size_t{1024 * 7 + 500}, good.size() - 300}) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 4);
    EXPECT_CONTAINS(failure(bad), "scan.e57: the page at byte " + std::to_string(at / 1024 * 1024) +
                                      " is damaged: its checksum (CRC-32C) is wrong");
  }
  EXPECT_CONTAINS(failure(good.substr(0, good.size() - 1024)), "truncated: the header promises");
  EXPECT_CONTAINS(failure("ASTM-E57"), "truncated: 8 bytes");
}

TEST_F(E57, FilesWithoutPointsSaySo) {
  EXPECT_CONTAINS(failure(E57Builder().file()), "the file has no scans");
  EXPECT_CONTAINS(failure(E57Builder().add(cartesian(0)).file()), "no points: the file's scan is empty");
  EXPECT_CONTAINS(failure(E57Builder().add(cartesian(2)).file()), "only 2 points");
  E57TestScan scan = cartesian(4);
  scan.streams.push_back(integers("cartesianInvalidState", 0, 2, {2, 2, 2, 2}));
  EXPECT_CONTAINS(failure(E57Builder().add(scan).file()), "only 0 of 4 records are points");
  E57TestScan flat = cartesian(4);
  flat.streams.pop_back();
  EXPECT_CONTAINS(failure(E57Builder().add(flat).file()),
                  "scan 1: the points have no cartesianZ (there are: cartesianX, cartesianY)");
  E57Builder builder;
  EXPECT_CONTAINS(error_of([&] { ReadMesh::run({{file("m.e57", builder.add(cartesian(9)).file())}}, context); }),
                  "without faces");
}

TEST_F(E57, PosesThatAreNoneAreRefused) {
  const auto with = [&](const std::string& xml) { return failure(E57Builder().add(cartesian(4, xml)).file()); };
  EXPECT_CONTAINS(with(pose("0 0 0 0", "1 2 3")), "is no unit quaternion");
  EXPECT_CONTAINS(with(pose("0.5 0 0 0", "1 2 3")), "is no unit quaternion");
  EXPECT_CONTAINS(with(pose("nan 0 0 0", "1 2 3")), "is no unit quaternion");
  EXPECT_CONTAINS(with(pose("1 0 0 0", "1 inf 3")), "its place (translation of the pose) is not finite");
  EXPECT_CONTAINS(with("<name type=\"String\">hall</name>" + pose("1 0 0 0", "1 east 3")),
                  "scan 1 'hall': y is 'east', which is not a number");
}

TEST_F(E57, WhatDoesNotFitTogetherIsRefused) {
  E57TestScan more = cartesian(40);
  more.records = 41;
  EXPECT_CONTAINS(failure(E57Builder().add(more).file()),
                  "truncated: 41 points are promised, but the field cartesianX");
  more.records = 4'000'000'000'000;
  EXPECT_CONTAINS(failure(E57Builder().add(more).file()), "truncated: 4000000000000 points are promised");
  E57TestScan one_place{
      {integers("cartesianX", 1, 1, {1}), integers("cartesianY", 1, 1, {1}), integers("cartesianZ", 1, 1, {1})}};
  one_place.records = 4'000'000'000;
  EXPECT_CONTAINS(failure(E57Builder().add(one_place).file()), "lie in one place");

  // The second scan's points are the first one's.
  E57Builder overlapping;
  overlapping.add(cartesian(40));
  std::string xml =
      "<vectorChild type=\"Structure\"><points type=\"CompressedVector\" fileOffset=\"48\" recordCount=\"40\">"
      "<prototype type=\"Structure\">";
  for (const auto& stream : cartesian(1).streams) xml += stream.xml;
  overlapping.add_xml(xml + "</prototype></points></vectorChild>");
  EXPECT_CONTAINS(failure(overlapping.file()), "lie within those of scan 1, which begin at byte 48");

  const auto changed = [&](std::size_t at, const std::string& bytes) {
    const std::string good = E57Builder().add(cartesian(40)).file();
    std::string content;
    for (std::size_t page = 0; page < good.size(); page += 1024) content += good.substr(page, 1020);
    return failure(E57Builder::paged(content.replace(at, bytes.size(), bytes)));
  };
  EXPECT_CONTAINS(changed(48, "\3"), "byte 48: no section of points begins here");
  EXPECT_CONTAINS(changed(57, "\xFF"), "byte 48: a section of");
  EXPECT_CONTAINS(changed(64, "\1"), "the data of the section lie outside of it");
  EXPECT_CONTAINS(changed(80, "\7"), "byte 80: a packet of the unknown type 7");
  EXPECT_CONTAINS(changed(82, "\2"), "byte 80: a packet of 3 bytes");
  EXPECT_CONTAINS(changed(84, "\4"), "the data packet at byte 80 has 4 byte streams, but the records have 3 fields");
  EXPECT_CONTAINS(changed(86, "\xFF"), "but its streams need");
  EXPECT_CONTAINS(changed(8, "\2"), "version 2 of E57");
  EXPECT_CONTAINS(changed(41, "\x08"), "checksum");  // pages of 2048 bytes
  EXPECT_CONTAINS(changed(42, "\xFF\xFF"), "byte 40: pages of");
  EXPECT_CONTAINS(changed(26, "\1"), "the XML section is to be at byte");
}

TEST_F(E57, WrittenCloudsComeBackWithTheirPlaces) {
  Cloud cloud;
  Random random(3);
  cloud.origin = {500000, 5400000, 0};
  cloud.sensors = {{1, 2, 3}, {-4, 5, 1.5}, {0, 0.25, 1}};
  cloud.crs = "PROJCS[\"a & b\",UNIT[\"metre\",1]]";
  for (int i = 0; i < 9000; ++i) {
    cloud.points.emplace_back(random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(0, 3));
    cloud.normals.push_back(Eigen::Vector3f(random.normal(), random.normal(), random.normal()).normalized());
    cloud.colours.push_back({static_cast<std::uint8_t>(random.index(256)), 7, 255});
    cloud.intensities.push_back(static_cast<float>(random.uniform()));
    cloud.labels.push_back(static_cast<std::int32_t>(random.index(700)) - 50);
    cloud.source.push_back(static_cast<std::uint16_t>(i < 3000 ? 0 : i < 5000 ? 1 : 2));
  }
  WriteCloud::run({input(cloud)}, {{"w.e57"}, true}, context);
  ReadScan::Params params;
  params.path = {{path("w.e57")}};
  const Cloud back = ReadScan::run(params, context).cloud;
  EXPECT_TRUE(host->warnings.empty()) << warnings();
  ASSERT_EQ(back.size(), cloud.size());
  EXPECT_EQ(back.colours, cloud.colours);
  EXPECT_EQ(back.labels, cloud.labels);
  EXPECT_EQ(back.intensities, cloud.intensities);
  EXPECT_EQ(back.source, cloud.source);
  EXPECT_EQ(back.crs, cloud.crs);
  ASSERT_EQ(back.sensors.size(), 3U);
  const auto place = [](const Cloud& c, const Eigen::Vector3f& p) -> Eigen::Vector3d {
    return c.origin + p.cast<double>();
  };
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    ASSERT_LT((place(back, back.points[i]) - place(cloud, cloud.points[i])).norm(), 2e-6);
    ASSERT_LT((back.normals[i] - cloud.normals[i]).norm(), 1e-6F);
  }
  for (std::size_t s = 0; s < 3; ++s)
    EXPECT_LT((place(back, back.sensors[s]) - place(cloud, cloud.sensors[s])).norm(), 2e-6);
}

}  // namespace
}  // namespace atrium::io
