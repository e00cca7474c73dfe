// Every format with everything that may be odd about a file: one table of formats, one test for each oddity.
#include <sys/resource.h>
#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "modules/io/read_scan.hpp"
#include "modules/io/write_cloud.hpp"
#include "modules/io/write_mesh.hpp"
#include "modules/io/write_vg.hpp"
#include "point_files.hpp"

namespace atrium::io::matrix_test {
namespace {

using namespace point_files;

class Matrix : public Files {
 protected:
  Matrix() { std::signal(SIGXFSZ, SIG_IGN); }

  const Points five = {
      {"0.5", "0.25", "0.125"}, {"1", "0", "0.5"}, {"0", "1", "0.25"}, {"0", "0", "2.5"}, {"1.5", "2", "1"}};

  std::string laz(const Points& points) {
    Cloud cloud;
    for (const auto& p : points)
      cloud.points.push_back(Eigen::Vector3d(number(p[0]), number(p[1]), number(p[2])).cast<float>());
    const Eigen::Vector3d first =
        points.empty() ? Eigen::Vector3d::Zero() : Eigen::Vector3d(number(points[0][0]), number(points[0][1]), 0);
    if (first.norm() > 1000) {
      cloud.origin = first.array().floor();
      for (std::size_t i = 0; i < points.size(); ++i)
        cloud.points[i] =
            (Eigen::Vector3d(number(points[i][0]), number(points[i][1]), number(points[i][2])) - cloud.origin)
                .cast<float>();
    }
    WriteCloud::run({input(cloud)}, {{"made.laz"}, true}, context);
    return content("made.laz");
  }

  std::vector<Format> formats() {
    const auto ply_count = [](std::string t) { return replace_all(t, "vertex 5", "vertex 1000000000"); };
    const auto pcd_count = [](std::string t) {
      return replace_all(replace_all(t, "WIDTH 5", "WIDTH 1000000000"), "POINTS 5", "POINTS 1000000000");
    };
    const auto first_line = [](std::string t) { return t.replace(0, 1, "1000000000"); };
    return {
        {"rows.xyz", [](const Points& p) { return rows(p); }, true},
        {"rows.csv", [](const Points& p) { return "x,y,z\n" + rows(p, "", "", ","); }, true},
        {"rows.pts", [](const Points& p) { return std::to_string(p.size()) + "\n" + rows(p); }, true, "", true, true,
         first_line},
        {"rows.ptx", ptx, true, "", true, true, first_line},
        {"text.ply", [](const Points& p) { return ply(p, "ascii", rows(p)); }, true, "", true, true, ply_count},
        {"text.pcd", [](const Points& p) { return pcd(p, "ascii", rows(p)); }, true, "", true, true, pcd_count},
        {"text.obj", [](const Points& p) { return "# of a test\n" + rows(p, "v "); }, true},
        {"text.stl", text_stl, true},
        {"little.ply", [](const Points& p) { return ply(p, "binary_little_endian", numbers<double>(p)); }, false,
         "end_header\n", true, true, ply_count},
        {"big.ply", [](const Points& p) { return ply(p, "binary_big_endian", numbers<double>(p, true)); }, false,
         "end_header\n", true, true, ply_count},
        {"binary.pcd", [](const Points& p) { return pcd(p, "binary", numbers<double>(p)); }, false, "DATA binary\n",
         true, true, pcd_count},
        {"packed.pcd", compressed_pcd, false, "DATA binary_compressed\n", true, true, pcd_count},
        {"binary.stl", binary_stl, false, "", true, false, [](std::string b) { return put_count(std::move(b), 80); }},
        {"points.glb", [](const Points& p) { return gltf(p).glb(); }, false, "", true, false,
         [this](const std::string&) {
           return test::glb_file(replace_all(gltf(five).json(), "count\":5", "count\":1000000000"), gltf(five).binary);
         }},
        {"points.gltf", [](const Points& p) { return gltf(p).gltf(); }, false, "", true, false,
         [](const std::string& t) { return replace_all(t, "count\":5", "count\":1000000000"); }},
        {"scan.e57", [](const Points& p) { return e57(p); }, false, "", true, true,
         [this](const std::string&) { return e57(five, 1000000000); }},
        {"scan.las", las, false, "", false, true, [](std::string b) { return put_count(std::move(b), 107); }},
        {"scan.laz", [this](const Points& p) { return laz(p); }, false, "", false, true,
         [](std::string b) { return put_count(std::move(b), 107); }},
    };
  }

