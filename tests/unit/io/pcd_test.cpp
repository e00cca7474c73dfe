#include <algorithm>

#include "files.hpp"
#include "modules/io/lzf.hpp"
#include "modules/io/read_scan.hpp"

namespace atrium::io::pcd_test {
namespace {

/// LZF made of literal runs only, and one with a copy that overlaps itself: enough to write compressed files by hand.
std::string literal_lzf(const std::string& data) {
  std::string packed;
  for (std::size_t i = 0; i < data.size(); i += 32) {
    const std::size_t n = std::min<std::size_t>(32, data.size() - i);
    packed += static_cast<char>(n - 1);
    packed += data.substr(i, n);
  }
  return packed;
}

class Pcd : public Files {
 protected:
  Cloud read(const std::string& name, ReadScan::Params params = {}) {
    params.path = {{path(name)}};
    return ReadScan::run(params, context).cloud;
  }
  std::string failure(const std::string& text) {
    file("bad.pcd", text);
    return error_of([&] { read("bad.pcd"); });
  }
};

std::string header(const std::string& fields, const std::string& sizes, const std::string& types, std::size_t points,
                   const std::string& data, const std::string& more = "") {
  std::string counts;
  for (std::size_t i = 0; i <= static_cast<std::size_t>(std::count(fields.begin(), fields.end(), ' ')); ++i)
    counts += " 1";
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS " + fields + "\nSIZE " + sizes + "\nTYPE " +
         types + "\nCOUNT" + counts + "\n" + more + "WIDTH " + std::to_string(points) + "\nHEIGHT 1\nPOINTS " +
         std::to_string(points) + "\nDATA " + data + "\n";
}

TEST_F(Pcd, ReadsTextOfTheOldestVersion) {
  file("a.pcd",
       "# comment\nVERSION .5\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F F\nWIDTH 3\nHEIGHT 1\nDATA ascii\n"
       "1 2 3 4.2108072e+06\n4 5 6 2.3418052e-38\n7 8 9 0\n");
  const Cloud cloud = read("a.pcd");
  ASSERT_EQ(cloud.size(), 3U);
  EXPECT_EQ(cloud.points[1], Eigen::Vector3f(4, 5, 6));
  EXPECT_EQ(cloud.colours[1], (Colour{255, 0, 0}));  // the float's bits are 0x00FF0000
  EXPECT_EQ(cloud.colours[2], (Colour{0, 0, 0}));
}

TEST_F(Pcd, ReadsPackedColoursNormalsLabelsAndSkipsOtherFields) {
  std::string bytes =
      "VERSION 0.7\nFIELDS histogram x y z normal_x normal_y normal_z rgba label intensity _\nSIZE 4 8 4 4 4 4 4 4 2 1 "
      "1\n"
      "TYPE F F F F F F F U U I U\nCOUNT 3 1 1 1 1 1 1 1 1 1 5\nWIDTH 3\nHEIGHT 1\nVIEWPOINT 1 2 3 1 0 0 0\nPOINTS 3\n"
      "DATA binary\n";
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) put(bytes, 99.0F);
    put(bytes, 10.0 + i);
    put(bytes, 20.0F);
    put(bytes, 30.0F * i);
    for (const float n : {0.0F, 0.0F, 2.0F}) put(bytes, n);
    put<std::uint32_t>(bytes, 0xFF102030U);
    put<std::uint16_t>(bytes, static_cast<std::uint16_t>(65000 + i));
    put<std::int8_t>(bytes, -7);
    bytes += "abcde";
  }
  file("b.pcd", bytes);
  const Cloud cloud = read("b.pcd");
  ASSERT_EQ(cloud.size(), 3U);
  EXPECT_EQ(cloud.points[2], Eigen::Vector3f(12, 20, 60));
  EXPECT_EQ(cloud.normals[1], Eigen::Vector3f(0, 0, 1));
  EXPECT_EQ(cloud.colours[0], (Colour{0x10, 0x20, 0x30}));
  EXPECT_EQ(cloud.labels, (std::vector<std::int32_t>{65000, 65001, 65002}));
  EXPECT_EQ(cloud.intensities[0], -7.0F);
  ASSERT_EQ(cloud.sensors.size(), 1U);
  EXPECT_EQ(cloud.sensors[0], Eigen::Vector3f(1, 2, 3));
}

TEST_F(Pcd, ReadsCompressedDataFieldAfterField) {
  std::string data;
  for (const double x : {1.0, 2.0, 3.0}) put(data, x);
  for (const std::uint8_t y : {7, 8, 9}) put(data, y);
  for (const float z : {0.5F, 0.5F, 0.5F}) put(data, z);
  const std::string packed = literal_lzf(data);
  std::string bytes = header("x y z", "8 1 4", "F U F", 3, "binary_compressed");
  put(bytes, static_cast<std::uint32_t>(packed.size()));
  put(bytes, static_cast<std::uint32_t>(data.size()));
  const std::string whole = bytes + packed;
  file("c.pcd", whole);
  const Cloud cloud = read("c.pcd");
  ASSERT_EQ(cloud.size(), 3U);
  EXPECT_EQ(cloud.points[1], Eigen::Vector3f(2, 8, 0.5F));
  EXPECT_CONTAINS(failure(whole.substr(0, whole.size() - 1)), "truncated");
  EXPECT_CONTAINS(failure(bytes.substr(0, bytes.size() - 5)), "truncated");
  std::string damaged = whole;
  damaged[bytes.size()] = '\x20';  // a copy from before the beginning
  EXPECT_CONTAINS(failure(damaged), "are damaged");
}

