// DXF files are read back by an independent reader, ezdxf (Debian: python3-ezdxf); without it these tests are
// skipped, where nobody asks for all checks.
#include "modules/floorplan/write_dxf.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <csignal>
#include <nlohmann/json.hpp>

#include "modules/floorplan/dxf_drawing.hpp"
#include "tests/support/lacking.hpp"
#include "tests/unit/floorplan/buildings.hpp"

namespace atrium::floorplan::write_dxf_test {
namespace {

using nlohmann::json;

std::string python() { return test::python_with("ezdxf"); }

class Dxf : public testing::Test {
 protected:
  std::shared_ptr<Host> host = std::make_shared<Host>();
  Context context{1, host};
  std::filesystem::path file = host->folder / "floorplan.dxf";

  json read_back(const FloorPlan& plan, const WriteDxf::Params& params = {}) {
    WriteDxf::run({input(plan)}, params, context);
    const auto result =
        test::run_process({python(), ATRIUM_SOURCE_DIR "/tests/unit/floorplan/read_dxf.py", file.string()});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const json root = json::parse(result.out);
    for (const auto* complaint : {"errors", "fixes", "logged", "structure"})
      EXPECT_EQ(root[complaint], json::array()) << complaint;
    return root;
  }
};

double area_of(const json& points) {
  double twice = 0;
  const double x0 = points[0][0], y0 = points[0][1];
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto &a = points[i], &b = points[(i + 1) % points.size()];
    twice +=
        (a[0].get<double>() - x0) * (b[1].get<double>() - y0) - (b[0].get<double>() - x0) * (a[1].get<double>() - y0);
  }
  return 0.5 * twice;
}

std::vector<json> on(const json& root, const std::string& layer, const std::string& type) {
  std::vector<json> result;
  for (const auto& entity : root["entities"])
    if (entity["layer"] == layer && entity["type"] == type) result.push_back(entity);
  return result;
}

TEST_F(Dxf, IsReadBackWithoutErrorsInTrueSizeAndPlace) {
  if (python().empty()) ATRIUM_SKIP_LACKING("python3-ezdxf is not installed");
  Mesh mesh = two_rooms();
  mesh.origin = {500000.123, 5400000.456, 300};
  const json root = read_back(plan_of(mesh));
  EXPECT_EQ(root["version"], "AC1015");
  EXPECT_EQ(root["units"], 6);
  EXPECT_NEAR(root["view"][0], 500003.623, 0.001);
  EXPECT_NEAR(root["view"][1], 5400001.956, 0.001);
  const auto walls = on(root, "A-WALL", "LWPOLYLINE");
  ASSERT_EQ(walls.size(), 1U);
  EXPECT_TRUE(walls[0]["closed"].get<bool>());
  EXPECT_NEAR(area_of(walls[0]["points"]), 0.36, 1e-4);
  double low = 1e9, high = 0;
  for (const auto& p : walls[0]["points"]) {
    low = std::min(low, p[0].get<double>());
    high = std::max(high, p[0].get<double>());
    EXPECT_TRUE(std::abs(p[1].get<double>() - 5400000.456) < 1e-4 || std::abs(p[1].get<double>() - 5400003.456) < 1e-4);
  }
  EXPECT_NEAR(low, 500004.123, 1e-4);
  EXPECT_NEAR(high, 500004.243, 1e-4);
  const auto rooms = on(root, "A-AREA", "LWPOLYLINE");
  ASSERT_EQ(rooms.size(), 2U);
  EXPECT_NEAR(area_of(rooms[0]["points"]), 12, 1e-5);
  EXPECT_NEAR(area_of(rooms[1]["points"]), 8.64, 1e-5);
  EXPECT_EQ(on(root, "A-FLOR", "LWPOLYLINE").size(), 2U);
  EXPECT_EQ(on(root, "A-CLNG", "LWPOLYLINE").size(), 2U);
  EXPECT_EQ(on(root, "A-WALL-FACE", "LINE").size(), 6U);
  EXPECT_EQ(on(root, "A-WALL-CNTR", "LINE").size(), 1U);
  EXPECT_EQ(on(root, "A-AREA-IDEN", "TEXT").size(), 6U);
}

TEST_F(Dxf, OpeningsHaveLayersOfTheirOwn) {
  if (python().empty()) ATRIUM_SKIP_LACKING("python3-ezdxf is not installed");
  const json root = read_back(with_openings());
  const auto gaps = on(root, "A-DOOR", "LWPOLYLINE"), leaves = on(root, "A-DOOR", "LINE"),
             sweeps = on(root, "A-DOOR", "ARC");
  ASSERT_EQ(gaps.size(), 1U);
  EXPECT_NEAR(std::abs(area_of(gaps[0]["points"])), 0.9 * 0.12, 1e-6);
  ASSERT_EQ(leaves.size(), 1U);
  ASSERT_EQ(sweeps.size(), 1U);
  EXPECT_NEAR(sweeps[0]["radius"], 0.9, 1e-6);
  // Into the smaller room, at x > 4.12, hinged at the lower end, near the corner; counter-clockwise from open to
  // closed.
  const std::vector<Eigen::Vector2d> expected{{4.12, 0.5}, {5.02, 0.5}, {4.12, 1.4}};
  for (std::size_t i = 0; i < 3; ++i)
    for (int k = 0; k < 2; ++k) EXPECT_NEAR(sweeps[0]["points"][i][k], expected[i][k], 1e-6) << i;
  EXPECT_EQ(on(root, "A-GLAZ", "LWPOLYLINE").size(), 1U);
  EXPECT_EQ(on(root, "A-GLAZ", "LINE").size(), 2U);
  EXPECT_EQ(on(root, "A-FLOR-OVHD", "LWPOLYLINE").size(), 2U);
  EXPECT_EQ(on(root, "A-FLOR-OVHD", "LINE").size(), 2U) << "only the hole in the floor is crossed";
}

TEST_F(Dxf, DimensionsMeasureWhatTheyShow) {
  if (python().empty()) ATRIUM_SKIP_LACKING("python3-ezdxf is not installed");
  Mesh mesh = two_rooms();
  for (auto& v : mesh.vertices) v.head<2>() = Eigen::Rotation2Dd(0.5) * v.head<2>();
  WriteDxf::Params params;
  params.scale = 50;
  const json root = read_back(plan_of(mesh), params);
  const auto dimensions = on(root, "A-ANNO-DIMS", "DIMENSION");
  std::vector<std::string> texts;
  const double tilt = 0.5 * 180 / 3.14159265358979;
  for (const auto& d : dimensions) {
    texts.push_back(d["text"]);
    const double turn = d["text"] == "3.00" ? 90 : 0;
    EXPECT_NEAR(d["angle"], turn + tilt, 1e-6) << d["text"];
    EXPECT_NEAR(d["rotation"], turn + tilt, 1e-6) << d["text"];
    EXPECT_NEAR(d["height"], 0.1, 1e-9);
    EXPECT_EQ(d["style"], "ATRIUM");
    // What a program measures between the points, what the file says, and what it shows.
    EXPECT_NEAR(d["measured"], d["stated"], 1e-9);
    EXPECT_NEAR(d["stated"], std::stod(d["text"].get<std::string>()), 0.005);
    EXPECT_EQ(d["moved"], d["text"] == "0.12") << "there is no room for it between its lines";
    // A line with two extension lines and two ticks.
    EXPECT_EQ(d["shown"].size(), 6U);
    for (const auto& part : d["shown"]) EXPECT_EQ(part["layer"], "0") << "which is the layer of the dimension";
  }
  std::sort(texts.begin(), texts.end());
  EXPECT_EQ(texts, (std::vector<std::string>{"0.12", "2.88", "3.00", "4.00", "7.00"}));
  params.dimensions = false;
  EXPECT_TRUE(on(read_back(plan_of(mesh), params), "A-ANNO-DIMS", "DIMENSION").empty());
}

TEST_F(Dxf, MillimetresAndInchesScaleAllButThePaper) {
  if (python().empty()) ATRIUM_SKIP_LACKING("python3-ezdxf is not installed");
  Mesh mesh = two_rooms();
  mesh.origin = {500, 300, 0};
  struct Case {
    Units units;
    double per_metre;
    int unit, metric, style, decimals;
    std::string whole, area, height;
  };
  for (const auto& c :
       std::vector<Case>{{Units::millimetres, 1000, 4, 1, 2, 0, "7000", "12.00 m\u00B2", "h 2500 mm"},
                         {Units::feet, 1 / 0.0254, 1, 0, 4, 1, "22'-11 1/2\"", "129.2 sq ft", "h 8'-2 1/2\""}}) {
    WriteDxf::Params params;
    params.units = c.units;
    const json root = read_back(plan_of(mesh), params);
    EXPECT_EQ(root["units"], c.unit);
    EXPECT_EQ(root["metric"], c.metric);
    EXPECT_NEAR(root["view"][0], 503.5 * c.per_metre, 1e-6);
    const auto walls = on(root, "A-WALL", "LWPOLYLINE");
    ASSERT_EQ(walls.size(), 1U);
    EXPECT_NEAR(area_of(walls[0]["points"]), 0.36 * c.per_metre * c.per_metre, 1e-4 * c.per_metre * c.per_metre);
    std::vector<std::string> shown;
    for (const auto& d : on(root, "A-ANNO-DIMS", "DIMENSION")) {
      shown.push_back(d["text"]);
      EXPECT_NEAR(d["height"], 0.2 * c.per_metre, 1e-6) << "2 mm at 1:100";
      EXPECT_NEAR(d["measured"], d["stated"], 1e-6);
      EXPECT_EQ(d["unit"], c.style);
      EXPECT_EQ(d["decimals"], c.decimals);
    }
    for (const auto& text : on(root, "A-AREA-IDEN", "TEXT")) shown.push_back(text["text"]);
    for (const auto& text : {c.whole, c.area, c.height})
      EXPECT_NE(std::find(shown.begin(), shown.end(), text), shown.end()) << text;
  }
}

TEST_F(Dxf, TheReferenceSystemIsACommentAndANote) {
  if (python().empty()) ATRIUM_SKIP_LACKING("python3-ezdxf is not installed");
  json root = read_back(plan_of(two_rooms()));
  EXPECT_EQ(root["comment"], "Atrium floor plan; coordinates in metres in the frame of the scan");
  EXPECT_TRUE(on(root, "A-ANNO-NOTE", "TEXT").empty());
  WriteDxf::Params params;
  params.crs = "urn:ogc:def:crs:EPSG::25832";
  params.units = Units::millimetres;
  root = read_back(plan_of(two_rooms()), params);
  EXPECT_EQ(root["comment"], "Atrium floor plan; coordinates: EPSG:25832, in millimetres");
  const auto notes = on(root, "A-ANNO-NOTE", "TEXT");
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0]["text"], "coordinates: EPSG:25832, in millimetres");
  for (const auto& entity : root["entities"])
    for (const auto& p : entity["points"]) EXPECT_GE(p[1], notes[0]["points"][0][1]) << "it stands below the drawing";
  params.crs = "somewhere";
  std::filesystem::remove(file);
  EXPECT_THROW(WriteDxf::run({input(plan_of(two_rooms()))}, params, context), Error);
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST_F(Dxf, EachStoreyHasItsOwnLayers) {
  if (python().empty()) ATRIUM_SKIP_LACKING("python3-ezdxf is not installed");
  MeshBuilder b;
  b.room(0, 0, 4, 3);
  b.storey = 1;
  b.room(0, 0, 4, 3, 2.8, 5.3);
  json root = read_back(plan_of(b.mesh));
  EXPECT_EQ(on(root, "A-AREA-S0", "LWPOLYLINE").size(), 1U);
  EXPECT_EQ(on(root, "A-AREA-S1", "LWPOLYLINE").size(), 1U);
  WriteDxf::Params params;
  params.storey = 1;
  root = read_back(plan_of(b.mesh), params);
  EXPECT_TRUE(on(root, "A-AREA-S0", "LWPOLYLINE").empty());
  EXPECT_EQ(on(root, "A-AREA-S1", "LWPOLYLINE").size(), 1U);
}

