// The same file as other programs and editors spell it.
#include <unistd.h>

#include <csignal>
#include <thread>

#include "graph/api/mapped_file.hpp"
#include "text_files.hpp"

namespace atrium::io::spellings_test {
namespace {

const std::string mark = "\xEF\xBB\xBF";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

class Spellings : public TextFiles {
 protected:
  std::string failure(const std::string& name, const std::string& text) {
    return error_of([&] { mesh(name, text); });
  }
  /// That the four points are read in their order.
  void expect_points(const std::string& name, const std::string& text) {
    SCOPED_TRACE(name + ": " + quoted(text));
    Cloud cloud;
    EXPECT_EQ(error_of([&] { cloud = scan(name, text); }), "");
    ASSERT_EQ(cloud.size(), 4U);
    EXPECT_EQ(cloud.points[1], Eigen::Vector3f(1, 0, 0.5F));
    EXPECT_EQ(cloud.points[3], Eigen::Vector3f(0, 0, 2.5F));
  }
  static std::string quoted(const std::string& text) {
    return replaced(replaced(text.substr(0, 60), "\r", "\\r"), "\n", "\\n");
  }
};

const std::string ply_text =
    "ply\nformat ascii 1.0\ncomment of a test\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0.5\n0 1 0\n0 0 2.5\n3 0 1 2\n3 0 1 3\n";
const std::string pcd_text =
    "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 4\nHEIGHT 1\nPOINTS 4\n"
    "DATA ascii\n0 0 0\n1 0 0.5\n0 1 0\n0 0 2.5\n";
const std::string obj_text = "# of a test\nv 0 0 0\nv 1 0 0.5\nv 0 1 0\nv 0 0 2.5\nf 1 2 3\nf 1 2 4\n";
const std::string stl_text =
    "solid of a test\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0.5\nvertex 0 1 0\nendloop\nendfacet\n"
    "facet normal 0 1 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0.5\nvertex 0 0 2.5\nendloop\nendfacet\n"
    "endsolid of a test\n";
const std::string rows_text = "0 0 0\n1 0 0.5\n0 1 0\n0 0 2.5\n";
const std::string ptx_text =
    "2\n2\n0 0 9\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"
    "0.5 0 0 1\n1 0 0.5 1\n0 1 0 1\n0 0 2.5 1\n";

const std::vector<std::pair<std::string, std::string>> texts = {{"a.ply", ply_text},
                                                                {"a.pcd", pcd_text},
                                                                {"a.obj", obj_text},
                                                                {"a.stl", stl_text},
                                                                {"a.xyz", rows_text},
                                                                {"a.pts", "4\n" + rows_text},
                                                                {"a.csv", replaced("x y z\n" + rows_text, " ", ",")},
                                                                {"a.ptx", ptx_text}};

TEST_F(Spellings, LinesEndInAnyWay) {
  for (const auto& [name, text] : texts) {
    expect_points(name, text);
    expect_points(name, replaced(text, "\n", "\r\n"));
    expect_points(name, replaced(text, "\n", "\r"));
    std::string first = text, mixed;
    expect_points(name, first.replace(first.find('\n'), 1, "\r\n"));
    std::size_t lines = 0;
    const std::string ends[3] = {"\n", "\r", "\r\n"};
    for (const char c : text) mixed += c == '\n' ? ends[lines++ % 3] : std::string(1, c);
    expect_points(name, mixed);
    expect_points(name, text.substr(0, text.size() - 1));  // the last line has no end
  }
}

TEST_F(Spellings, MarksBlanksAndCapitalsAreRead) {
  const auto upper = [](std::string text) {
    for (char& c : text) c = static_cast<char>(std::toupper(c));
    return text;
  };
  for (const auto& [name, text] : texts) {
    expect_points(name, mark + text);
    expect_points(name, replaced(text, "\n", " \n"));
    expect_points(name, replaced(text, "\n", "\t \r\n"));
    expect_points(name, upper(text));
  }
  expect_points("a.stl", " \n" + stl_text);
}

TEST_F(Spellings, ErrorsNameTheLineWhateverItsEnd) {
  for (const std::string end : {"\n", "\r", "\r\n"}) {
    const std::string broken = replaced(replaced(rows_text, "1 0 0.5", "1 zero 0.5"), "\n", end);
    EXPECT_CONTAINS(failure("a.xyz", broken), "a.xyz:2: 'zero' is not a number");
    EXPECT_CONTAINS(failure("a.obj", replaced(replaced(obj_text, "1 0 0.5", "1 zero 0.5"), "\n", end)),
                    "a.obj:3: 'zero' is not a number");
    EXPECT_CONTAINS(failure("a.stl", replaced(replaced(stl_text, "outer", "inner"), "\n", end)),
                    "a.stl:3: unknown keyword 'inner'");
  }
}

TEST_F(Spellings, TheBodyBehindABinaryHeaderBeginsWhereItsLineEnds) {
  // The first byte of the body is that of a line feed: 0x0A.
  std::string body;
  for (int i = 0; i < 4; ++i)
    for (int a = 0; a < 3; ++a) put<std::uint16_t>(body, static_cast<std::uint16_t>(i == 0 ? 10 : 2 * i + a));
  const std::string head =
      "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty ushort x\nproperty ushort y\nproperty ushort "
      "z\nend_header\n";
  for (const std::string end : {"\n", "\r", "\r\n"}) {
    const Cloud cloud = scan("b.ply", replaced(head, "\n", end) + body);
    ASSERT_EQ(cloud.size(), 4U);
    EXPECT_EQ(cloud.points[0], Eigen::Vector3f(10, 10, 10));
    EXPECT_EQ(cloud.points[3], Eigen::Vector3f(6, 7, 8));
  }
}

TEST_F(Spellings, NumbersMayStandInAnyLines) {
  const auto broken = [](const std::string& text, std::size_t body, const std::string& between) {
    return text.substr(0, body) + replaced(replaced(text.substr(body), "\n", " "), " ", between);
  };
  const std::size_t ply_body = ply_text.find("end_header\n") + 11, pcd_body = pcd_text.find("ascii\n") + 6;
  for (const std::string between : {"\n", " "}) {  // one number a line; all in one line
    expect_points("a.ply", broken(ply_text, ply_body, between));
    expect_points("a.pcd", broken(pcd_text, pcd_body, between));
    EXPECT_EQ(mesh("a.ply", broken(ply_text, ply_body, between)).triangles.size(), 2U);
  }
  const std::string name_line = stl_text.substr(0, stl_text.find('\n') + 1);
  expect_points("a.stl", name_line + replaced(stl_text.substr(name_line.size()), "\n", " "));
  const std::string unnamed = replaced(stl_text.substr(name_line.size()), "endsolid of a test", "endsolid");
  expect_points("a.stl", name_line + replaced(unnamed, " ", "\n"));
  // One number too few here and one too many there is no layout.
  EXPECT_CONTAINS(failure("a.ply", replaced(ply_text, "1 0 0.5\n0 1 0\n", "1 0\n0.5 0 1 0\n")),
                  "a.ply:12: vertex has 3 properties, but the line ends before 'z'");
  EXPECT_CONTAINS(failure("a.pcd", replaced(pcd_text, "1 0 0.5\n0 1 0\n", "1 0\n0.5 0 1 0\n")),
                  "a.pcd:12: the line ends before 'z'");
  EXPECT_CONTAINS(failure("a.ply", broken(replaced(ply_text, "3 0 1 3", "3 0 1 7"), ply_body, "\n")),
                  "vertex 7, but there are 4 vertices (0 to 3) (lines are counted as if");
}

TEST_F(Spellings, ObjLinesGoOnAndCornersHaveEmptyParts) {
  const std::string more =
      "v 0 0 0 # a corner\nv 1 \\\n0 \\\r\n 0.5\nv 0 1 0\nv 0 0 2.5\nvn 0 0 1\nmtllib C:\\models\\\nf 1// \\\n2// 3//\n"
      "f 1/1/ 2/ 4/ # done\n";
  expect_points("a.obj", more);
  const Mesh read = mesh("a.obj", more);
  ASSERT_EQ(read.triangles.size(), 2U);
  EXPECT_EQ(read.triangles[1], (std::array<std::uint32_t, 3>{0, 1, 3}));
  EXPECT_CONTAINS(failure("a.obj", replaced(more, "2/ 4/", "2/ 7/")),
                  "a.obj:11: a face's corner is vertex 7, but there are 4 vertices (1 to 4)");
  EXPECT_CONTAINS(failure("a.obj", replaced(more, "1/1/", "1/1/1/1")), "a.obj:11: '1/1/1/1' is not a face's corner");
  mesh("a.obj", obj_text + "cstype bezier\nsurf 0 1 0 1 1 2 3 4\n");
  EXPECT_TRUE(warned("1 curved surface or patch is not read")) << warnings();
}

TEST_F(Spellings, StripsOfTrianglesAreRead) {
  const std::string head =
      "element vertex 6\nproperty float x\nproperty float y\nproperty float z\nelement tristrips 1\n"
      "property list int int vertex_indices\nend_header\n";
  const float numbers[6][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {5, 0, 0}, {6, 0, 0}};
  const std::vector<std::int32_t> strip = {0, 1, 2, 3, -1, 4, 5, 5, 3, 0};
  std::string text = "ply\nformat ascii 1.0\n" + head;
  std::string binary = "ply\nformat binary_big_endian 1.0\n" + head;
  for (const auto& p : numbers) {
    for (const float v : p) put(binary, v, true);
    text += std::to_string(p[0]) + " " + std::to_string(p[1]) + " 0\n";
  }
  put(binary, static_cast<std::int32_t>(strip.size()), true);
  text += std::to_string(strip.size());
  for (const auto v : strip) {
    put(binary, v, true);
    text += " " + std::to_string(v);
  }
  for (const std::string& whole : {text + "\n", binary}) {
    const Mesh read = mesh("s.ply", whole);
    // Every other triangle is turned, -1 begins anew, triangles with a corner twice only lead on.
    EXPECT_EQ(read.triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {2, 1, 3}, {5, 3, 0}}));
  }
  EXPECT_TRUE(host->warnings.empty()) << warnings();
}

