#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "files.hpp"
#include "modules/io/read_layout.hpp"
#include "modules/io/write_truth.hpp"
#include "modules/synth/attic.hpp"
#include "modules/synth/flat.hpp"
#include "modules/synth/scan.hpp"
#include "modules/synth/two_storeys.hpp"

namespace atrium::io::layout_test {
namespace {

using V = Eigen::Vector3d;
using Layout = Files;

double mesh_area(const Mesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]).norm() / 2;
  return sum;
}
double face_area(const GroundTruth& truth, SurfaceClass surface) {
  double sum = 0;
  for (const auto& face : truth.faces)
    if (face.surface == surface) sum += face.area();
  return sum;
}
double plan_area(const FloorPlan& plan) {
  double sum = 0;
  for (const auto& storey : plan.storeys)
    for (const auto& room : storey.rooms) sum += room.polygon.area();
  return sum;
}

/// Truth of a scan that is turned, tilted and far away: no number is round.
GroundTruth turned(SimulatedScene scene) {
  Context context;
  synth::Scan::Params params;
  params.points = 1000;
  params.yaw = 23;
  params.tilt = 2.5;
  params.offset = {500000.125, 5400000.25, 300};
  return synth::Scan::run({input(std::move(scene))}, params, context).truth;
}

TEST_F(Layout, TruthComesBackBitByBit) {
  for (auto scene : {synth::Flat::run({}, context).scene, synth::TwoStoreys::run({}, context).scene,
                     synth::Attic::run({}, context).scene}) {
    for (const auto& truth : {scene.truth, turned(scene)}) {
      WriteTruth::run({input(truth)}, {{"truth.json"}}, context);
      const auto read = ReadLayout::run({{path("truth.json")}}, context);
      EXPECT_EQ(content_hash(read.truth), content_hash(truth));
      EXPECT_EQ(content_hash(read.mesh), content_hash(truth.mesh));
    }
  }
}

TEST_F(Layout, TruthWithoutAMeshIsCutIntoTriangles) {
  const auto truth = turned(synth::Attic::run({}, context).scene);
  WriteTruth::run({input(truth)}, {{"truth.json"}}, context);
  const auto text = content("truth.json");
  const auto cut = file("cut.json", text.substr(0, text.find(",\n\"mesh\"")) + "\n}\n");
  const auto read = ReadLayout::run({{cut}}, context);
  EXPECT_NEAR(mesh_area(read.mesh), mesh_area(truth.mesh), 1e-6);
  for (const auto& p : read.mesh.vertices) ASSERT_TRUE(p.allFinite());
  // Triangles look where their faces look.
  for (std::size_t t = 0; t < read.mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = read.mesh.triangles[t];
    const V area = (read.mesh.vertices[b] - read.mesh.vertices[a]).cross(read.mesh.vertices[c] - read.mesh.vertices[a]);
    const auto& normal = truth.faces[static_cast<std::size_t>(read.mesh.primitives[t])].plane.normal;
    EXPECT_GT(area.dot(normal), 0.999 * area.norm());
  }
}

TEST_F(Layout, PlansOfTurnedTruthStandUpright) {
  const auto scene = synth::Flat::run({}, context).scene;
  double area = 0;
  for (const auto& room : scene.truth.rooms) area += area_vector(room.outline).norm();
  WriteTruth::run({input(turned(scene))}, {{"truth.json"}}, context);
  const auto plan = ReadLayout::run({{path("truth.json")}}, context).plan;
  ASSERT_EQ(plan.storeys.size(), 1U);
  EXPECT_NEAR(plan_area(plan), area, 1e-6);
  EXPECT_GT(plan.to_plan.rotation(2, 2), std::cos(2.6 * M_PI / 180));
  EXPECT_LT(plan.to_plan.rotation(2, 2), std::cos(2.4 * M_PI / 180));
  EXPECT_LT((plan.to_plan.rotation * plan.origin + plan.to_plan.translation - plan.origin).norm(), 1e-6);
  for (std::size_t i = 0; i < scene.truth.rooms.size(); ++i) {  // the ceilings of the flat hang at several heights
    double height = 0;
    for (const auto& face : scene.truth.faces)
      if (face.surface == SurfaceClass::ceiling && face.room == static_cast<std::int32_t>(i))
        height = face.outline.front().z() - scene.truth.rooms[i].outline.front().z();
    EXPECT_NEAR(plan.storeys[0].rooms[i].height, height, 1e-6);
  }
}