TEST_F(Dxf, WhatIsNotKnownIsLeftOut) {
  if (python().empty()) ATRIUM_SKIP_LACKING("python3-ezdxf is not installed");
  MeshBuilder b;
  b.ceiling(0, 0, 5, 4, 2.6);
  EXPECT_EQ(on(read_back(plan_of(b.mesh)), "A-AREA-IDEN", "TEXT").size(), 2U);  // name and area, no height
}

TEST_F(Dxf, AnEmptyPlanIsAValidFile) {
  if (python().empty()) ATRIUM_SKIP_LACKING("python3-ezdxf is not installed");
  EXPECT_TRUE(read_back({})["entities"].empty());
  EXPECT_EQ(host->warnings.size(), 1U);
}

/// Two storeys of two rooms, with openings, dimensions, and names in several languages, far from the origin.
FloorPlan real_plan() {
  MeshBuilder b;
  for (const double low : {0.0, 2.8}) {
    b.room(0, 0, 4, 3, low, low + 2.5);
    b.room(4.12, 0, 7, 3, low, low + 2.5);
    ++b.storey;
  }
  b.mesh.origin = {500000.123, 5400000.456, 300};
  FloorPlan plan = plan_of(b.mesh);
  for (std::size_t storey = 0; storey < 2; ++storey) {
    add_openings(plan, storey);
    for (auto& opening : plan.storeys[storey].openings) {  // add_openings means the mesh's own coordinates
      const Eigen::Vector2d shift = b.mesh.origin.head<2>();
      opening.from += shift;
      opening.to += shift;
      for (auto& p : opening.outline) p += shift;
    }
  }
  plan.storeys[0].rooms[0].name = "K\u00FCche / \u0141azienka";
  plan.storeys[0].rooms[1].name = "\u53A8\u623F \U0001F373";
  return plan;
}

