#include <fmt/format.h>

#include <functional>

#include "files.hpp"
#include "graph/api/clocks.hpp"
#include "graph/api/mapped_file.hpp"
#include "modules/io/read_mesh.hpp"
#include "modules/io/read_scan.hpp"
#include "modules/io/read_vg.hpp"
#include "modules/io/write_cloud.hpp"
#include "modules/io/write_mesh.hpp"
#include "modules/io/write_vg.hpp"

namespace atrium::io::robustness_test {
namespace {

/// Small files of every format. Whatever is done to them, a reader gives a value or throws Error: it never crashes,
/// hangs or reads what is not there (tests/sanitize runs this with AddressSanitizer; tests/fuzz looks for what is worse
/// than these edits, and for memory that the file's size does not justify).
class Robustness : public Files {
 protected:
  Robustness() {
    Cloud cloud;
    PlanePrimitive plane;
    Random random(5);
    for (std::uint32_t i = 0; i < 12; ++i) {
      cloud.points.emplace_back(random.uniform(-3, 3), random.uniform(-3, 3), 1.0F);
      cloud.normals.emplace_back(0, 0, 1);
      cloud.colours.push_back({static_cast<std::uint8_t>(20 * i), 100, 3});
      cloud.intensities.push_back(0.5F);
      cloud.labels.push_back(static_cast<std::int32_t>(i));
      plane.inliers.push_back(i);
    }
    cloud.sensors = {{0.5F, 1, 2}};
    plane.plane.offset = -1;
    for (const std::string name : {"binary.ply", "binary.pcd", "binary.e57", "binary.las", "binary.laz"})
      WriteCloud::run({input(cloud)}, {{name}, true}, context);
    for (const std::string name : {"text.ply", "text.pcd", "text.xyz", "text.csv"})
      WriteCloud::run({input(cloud)}, {{name}, false}, context);
    Mesh mesh;
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}};
    mesh.classes = {SurfaceClass::floor, SurfaceClass::wall, SurfaceClass::wall};
    mesh.primitives = {0, 1, 2};
    for (const std::string name : {"mesh.ply", "mesh.obj", "mesh.stl"})
      WriteMesh::run({input(mesh)}, {{name}, true}, context);
    for (const std::string name : {"mesh_text.ply", "mesh_text.stl"})
      WriteMesh::run({input(mesh)}, {{name}, false}, context);
    const PlanePrimitives planes{std::make_shared<const Cloud>(cloud), {plane}};
    for (const std::string name : {"planes.vg", "planes.bvg"}) WriteVg::run({input(planes)}, {{name}}, context);
    std::string data;
    for (int i = 0; i < 12; ++i) put(data, 0.5F * static_cast<float>(i * i));
    std::string compressed =
        "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 4\nHEIGHT 1\nPOINTS 4\nDATA "
        "binary_compressed\n";
    put<std::uint32_t>(compressed, 50);
    put<std::uint32_t>(compressed, 48);
    compressed += '\x1F' + data.substr(0, 32) + '\x0F' + data.substr(32);
    file("compressed.pcd", compressed);
    std::string grid = "3\n4\n1 2 3\n1 0 0\n0 1 0\n0 0 1\n0 1 0 0\n-1 0 0 0\n0 0 1 0\n5 5 5 1\n";
    for (int i = 0; i < 12; ++i) grid += fmt::format("{} {} 1 0.5 {} 7 9\n", i % 4, i / 4, i);
    file("grid.ptx", grid + grid);
  }

  /// True if the file was read, false if an Error was thrown; anything else is a failure.
  bool read(const std::string& name) {
    try {
      const std::string place = path(name);
      if (name.ends_with("vg")) {
        const auto planes = ReadVg::run({{place}}, context).planes;
        for (const auto& p : planes.primitives)
          for (const auto i : p.inliers) EXPECT_LT(i, planes.cloud->size());
        return true;
      }
      ReadScan::Params params;
      params.path = {{place}};
      params.mesh = ReadScan::MeshUse::vertices;
      const Cloud cloud = ReadScan::run(params, context).cloud;
      for (const auto& p : cloud.points) EXPECT_TRUE(p.allFinite());
      for (const std::size_t size : {cloud.normals.size(), cloud.colours.size(), cloud.intensities.size()})
        EXPECT_TRUE(size == 0 || size == cloud.size());
      if (name.ends_with(".e57") || name.ends_with(".las") || name.ends_with(".laz") || name.ends_with(".ptx"))
        return true;  // no meshes
      const Mesh mesh = ReadMesh::run({{place}}, context).mesh;
      for (const auto& t : mesh.triangles)
        for (const auto corner : t) EXPECT_LT(corner, mesh.vertices.size());
      return true;
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find(name), std::string::npos) << e.what();
      return false;
    }
  }

  const std::vector<std::string> names = {"binary.ply",    "text.ply",   "mesh.ply",   "mesh_text.ply",  "binary.pcd",
                                          "text.pcd",      "text.xyz",   "text.csv",   "mesh.obj",       "mesh.stl",
                                          "mesh_text.stl", "planes.vg",  "planes.bvg", "compressed.pcd", "binary.e57",
                                          "binary.las",    "binary.laz", "grid.ptx"};
};