TEST_F(Spellings, FacesThatAreNotReadAreSaid) {
  mesh("a.ply", replaced(ply_text, "element face", "element patches"));
  EXPECT_TRUE(warned("2 records of element 'patches' not read: faces are read of the elements")) << warnings();
  host->warnings.clear();
  mesh("a.ply", replaced(ply_text, "vertex_indices", "corners_of_it"));
  EXPECT_TRUE(warned("2 records of element 'face' not read: they have no list 'vertex_indices'")) << warnings();
}

TEST_F(Spellings, StlHasManySpellings) {
  for (const std::string& whole :
       {replaced(stl_text, "endsolid", "end solid"), replaced(stl_text, "endloop", "end loop"),
        replaced(stl_text, "endfacet", "END FACET"),
        replaced(stl_text, "normal 0 0 1", "normal nan -nan(ind) 1.#QNAN")})
    expect_points("a.stl", whole);
  std::string binary(84, '\0');
  const float corners[2][9] = {{0, 0, 0, 1, 0, 0.5F, 0, 1, 0}, {0, 0, 0, 1, 0, 0.5F, 0, 0, 2.5F}};
  for (const auto& facet : corners) {
    binary += std::string(12, '\0');
    for (const float v : facet) put(binary, v);
    binary += std::string(2, '\0');
  }
  for (const char count : {'\0', '\xFF'}) {
    expect_points("a.stl", std::string(binary).replace(80, 4, std::string(4, count)));
    EXPECT_TRUE(warned("facets are declared, but 2 follow: all are read")) << warnings();
  }
  EXPECT_EQ(mesh("a.stl", std::string(binary).replace(80, 1, "\1")).triangles.size(), 1U);
  EXPECT_TRUE(warned("1 facet is declared, and 50 bytes more follow: these are not read")) << warnings();
  EXPECT_CONTAINS(error_of([&] { scan("a.stl", binary.substr(0, 84)); }), "a.stl: no points");
  EXPECT_CONTAINS(error_of([&] { scan("a.stl", "solid a\nendsolid a\n"); }), "a.stl: no points");
}