TEST_F(Dxf, ARealDrawingNeedsNoRepair) {
  if (python().empty()) ATRIUM_SKIP_LACKING("python3-ezdxf is not installed");
  const json root = read_back(real_plan());  // which looks at the audit
  EXPECT_EQ(root["code_page"], "ANSI_1252");
  EXPECT_GT(root["entities"].size(), 60U);
  std::vector<std::string> names;
  for (const auto& text : on(root, "A-AREA-IDEN-S0", "TEXT")) names.push_back(text["text"]);
  for (const std::string name : {"K\u00FCche / \u0141azienka", "\u53A8\u623F ?", "12.00 m\u00B2", "h 2.50 m"})
    EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name;
  for (const std::string suffix : {"-S0", "-S1"}) {
    EXPECT_EQ(on(root, "A-DOOR" + suffix, "ARC").size(), 1U);
    EXPECT_EQ(on(root, "A-GLAZ" + suffix, "LINE").size(), 2U);
    EXPECT_EQ(on(root, "A-ANNO-DIMS" + suffix, "DIMENSION").size(), 8U);
  }
  // The extents hold all that is drawn, and not much more.
  for (int k = 0; k < 2; ++k) {
    double least = 1e9, most = 0;
    for (const auto& entity : root["entities"])
      for (const auto& p : entity["points"]) {
        least = std::min(least, p[k].get<double>());
        most = std::max(most, p[k].get<double>());
      }
    EXPECT_LE(root["extents"][0][k], least);
    EXPECT_GE(root["extents"][0][k], least - 1);
    EXPECT_GE(root["extents"][1][k], most);
    EXPECT_LE(root["extents"][1][k], most + 1);
  }
}