  Cloud read(const std::string& name) {
    ReadScan::Params params;
    params.path = {{path(name)}};
    params.mesh = ReadScan::MeshUse::vertices;
    return ReadScan::run(params, context).cloud;
  }
  /// The message of the Error; "" if the file is read.
  std::string outcome(const std::string& name) {
    return error_of([&] { read(name); });
  }
  void expect_read(const Format& format, const std::string& bytes, const Points& points) {
    file(format.name, bytes);
    Cloud cloud;
    ASSERT_EQ(error_of([&] { cloud = read(format.name); }), "") << format.name;
    expect_same(cloud, points);
  }
  static void expect_same(const Cloud& cloud, const Points& points) {
    ASSERT_EQ(cloud.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t a = 0; a < 3; ++a)
        EXPECT_NEAR(cloud.origin[static_cast<int>(a)] + static_cast<double>(cloud.points[i][static_cast<int>(a)]),
                    number(points[i][a]), 1e-4);
  }
  /// Read, or refused with a message that names the file.
  void expect_read_or_refused(const std::string& name) {
    const std::string message = outcome(name);
    if (!message.empty()) {
      EXPECT_CONTAINS(message, name);
    }
  }
};

TEST_F(Matrix, LineEndsMarksCapitalsAndBlanks) {
  const auto upper = [](std::string text) {
    for (char& c : text) c = static_cast<char>(std::toupper(c));
    return text;
  };
  for (const auto& format : formats()) {
    if (!format.text && format.end_of_header.empty()) continue;
    const std::string whole = format.make(five);
    const std::size_t body =
        format.text ? whole.size() : whole.find(format.end_of_header) + format.end_of_header.size();
    const std::string head = whole.substr(0, body), rest = whole.substr(body);
    expect_read(format, whole, five);
    const std::string odd[] = {
        replace_all(head, "\n", "\r\n"),   replace_all(head, "\n", "\r"),          "\xEF\xBB\xBF" + head, upper(head),
        replace_all(head, "\n", " \t \n"), replace_all(upper(head), "\n", " \r\n")};
    for (std::size_t i = 0; i < std::size(odd); ++i) {
      SCOPED_TRACE(format.name + ", oddity " + std::to_string(i));
      expect_read(format, odd[i] + rest, five);
    }
  }
  EXPECT_TRUE(host->warnings.empty()) << warnings();
}

TEST_F(Matrix, CutShortAndOneBitOfEachByteFlipped) {
  for (const auto& format : formats()) {
    const std::string whole = format.make(five);
    for (std::size_t length = 0; length < whole.size(); length += 64) {
      SCOPED_TRACE(format.name + " cut to " + std::to_string(length));
      file(format.name, whole.substr(0, length));
      expect_read_or_refused(format.name);
      if (!format.text) {
        EXPECT_NE(outcome(format.name), "");
      }
    }
    // The pages of an E57 file have checksums: each finds what was flipped, so some bytes of each are enough.
    const std::size_t step = whole.size() > 1500 ? 7 : 1;
    for (std::size_t at = 0; at < whole.size(); at += step) {
      SCOPED_TRACE(format.name + " flipped at " + std::to_string(at));
      std::string bytes = whole;
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << at % 8));
      file(format.name, bytes);
      expect_read_or_refused(format.name);
    }
  }
}

TEST_F(Matrix, NoPointAndOnePointAreErrorsThatSaySo) {
  for (const auto& format : formats()) {
    for (std::size_t count = 0; count < 2; ++count) {
      SCOPED_TRACE(format.name + " of " + std::to_string(count) + " points");
      file(format.name, format.make({five.begin(), five.begin() + static_cast<std::ptrdiff_t>(count)}));
      const std::string message = outcome(format.name);
      EXPECT_CONTAINS(message, format.name);
      EXPECT_TRUE(message.find("point") != std::string::npos || message.find("empty") != std::string::npos) << message;
    }
  }
}

TEST_F(Matrix, NumbersThatAreNotFiniteAreDroppedAndCounted) {
  for (const auto& format : formats()) {
    if (!format.any_number) continue;
    for (const std::string odd : {"nan", "inf", "-inf", "1e300"}) {
      SCOPED_TRACE(format.name + " with " + odd);
      host->warnings.clear();
      Points points = five, left = five;
      points[3][1] = odd;
      left.erase(left.begin() + 3);
      expect_read(format, format.make(points), left);
      EXPECT_TRUE(warned("1 of 5 points dropped")) << warnings();
    }
  }
}