TEST_F(Spellings, PackedColoursOfPcdMayBeWholeNumbers) {
  for (const std::string type : {"F", "U", "I", "f"}) {
    const auto row = [&](const std::string& colour) { return "1 2 3 " + colour + "\n"; };
    const std::string head = "VERSION 0.7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F " + type +
                             "\nCOUNT 1 1 1 1\nWIDTH 4\nHEIGHT 1\nPOINTS 4\nDATA ascii\n";
    const Cloud cloud = scan("c.pcd", head + row("16711935") + row("-16776961") + row("4278190335") + row("0"));
    EXPECT_EQ(cloud.colours, (std::vector<Colour>{{255, 0, 255}, {0, 0, 255}, {0, 0, 255}, {0, 0, 0}})) << type;
  }
}

TEST_F(Spellings, AColourALittleAboveItsRangeDoesNotChangeTheOthers) {
  const auto rows = [](const std::string& first) {
    std::string text = "x y z r g b\n" + first;
    for (int i = 0; i < 5; ++i) text += "1 2 " + std::to_string(i) + " 0.5 0.25 0\n";
    return text;
  };
  const Cloud one = scan("c.xyz", rows("0 0 0 1.02 0.1 0.2\n"));
  EXPECT_EQ(one.colours.at(0), (Colour{255, 26, 51}));
  EXPECT_EQ(one.colours.at(1), (Colour{128, 64, 0}));
  EXPECT_TRUE(warned("1 of the colours' values are above 1, the largest is 1.02: they are cut to it")) << warnings();
  const Cloud byte = scan("c.xyz", replaced(rows("0 0 0 255.4 26 51\n"), "0.5 0.25", "128 64"));
  EXPECT_EQ(byte.colours.at(0), (Colour{255, 26, 51}));
  EXPECT_EQ(byte.colours.at(1), (Colour{128, 64, 0}));
  const Cloud wide = scan("c.xyz", replaced(rows("0 0 0 65535 0 257\n"), "0.5 0.25", "32896 16448"));
  EXPECT_EQ(wide.colours.at(0), (Colour{255, 0, 1}));
  EXPECT_EQ(wide.colours.at(1), (Colour{128, 64, 0}));
}