TEST_F(Robustness, TheWholeFilesAreRead) {
  for (const auto& name : names) EXPECT_TRUE(read(name)) << name;
}

TEST_F(Robustness, FilesCutAnywhereAreReadOrRefused) {
  for (const auto& name : names) {
    const std::string whole = content(name);
    std::size_t refused = 0;
    for (std::size_t length = 0; length < whole.size(); ++length) {
      file(name, whole.substr(0, length));
      SCOPED_TRACE(name + " cut to " + std::to_string(length));
      const bool was_read = read(name);
      refused += was_read ? 0 : 1;
      // Binary data have an end that is known to the byte; text may lose its last digits unnoticed.
      if (name.starts_with("binary") || name == "mesh.ply" || name == "mesh.stl" || name.starts_with("compressed") ||
          name.ends_with(".bvg")) {
        EXPECT_FALSE(was_read);
      }
    }
    EXPECT_GT(refused, whole.size() / 8) << name;
    file(name, whole);
  }
}

TEST_F(Robustness, DamagedFilesAreReadOrRefused) {
  Random random(11);
  const std::vector<std::string> tokens = {
      "nan",    "-1",        "1e308", "99999999999999999999", "4294967295", "inf",
      "0",      "\n",        " ",     std::string(1, '\0'),   "list",       "property float x\n",
      "vertex", "2147483648"};
  for (const auto& name : names) {
    const std::string whole = content(name);
    for (int trial = 0; trial < 500; ++trial) {
      std::string bytes = whole;
      for (std::uint64_t edit = 1 + random.index(4); edit > 0 && !bytes.empty(); --edit) {
        const std::size_t at = random.index(bytes.size());
        switch (random.index(5)) {
          case 0: bytes[at] = static_cast<char>(random.index(256)); break;
          case 1: bytes[at] = static_cast<char>(bytes[at] ^ (1 << random.index(8))); break;
          case 2: bytes.erase(at, 1 + random.index(8)); break;
          case 3: bytes.insert(at, bytes.substr(random.index(bytes.size()), random.index(40))); break;
          default: bytes.insert(at, tokens[random.index(tokens.size())]);
        }
      }
      SCOPED_TRACE(name + " trial " + std::to_string(trial));
      file(name, bytes);
      read(name);
    }
    file(name, whole);
  }
}

TEST_F(Robustness, PagesThatAreGivenBackAreReadAgain) {
  constexpr std::size_t size = std::size_t{16} << 20U;
  const MappedFile mapped(file("pages.ply", std::string(size, 'a')));
  const auto sum = [&] { return std::count(mapped.text().begin(), mapped.text().end(), 'a'); };
  EXPECT_EQ(sum(), size);
  const std::uint64_t with = resident_memory();
  mapped.drop_pages();
  EXPECT_LT(resident_memory() + size / 2, with);
  EXPECT_EQ(sum(), size);
}

TEST_F(Robustness, AFileThatIsCutShortWhileItIsReadIsNamed) {
  ::testing::FLAGS_gtest_death_test_style = "threadsafe";
  const std::string place = file("shrinks.ply", std::string(100'000, 'a'));
  EXPECT_EXIT(
      {
        const MappedFile mapped(place);
        std::filesystem::resize_file(place, 10);
        std::exit(mapped.text()[90'000] == 'a' ? 2 : 3);
      },
      ::testing::ExitedWithCode(1), "shrinks.ply: the file was cut short while it was read");
}

}  // namespace
}  // namespace atrium::io::robustness_test