TEST_F(Layout, RoomsByTheirCorners) {
  const auto both = file("rooms.json",
                         R"({"rooms": [{"corners": [[0,0],[4,0],[4,5],[0,5]], "name": "hall", "height": 2.5},
                             {"corners": [[4.2,5,3],[4.2,0,3],[9,0,3]], "storey": 1}]})");
  const auto read = ReadLayout::run({{both}}, context);
  ASSERT_EQ(read.truth.rooms.size(), 2U);
  EXPECT_EQ(read.truth.rooms[0].name, "hall");
  EXPECT_EQ(face_area(read.truth, SurfaceClass::wall), 45);
  EXPECT_EQ(face_area(read.truth, SurfaceClass::floor), 20);
  EXPECT_EQ(read.truth.faces.size(), 6U);
  for (const auto& face : read.truth.faces)  // all look into the room
    EXPECT_GT(face.plane.signed_distance(V(2, 2.5, 1.25)), 1);
  EXPECT_EQ(mesh_area(read.mesh), 85);
  EXPECT_GT(area_vector(read.truth.rooms[1].outline).z(), 0);  // given clockwise
  ASSERT_EQ(read.plan.storeys.size(), 2U);
  EXPECT_EQ(read.plan.storeys[1].elevation, 3);
  EXPECT_EQ(read.plan.storeys[0].rooms[0].height, 2.5);
  const auto list = file("list.json", "[[[0,0],[0,5],[4,5],[4,0],[0,0]]]");  // closed by repeating a corner
  EXPECT_EQ(plan_area(ReadLayout::run({{list}}, context).plan), 20);
}

/// A headset's layout of an L-shaped room, 4 × 5 m less 1 × 2 m, whose walls end up to 2 cm apart.
std::string l_room(bool with_last_wall) {
  const std::vector<Eigen::Vector2d> corners{{0, 0}, {4, 0}, {4, 3}, {3, 3}, {3, 5}, {0, 5}};
  std::string text = R"({"units": "m", "up": "z", "planes": [)";
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (i == 4 && !with_last_wall) continue;
    const auto &a = corners[i], &b = corners[(i + 1) % 6];
    const Eigen::Vector2d along = (b - a).normalized(), out(along.y(), -along.x());
    const auto corner = [&](const Eigen::Vector2d& p, double z) {
      return "[" + std::to_string(p.x()) + "," + std::to_string(p.y()) + "," + std::to_string(z) + "]";
    };
    const Eigen::Vector2d from = a + 0.01 * along, to = b - 0.01 * along;
    text += R"({"label": "WALL_FACE", "corners": [)" + corner(from, 0.01) + "," + corner(to, 0.01) + "," +
            corner(to, 2.5) + "," + corner(from, 2.5) + R"(], "normal_out": )" + corner(out, 0) + "},\n";
  }
  return text + R"({"label": "FLOOR", "corners": [[0,0,0],[4,0,0],[4,5,0],[0,5,0]], "normal_out": [0,0,-1]},
    {"label": "CEILING", "corners": [[0,0,2.5],[4,0,2.5],[4,5,2.5],[0,5,2.5]], "normal_out": [0,0,1]},
    {"label": "DOOR_FRAME", "corners": [[1,0.02,0],[2,0.02,0],[2,0.02,2],[1,0.02,2]], "normal_out": [0,-1,0]},
    {"label": "TABLE", "corners": [[1,1,0.7],[2,1,0.7],[2,2,0.7],[1,2,0.7]], "normal_out": [0,0,-1]}]})";
}

TEST_F(Layout, AHeadsetsPlanesBecomeARoom) {
  const auto read = ReadLayout::run({{file("layout.json", l_room(true))}}, context);
  ASSERT_EQ(read.truth.rooms.size(), 1U);
  ASSERT_EQ(read.truth.rooms[0].outline.size(), 6U);
  EXPECT_NEAR(plan_area(read.plan), 18, 1e-9);  // corners stand where the walls' lines meet
  EXPECT_NEAR(face_area(read.truth, SurfaceClass::floor), 18, 1e-9);
  EXPECT_NEAR(face_area(read.truth, SurfaceClass::ceiling), 18, 1e-9);
  EXPECT_NEAR(face_area(read.truth, SurfaceClass::wall), (18 - 6 * 0.02) * 2.49, 1e-6);
  for (const auto& face : read.truth.faces) EXPECT_GT(face.plane.signed_distance(V(1.5, 2.5, 1)), 0);
  ASSERT_EQ(read.truth.openings.size(), 1U);
  EXPECT_EQ(read.truth.openings[0].kind, "door");
  EXPECT_EQ(read.truth.openings[0].face_a, 0);
  EXPECT_EQ(read.truth.openings[0].room_a, 0);
  EXPECT_TRUE(host->warnings.empty());
}