TEST_F(Spellings, AnImageOfPointsIsSeenFromZeroOnlyIfItIs) {
  constexpr int width = 64, height = 48;
  const auto image = [&](const Eigen::Vector3d& shift) {
    std::string text =
        "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 64\nHEIGHT 48\n"
        "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 3072\nDATA ascii\n";
    for (int r = 0; r < height; ++r)
      for (int c = 0; c < width; ++c) {
        // A floor, a wall 4 m away, and a box before it; a camera 1.2 m above the floor that looks along z.
        const Eigen::Vector3d ray((c - 31.5) / 60, (r - 23.5) / 60, 1);
        double depth = 4;
        if (ray.y() > 0) depth = std::min(depth, 1.2 / ray.y());
        if (c > 20 && c < 35 && r > 15) depth = std::min(depth, 2.0);
        const Eigen::Vector3d p = depth * ray + shift;
        text += std::to_string(p.x()) + " " + std::to_string(p.y()) + " " + std::to_string(p.z()) + "\n";
      }
    return text;
  };
  EXPECT_EQ(scan("i.pcd", image({0, 0, 0})).sensors.size(), 1U);
  EXPECT_FALSE(warned("are no image")) << warnings();
  for (const auto& shift :
       {Eigen::Vector3d(2, 1, -3), Eigen::Vector3d(0, 0, 40), Eigen::Vector3d(500000, 5400000, 0)}) {
    host->warnings.clear();
    EXPECT_TRUE(scan("i.pcd", image(shift)).sensors.empty()) << shift.transpose();
    EXPECT_TRUE(warned("its points are no image: they may be in the frame of a map")) << warnings();
  }
}