TEST_F(Dxf, TheSamePlanGivesTheSameBytes) {
  WriteDxf::run({input(plan_of(two_rooms()))}, {}, context);
  const std::string first = test::read_text(file);
  WriteDxf::run({input(plan_of(two_rooms()))}, {}, context);
  EXPECT_EQ(test::read_text(file), first);
}

TEST_F(Dxf, WrongStoreysAndFoldersAreErrors) {
  WriteDxf::Params params;
  params.storey = 3;
  EXPECT_THROW(WriteDxf::run({input(plan_of(two_rooms()))}, params, context), Error);
  EXPECT_FALSE(std::filesystem::exists(file));
  test::write_text(host->folder / "file", "");
  params = {};
  params.path.path = "file/plan.dxf";
  EXPECT_THROW(WriteDxf::run({input(plan_of(two_rooms()))}, params, context), Error);
}

// Of the file as of its beginnings under another name.
TEST_F(Dxf, WhatCannotBeWrittenLeavesNothingBehind) {
  FloorPlan plan = plan_of(two_rooms());
  plan.storeys[0].rooms[0].polygon.outline[1].x() = std::nan("");
  EXPECT_THROW(WriteDxf::run({input(plan)}, {}, context), Error);
  EXPECT_TRUE(std::filesystem::is_empty(host->folder.path()));

  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit small{2000, before.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  EXPECT_THROW(WriteDxf::run({input(plan_of(two_rooms()))}, {}, context), Error);
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_TRUE(std::filesystem::is_empty(host->folder.path()));
}

TEST_F(Dxf, NumbersHaveAllDigitsAndNoExponents) {
  for (const auto& [value, text] : std::vector<std::pair<double, std::string>>{{0, "0.0"},
                                                                               {-4, "-4.0"},
                                                                               {0.1, "0.1"},
                                                                               {5400000.4560000002, "5400000.456"},
                                                                               {1.5e-7, "0.00000015"},
                                                                               {-2e-5, "-0.00002"},
                                                                               {1e20, "100000000000000000000.0"}}) {
    DxfGroups groups;
    groups.real(40, value);
    EXPECT_EQ(groups.all(), " 40\n" + text + "\n");
    EXPECT_EQ(std::stod(text), value);
  }
  DxfGroups groups;
  EXPECT_THROW(groups.real(40, INFINITY), Error);
}

TEST_F(Dxf, AnArcsExtentsHoldItsBulge) {
  if (python().empty()) ATRIUM_SKIP_LACKING("python3-ezdxf is not installed");
  DxfDrawing drawing({10, 20}, {{"A", 1, 25}}, {});
  const double r = std::sqrt(0.5);
  drawing.arc("A", {0, 0}, {r, -r}, {-r, r});  // over 0 and 90 degrees
  test::write_text(file, std::move(drawing).finish());
  const auto result =
      test::run_process({python(), ATRIUM_SOURCE_DIR "/tests/unit/floorplan/read_dxf.py", file.string()});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json extents = json::parse(result.out)["extents"];
  const double expected[2][2] = {{10 - r, 20 - r}, {11, 21}};
  for (int i = 0; i < 2; ++i)
    for (int k = 0; k < 2; ++k) EXPECT_NEAR(extents[i][k], expected[i][k], 1e-9);
}

TEST_F(Dxf, TextIsInItsCodePage) {
  EXPECT_EQ(dxf_text("12 m\u00B2"), "12 m\xB2");
  EXPECT_EQ(dxf_text("K\u00FCche \u20AC\u0178"),
            "K\xFC"
            "che \x80\x9F");
  EXPECT_EQ(dxf_text("\u0141azienka \u53A8 \U0001F373"), "\\U+0141azienka \\U+53A8 ?");
  EXPECT_EQ(dxf_text("a\nb\x01\u0085"), "ab");
  EXPECT_EQ(dxf_text("\xFF\xC3"), "??");
}

}  // namespace
}  // namespace atrium::floorplan::write_dxf_test