TEST_F(Layout, WallsThatCloseNoRoomAreSaid) {
  const auto read = ReadLayout::run({{file("layout.json", l_room(false))}}, context);
  EXPECT_TRUE(read.truth.rooms.empty());
  EXPECT_EQ(face_area(read.truth, SurfaceClass::floor), 20);  // as the file has it
  ASSERT_EQ(host->warnings.size(), 2U);
  EXPECT_NE(host->warnings[0].find("5 walls close no room"), std::string::npos);
}

TEST_F(Layout, BadFilesAreErrorsThatNameThePlace) {
  const auto message = [&](const std::string& text) {
    try {
      ReadLayout::run({{file("bad.json", text)}}, context);
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  EXPECT_NE(message("").find("empty"), std::string::npos);
  EXPECT_NE(message("{").find("not valid JSON"), std::string::npos);
  EXPECT_NE(message("{\"a\": 1}").find("none of the keys"), std::string::npos);
  EXPECT_NE(message("7").find("none of the keys"), std::string::npos);
  EXPECT_NE(message("[[[0,0],[1,0]]]").find("[0] has fewer than three corners"), std::string::npos);
  EXPECT_NE(message("[[[0,0],[1,0],[1,\"x\"]]]").find("[0][2][1] is not a number"), std::string::npos);
  EXPECT_NE(message("[[[0,0],[1,0],[2,0]]]").find("no area"), std::string::npos);
  EXPECT_NE(message("[[[0,0],[1,0],[1,1e999]]]").find("bad.json"), std::string::npos);
  EXPECT_NE(message("{\"rooms\": [{}]}").find("rooms[0] has no 'corners'"), std::string::npos);
  EXPECT_NE(message("{\"rooms\": 3}").find("rooms is not a list"), std::string::npos);
  EXPECT_NE(message("{\"units\": \"mm\", \"planes\": []}").find("units is not \"m\""), std::string::npos);
  EXPECT_NE(message("{\"atrium_truth\": 2}").find("version"), std::string::npos);
  EXPECT_NE(message(R"({"atrium_truth": 1, "units": "m", "origin": [0,0,0], "rooms": [], "openings": [],
      "faces": [{"class": "roof", "storey": 0, "room": -1}]})")
                .find("faces[0].class is 'roof'"),
            std::string::npos);
  EXPECT_THROW(ReadLayout::run({{path("missing.json")}}, context), Error);
}

TEST_F(Layout, AMeshIsRefusedByItsName) {
  for (const char* name : {"truth.ply", "truth.PLY", "scan.pcd", "model.glb", "model.obj"}) {
    try {
      ReadLayout::run({{file(name, "ply\nformat ascii 1.0\n")}}, context);
      FAIL() << name;
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find("a layout is JSON, this is a ."), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.help()).find("truth_mesh"), std::string::npos) << e.help();
    }
  }
}

class QuestLayout : public Files, public testing::WithParamInterface<std::tuple<const char*, std::size_t, double>> {};

TEST_P(QuestLayout, GivesARoomWithAllItsCorners) {
  const auto [name, corners, area] = GetParam();
  const auto place = std::filesystem::path(ATRIUM_SOURCE_DIR) / "../shared/scans" / name / "layout.json";
  if (!std::filesystem::exists(place)) GTEST_SKIP() << "skipped: there is no " << place;
  const auto read = ReadLayout::run({{place.string()}}, context);
  ASSERT_EQ(read.truth.rooms.size(), 1U);
  EXPECT_EQ(read.truth.rooms[0].outline.size(), corners);
  EXPECT_NEAR(plan_area(read.plan), area, 0.02 * area);
  for (const auto& opening : read.truth.openings) EXPECT_GE(opening.face_a, 0);
}
INSTANTIATE_TEST_SUITE_P(Scans, QuestLayout,
                         testing::Values(std::tuple("quest_office_small", 4, 5.96),
                                         std::tuple("quest_meeting_room", 8, 21.6),
                                         std::tuple("quest_living_room", 6, 26.0)),
                         [](const auto& test) { return std::string(std::get<0>(test.param)); });

}  // namespace
}  // namespace atrium::io::layout_test
