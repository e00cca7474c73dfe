// DXF files are read back by an independent reader, ezdxf (Debian: python3-ezdxf); without it these tests are skipped.
#include "modules/floorplan/write_dxf.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include "modules/floorplan/dxf_drawing.hpp"
#include "tests/support/process.hpp"
#include "tests/unit/floorplan/buildings.hpp"

namespace atrium::floorplan {
namespace {

using nlohmann::json;

constexpr auto reader = R"(
import json, sys
import ezdxf
doc = ezdxf.readfile(sys.argv[1])
audit = doc.audit()
entities = []
for e in doc.modelspace():
    entry = {"type": e.dxftype(), "layer": e.dxf.layer}
    if e.dxftype() == "LWPOLYLINE":
        entry["closed"] = bool(e.closed)
        entry["points"] = [[p[0], p[1]] for p in e.get_points()]
    elif e.dxftype() == "LINE":
        entry["points"] = [list(e.dxf.start), list(e.dxf.end)]
    elif e.dxftype() == "ARC":
        entry["points"] = [list(e.dxf.center), list(e.start_point), list(e.end_point)]
        entry["radius"] = e.dxf.radius
    elif e.dxftype() == "TEXT":
        entry["text"] = e.dxf.text
        entry["height"] = e.dxf.height
        entry["rotation"] = e.dxf.rotation
        entry["points"] = [list(e.dxf.align_point)]
    entities.append(entry)
print(json.dumps({"errors": [e.message for e in audit.errors], "units": doc.header["$INSUNITS"],
                  "version": doc.dxfversion, "view": list(doc.viewports.get("*Active")[0].dxf.center), "layers": [l.dxf.name for l in doc.layers], "entities": entities}))
)";

// A Python that has ezdxf: Debian's own may not be the first on the path.
std::string python() {
  for (const std::string candidate : {"python3", "/usr/bin/python3"})
    if (test::run_process({candidate, "-c", "import ezdxf"}).exit_code == 0) return candidate;
  return {};
}

class Dxf : public testing::Test {
 protected:
  std::shared_ptr<Host> host = std::make_shared<Host>();
  Context context{1, host};
  std::filesystem::path file = host->folder / "floorplan.dxf";

  json read_back(const FloorPlan& plan, const WriteDxf::Params& params = {}) {
    WriteDxf::run({input(plan)}, params, context);
    const auto result = test::run_process({python(), "-c", reader, file.string()});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const json root = json::parse(result.out);
    EXPECT_TRUE(root["errors"].empty()) << root["errors"];
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
  if (python().empty()) GTEST_SKIP() << "python3-ezdxf is not installed";
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
  if (python().empty()) GTEST_SKIP() << "python3-ezdxf is not installed";
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

TEST_F(Dxf, DimensionsAreTextsAlongTheirLines) {
  if (python().empty()) GTEST_SKIP() << "python3-ezdxf is not installed";
  Mesh mesh = two_rooms();
  for (auto& v : mesh.vertices) v.head<2>() = Eigen::Rotation2Dd(0.5) * v.head<2>();
  WriteDxf::Params params;
  params.scale = 50;
  const auto texts = on(read_back(plan_of(mesh), params), "A-ANNO-DIMS", "TEXT");
  ASSERT_EQ(texts.size(), 5U);  // 4.00, 0.12, 2.88; 7.00; 3.00
  for (const auto& text : texts) {
    const double turn = text["text"] == "3.00" ? 90 : 0;
    EXPECT_NEAR(text["rotation"], turn + 0.5 * 180 / 3.14159265358979, 1e-6) << text["text"];
    EXPECT_NEAR(text["height"], 0.1, 1e-9);
  }
  params.dimensions = false;
  EXPECT_TRUE(on(read_back(plan_of(mesh), params), "A-ANNO-DIMS", "TEXT").empty());
}

TEST_F(Dxf, EachStoreyHasItsOwnLayers) {
  if (python().empty()) GTEST_SKIP() << "python3-ezdxf is not installed";
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
  if (python().empty()) GTEST_SKIP() << "python3-ezdxf is not installed";
  MeshBuilder b;
  b.ceiling(0, 0, 5, 4, 2.6);
  EXPECT_EQ(on(read_back(plan_of(b.mesh)), "A-AREA-IDEN", "TEXT").size(), 2U);  // name and area, no height
}

TEST_F(Dxf, AnEmptyPlanIsAValidFile) {
  if (python().empty()) GTEST_SKIP() << "python3-ezdxf is not installed";
  EXPECT_TRUE(read_back({})["entities"].empty());
  EXPECT_EQ(host->warnings.size(), 1U);
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

TEST_F(Dxf, TextIsAscii) {
  EXPECT_EQ(dxf_text("12 m\u00B2"), "12 m\\U+00B2");
  EXPECT_EQ(dxf_text("K\u00FCche \u20AC"), "K\\U+00FCche \\U+20AC");
  EXPECT_EQ(dxf_text("a\nb\x01"), "ab");
  EXPECT_EQ(dxf_text("\xFF\xC3"), "??");
}

}  // namespace
}  // namespace atrium::floorplan