TEST(Lzf, CopiesMayOverlapWhatTheyMake) {
  // "ab", then 9 bytes from 2 back: abababababa.
  const unsigned char packed[] = {1, 'a', 'b', 0xE0, 0, 1};
  std::vector<std::byte> out;
  ASSERT_TRUE(expand_lzf(reinterpret_cast<const std::byte*>(packed), sizeof packed, out, 11));
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(out.data()), out.size()), "abababababa");
  EXPECT_FALSE(expand_lzf(reinterpret_cast<const std::byte*>(packed), sizeof packed, out, 10));
  EXPECT_FALSE(expand_lzf(reinterpret_cast<const std::byte*>(packed), sizeof packed, out, 12));
  EXPECT_FALSE(expand_lzf(reinterpret_cast<const std::byte*>(packed), 4, out, 11));
  EXPECT_FALSE(expand_lzf(reinterpret_cast<const std::byte*>(packed), sizeof packed, out, std::size_t{1} << 40U));
}

TEST_F(Pcd, AnOrganisedCloudLosesItsHolesAndHasItsSensorAtTheOrigin) {
  const std::string rows = "1 2 3\nnan nan nan\n4 5 6\nnan nan nan\n7 8 9\n10 11 12\n";
  const std::string head =
      "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nVIEWPOINT 0 0 0 0 1 0 0\nPOINTS 6\n";
  file("o.pcd", head + "WIDTH 3\nHEIGHT 2\nDATA ascii\n" + rows);
  file("u.pcd", head + "WIDTH 6\nHEIGHT 1\nDATA ascii\n" + rows);
  const Cloud organised = read("o.pcd");
  EXPECT_EQ(organised.size(), 4U);
  EXPECT_EQ(organised.points[1], Eigen::Vector3f(4, 5, 6));
  ASSERT_EQ(organised.sensors.size(), 1U);
  EXPECT_TRUE(organised.sensors[0].isZero(0));
  EXPECT_TRUE(read("u.pcd").sensors.empty());
  ReadScan::Params params;
  params.sensor = ReadScan::SensorUse::origin;
  EXPECT_EQ(read("u.pcd", params).sensors.size(), 1U);
  params.sensor = ReadScan::SensorUse::none;
  EXPECT_TRUE(read("o.pcd", params).sensors.empty());
}

TEST_F(Pcd, NamesWhatIsWrongAndWhere) {
  const std::string good = header("x y z", "4 4 4", "F F F", 3, "ascii");
  EXPECT_CONTAINS(failure("hello world\n"), "bad.pcd:1: unknown keyword 'hello'");
  EXPECT_CONTAINS(failure("VERSION 0.7\nFIELDS x y z\n"), "without a line 'DATA'");
  EXPECT_CONTAINS(failure("VERSION 0.7\nWIDTH 3\nDATA ascii\n"), "no line 'FIELDS'");
  EXPECT_CONTAINS(failure("FIELDS x y z\nSIZE 4 4\nTYPE F F F\nWIDTH 3\nDATA ascii\n"), "3 FIELDS, but 2 SIZE");
  EXPECT_CONTAINS(failure("FIELDS x y z\nSIZE 4 4 3\nTYPE F F F\nWIDTH 3\nDATA ascii\n"), "TYPE 'F' and SIZE 3");
  EXPECT_CONTAINS(failure("FIELDS x y z\nWIDTH three\nDATA ascii\n"), "bad.pcd:2: 'three' is not a whole number");
  EXPECT_CONTAINS(failure("FIELDS x y z\nDATA ascii\n"), "neither WIDTH nor POINTS");
  EXPECT_CONTAINS(failure("FIELDS x y z\nWIDTH 3\nPOINTS 4\nDATA ascii\n"), "WIDTH 3 times HEIGHT 1 are not POINTS 4");
  EXPECT_CONTAINS(failure("FIELDS x y z\nWIDTH 4294967296\nHEIGHT 4294967296\nPOINTS 0\nDATA ascii\n"),
                  "are not POINTS 0");
  EXPECT_CONTAINS(failure("FIELDS x y z\nWIDTH 4294967296\nHEIGHT 4294967296\nDATA ascii\n"), "bad.pcd");
  EXPECT_CONTAINS(failure("FIELDS x y z\nWIDTH 3\nDATA zip\n"), "unknown DATA 'zip'");
  EXPECT_CONTAINS(failure("FIELDS x y z\nCOUNT 1 1 99999999\nWIDTH 3\nDATA binary\n"), "COUNT of 99999999");
  EXPECT_CONTAINS(failure(header("x y label", "4 4 4", "F F F", 3, "ascii") + "1 1 1\n2 2 2\n3 3 3\n"),
                  "no coordinates x, y, z (there are: x, y, label)");
  EXPECT_CONTAINS(failure(good + "1 2 3\n4 5 6\n"),
                  "truncated: 3 points are declared, but the file ends after 2 (line 12)");
  EXPECT_CONTAINS(failure(good + "1 2 3\n4 5\n6 7 8\n"), "bad.pcd:12: the line ends before 'z'");
  EXPECT_CONTAINS(failure(good + "1 2 3\n4 5 6 7\n6 7 8\n"), "bad.pcd:12: 3 fields are declared, but '7' follows");
  EXPECT_CONTAINS(failure(header("x y z", "4 4 4", "F F F", 1U << 31U, "binary") + "abc"),
                  "truncated: 2147483648 points");
  EXPECT_CONTAINS(failure(header("x y z", "4 4 4", "F F F", 0, "ascii")), "no points");
}

}  // namespace
}  // namespace atrium::io::pcd_test