TEST_F(Spellings, HintsAtUnitsAndEmptyBodies) {
  const auto room = [](double factor) {
    std::string text;
    for (int i = 0; i < 1000; ++i) {
      const int face = i % 3, u = i / 3 % 20, v = i / 60;
      const double a = u / 19.0, b = v / 16.0;
      const Eigen::Vector3d p = face == 0   ? Eigen::Vector3d(7.1 * a, 3 * b, 0)
                                : face == 1 ? Eigen::Vector3d(7.1 * a, 0, 2.6 * b)
                                            : Eigen::Vector3d(0, 3 * a, 2.6 * b);
      text += std::to_string(factor * p.x()) + " " + std::to_string(factor * p.y()) + " " +
              std::to_string(factor * p.z()) + "\n";
    }
    return text;
  };
  scan("u.xyz", room(1));
  EXPECT_FALSE(warned("the extent is")) << warnings();
  scan("u.xyz", room(100));
  EXPECT_TRUE(warned("710 × 300 × 260 m: if these are centimetres, set unit: cm (then it is 7.1 × 3 × 2.6 m)"))
      << warnings();
  scan("u.xyz", room(0.27));
  EXPECT_TRUE(warned("the extent is 1.92 × 0.81 × 0.702 m, less than a room's: if the file is in another unit"))
      << warnings();
  std::string zeros = "x,y,z\n";
  for (int i = 0; i < 30000; ++i) zeros += "0,0,0\n";
  scan("z.csv", zeros);
  EXPECT_TRUE(warned("all 30000 points lie in one place, the first at 0 0 0")) << warnings();
}

/// Writes the bytes into a pipe from another thread.
class Fed {
 public:
  Fed(int to, std::string bytes)
      : thread_([to, bytes = std::move(bytes)] {
          for (std::size_t at = 0; at < bytes.size();) {
            const ssize_t put = ::write(to, bytes.data() + at, bytes.size() - at);
            if (put <= 0) break;
            at += static_cast<std::size_t>(put);
          }
          ::close(to);
        }) {}
  ~Fed() { thread_.join(); }

 private:
  std::thread thread_;
};

TEST_F(Spellings, ScansComeThroughPipes) {
  for (const auto& [name, text] : texts) {
    SCOPED_TRACE(name);
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    const Fed fed(ends[1], text);
    ReadScan::Params params;
    params.path = {{"/dev/fd/" + std::to_string(ends[0])}};
    params.mesh = ReadScan::MeshUse::vertices;
    for (int again = 0; again < 2; ++again)  // who reads it again gets the same
      EXPECT_EQ(ReadScan::run(params, context).cloud.size(), 4U);
    ::close(ends[0]);
  }
}

TEST_F(Spellings, PipesThatCannotBeReadSaySo) {
  std::signal(SIGPIPE, SIG_IGN);
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  const std::string place = "/dev/fd/" + std::to_string(ends[0]);
  {
    const Fed fed(ends[1], std::string(40000, 'a'));
    EXPECT_CONTAINS(error_of([&] { MappedFile(place, MappedFile::Kinds::all, 10000); }),
                    place + ": more than 10000 bytes come through this pipe, which has to fit into memory");
    ::close(ends[0]);
  }
  ASSERT_EQ(::pipe(ends), 0);
  ::close(ends[1]);
  ReadScan::Params params;
  params.path = {{"/dev/fd/" + std::to_string(ends[0])}};
  EXPECT_CONTAINS(error_of([&] { ReadScan::run(params, context); }), "nothing came through the pipe");
  ::close(ends[0]);
  params.path = {{"/dev/zero"}};
  EXPECT_CONTAINS(error_of([&] { ReadScan::run(params, context); }), "cannot read /dev/zero: it is a device");
}

}  // namespace
}  // namespace atrium::io::spellings_test