TEST_F(Matrix, CoordinatesOfAMapKeepTheirMillimetres) {
  Points points = five;
  for (auto& p : points) {
    p[0] = "500000" + p[0].substr(1);
    p[1] = "5400000" + p[1].substr(1);
  }
  for (const auto& format : formats()) {
    SCOPED_TRACE(format.name);
    host->warnings.clear();
    file(format.name, format.make(points));
    const Cloud cloud = read(format.name);
    if (format.keeps_utm) {
      expect_same(cloud, points);
    } else {
      EXPECT_TRUE(warned("as float32 is so far from zero: what was finer is lost")) << warnings();
    }
  }
}

TEST_F(Matrix, PointsThatAreDeclaredButNotThereCostNothing) {
  const auto peak = [] {
    struct rusage usage {};
    ::getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;  // kilobytes
  };
  for (const auto& format : formats()) {
    if (!format.declare) continue;
    SCOPED_TRACE(format.name);
    file(format.name, format.declare(format.make(five)));
    const auto before = peak();
    const auto start = std::chrono::steady_clock::now();
    EXPECT_CONTAINS(outcome(format.name), format.name);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(1));
    EXPECT_LT(peak() - before, 50000);
  }
}

TEST_F(Matrix, APipeGivesWhatAFileGives) {
  for (const auto& format : formats()) {
    SCOPED_TRACE(format.name);
    const std::string bytes = format.make(five), place = path(format.name);
    std::filesystem::remove(place);
    ASSERT_EQ(::mkfifo(place.c_str(), 0600), 0);
    std::thread feed([&] { std::ofstream(place, std::ios::binary) << bytes; });
    Cloud cloud;
    const std::string message = error_of([&] { cloud = read(format.name); });
    feed.join();
    EXPECT_EQ(message, "");
    expect_same(cloud, five);
    std::filesystem::remove(place);
  }
}

TEST_F(Matrix, WritersThatCannotWriteSaySoAndLeaveNothing) {
  Cloud cloud;
  PlanePrimitive plane;
  Mesh mesh;
  for (std::uint32_t i = 0; i < 4000; ++i) {
    cloud.points.emplace_back(static_cast<float>(i % 61), static_cast<float>(i % 67), static_cast<float>(i % 71));
    plane.inliers.push_back(i);
    mesh.vertices.push_back(cloud.points.back().cast<double>());
    if (i > 1) mesh.triangles.push_back({i - 2, i - 1, i});
  }
  const PlanePrimitives planes{std::make_shared<const Cloud>(cloud), {plane}};
  std::vector<std::pair<std::string, std::function<void(const std::string&)>>> writers;
  for (const std::string end : {".ply", ".pcd", ".e57", ".las", ".laz", ".xyz", ".txt", ".csv"})
    for (const bool binary : {true, false})
      writers.emplace_back(end, [&, binary](const std::string& to) {
        WriteCloud::run({input(cloud)}, {{to}, binary}, context);
      });
  for (const std::string end : {".ply", ".obj", ".stl", ".glb"})
    writers.emplace_back(end, [&](const std::string& to) { WriteMesh::run({input(mesh)}, {{to}, true}, context); });
  for (const std::string end : {".vg", ".bvg"})
    writers.emplace_back(end, [&](const std::string& to) { WriteVg::run({input(planes)}, {{to}}, context); });
  file("no_folder", "a file");
  const auto left = [&] {
    return std::distance(std::filesystem::recursive_directory_iterator(folder),
                         std::filesystem::recursive_directory_iterator());
  };
  const auto before = left();
  for (const auto& [end, write] : writers) {
    SCOPED_TRACE(end);
    EXPECT_CONTAINS(error_of([&, &write = write, &end = end] { write("no_folder/it" + end); }), "no_folder");
    // No file may be larger than 1000 bytes: the system refuses as it does where a disk is full.
    struct rlimit whole {};
    ::getrlimit(RLIMIT_FSIZE, &whole);
    const struct rlimit little { 1000, whole.rlim_max };
    ::setrlimit(RLIMIT_FSIZE, &little);
    const std::string message = error_of([&, &write = write, &end = end] { write("it" + end); });
    ::setrlimit(RLIMIT_FSIZE, &whole);
    EXPECT_CONTAINS(message, "it" + end);
    EXPECT_EQ(left(), before);
  }
}

}  // namespace
}  // namespace atrium::io::matrix_test
