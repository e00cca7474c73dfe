#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>
#include <nlohmann/json.hpp>

#include "files.hpp"
#include "modules/io/read_building.hpp"
#include "modules/io/write_building.hpp"
#include "tests/support/box_building.hpp"
#include "tests/support/lacking.hpp"

namespace atrium::io::building_test {
namespace {

using nlohmann::json;

class BuildingFile : public Files {
 protected:
  std::filesystem::path file = folder / "building.json";

  json write(const Building& building, OptionalInput<Transform> transform = {}) {
    WriteBuilding::run({input(building), std::move(transform)}, {}, context);
    return json::parse(std::ifstream(file));
  }
  ReadBuilding::Out read() { return ReadBuilding::run({{file.string()}}, context); }
  std::string error_of(const json& damaged) {
    std::ofstream(file) << damaged;
    try {
      read();
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }
  std::string bytes() const {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }
};

/// No number is round, and it stands where maps count in hundreds of kilometres.
Building far_away() {
  Transform transform;
  transform.rotation = Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  transform.translation = {503217.1234567, 5412345.7654321, 312.3456789};
  Building building = transformed(test::BoxBuilding::two_rooms(), transform);
  building.faces[0].holes = {{1, 0, 3}};
  building.rooms[1].holes = {{{5, 1, 0}, {5, 2, 0}, {6, 1, 0}}};
  building.rooms[1].name = "K\u00FCche \"2\"";
  building.faces[5].primitive = -1;
  return building;
}

TEST_F(BuildingFile, HasTheTotalsOfTheAccuracyAndIsReadWithoutThem) {
  write(far_away());
  const std::string plain = content_hash(read().building);
  Metrics metrics;
  metrics.values = {{"accuracy.all.points", 1200, ""},
                    {"accuracy.all.rms", 0.004, "m"},
                    {"accuracy.area.loa30", 0.75, ""},
                    {"building.rooms", 2, ""}};
  WriteBuilding::run({input(far_away()), {}, {}, input(metrics)}, {}, context);
  const json written = json::parse(std::ifstream(file));
  EXPECT_EQ(written["accuracy"], json::parse(R"({"all": {"points": 1200, "rms": 0.004}, "area": {"loa30": 0.75}})"));
  EXPECT_EQ(content_hash(read().building), plain);
  metrics.values[1].value = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(WriteBuilding::run({input(far_away()), {}, {}, input(metrics)}, {}, context), Error);
}

TEST_F(BuildingFile, IsReadWithAnyLineEndsAndAMarkInFront) {
  write(far_away());
  const std::string plain = bytes(), hash = content_hash(read().building);
  const auto with_ends = [&](const std::string& end) {
    std::string text;
    for (const char c : plain) text += c == '\n' ? end : std::string(1, c);
    return text;
  };
  for (const std::string& text : {with_ends("\r\n"), with_ends("\r"), with_ends(" \t\n"), "\xEF\xBB\xBF" + plain}) {
    std::ofstream(file, std::ios::binary) << text;
    EXPECT_EQ(content_hash(read().building), hash);
  }
}

TEST_F(BuildingFile, NamesTheUnitOfTheScan) {
  EXPECT_FALSE(write(far_away()).contains("scan_unit"));
  Cloud scan;
  for (const auto& [metres, name] : {std::pair{0.3048, "ft"}, {0.001, "mm"}, {0.5, "0.5 m"}}) {
    scan.unit = metres;
    WriteBuilding::run({input(far_away()), {}, input(scan)}, {}, context);
    const json unit = json::parse(std::ifstream(file)).at("scan_unit");
    EXPECT_EQ(unit.at("name"), name);
    EXPECT_EQ(unit.at("metres"), metres);
    EXPECT_EQ(content_hash(read().building), content_hash(far_away()));
  }
}

TEST_F(BuildingFile, ComesBackBitByBit) {
  const Building building = far_away();
  write(building);
  const auto back = read();
  EXPECT_EQ(content_hash(back.building), content_hash(building));
  EXPECT_EQ(back.transform.rotation, Eigen::Matrix3d::Identity());
  const std::string first = bytes();
  write(back.building);
  EXPECT_EQ(bytes(), first);
  EXPECT_EQ(content_hash(read().building), content_hash(building));
}

TEST_F(BuildingFile, KeepsConfidenceAndDoubtsAndLeavesThemOutWhereNobodyHasJudged) {
  Building building = test::BoxBuilding::two_rooms();
  json root = write(building);
  EXPECT_FALSE(root.contains("confidence"));
  EXPECT_FALSE(root["rooms"][0].contains("confidence"));
  EXPECT_EQ(read().building.rooms[0].confidence, -1);
  building.confidence = 0.75;
  building.doubts = {"7.0 m2 are in no room"};
  building.rooms[1].confidence = 0;
  building.rooms[1].doubts = {"its floor was not seen", "it is a slit"};
  root = write(building);
  EXPECT_EQ(root["confidence"], 0.75);
  EXPECT_EQ(root["rooms"][1]["doubts"].size(), 2U);
  EXPECT_EQ(content_hash(read().building), content_hash(building));
  root["rooms"][1]["confidence"] = 1.5;
  EXPECT_NE(error_of(root).find("is not between 0 and 1"), std::string::npos);
}

TEST_F(BuildingFile, KeepsWhatWasCorrected) {
  Building building = test::BoxBuilding::two_rooms();
  json root = write(building);
  EXPECT_FALSE(root["faces"][2].contains("backing") || root["faces"][2].contains("corrections") ||
               root["openings"][0].contains("corrections") || root["rooms"][0].contains("doubts"));
  building.faces[2].backing = 0.36;
  building.faces[2].corrections = {"wall behind it set to 0.360 m", "moved outwards by 0.010 m"};
  building.openings[0].corrections = {"changed"};
  building.rooms[0].doubts = {"corrected by hand: face 2 set to a thickness of 0.360 m"};  // nobody has judged it
  root = write(building);
  EXPECT_EQ(root["faces"][2]["backing"], 0.36);
  EXPECT_EQ(root["faces"][2]["corrections"].size(), 2U);
  EXPECT_EQ(content_hash(read().building), content_hash(building));
  root["faces"][2]["backing"] = -1;
  EXPECT_NE(error_of(root).find("is below 0"), std::string::npos);
}

TEST_F(BuildingFile, StandsInTheInputsFrame) {
  const Building building = test::BoxBuilding::two_rooms();
  Transform transform;  // from a tilted scan, far away
  transform.rotation = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  transform.translation = transform.rotation * Eigen::Vector3d(-503217.1, -5412345.7, -312);
  const json root = write(building, input(transform));
  const auto vector = [](const json& v) { return Eigen::Vector3d(v[0], v[1], v[2]); };
  const Eigen::Vector3d origin = vector(root["origin"]), up = vector(root["up"]);
  EXPECT_TRUE(up.isApprox(transform.rotation.transpose() * Eigen::Vector3d::UnitZ()));
  for (std::size_t i = 0; i < building.vertices.size(); ++i) {
    const Eigen::Vector3d place = origin + vector(root["vertices"][i]);
    EXPECT_LT((transform.rotation * place + transform.translation - building.vertices[i]).norm(), 1e-6);
    EXPECT_LT(vector(root["vertices"][i]).norm(), 20) << "small numbers beside the origin";
  }
  for (const auto& face : root["faces"])
    for (const std::size_t v : face["outline"])
      EXPECT_NEAR(vector(face["normal"]).dot(vector(root["vertices"][v])) + face["offset"].get<double>(), 0, 1e-12);
  // Elevations count along what is up.
  const json& floor = root["faces"][0];
  EXPECT_EQ(floor["class"], "floor");
  EXPECT_NEAR(up.dot(vector(root["vertices"][floor["outline"][0].get<std::size_t>()])),
              root["storeys"][0]["elevation"].get<double>(), 1e-12);
  // Read back, it stands upright, and the transform leads there from the file's frame.
  const auto back = read();
  for (std::size_t i = 0; i < building.vertices.size(); ++i) {
    const Eigen::Vector3d place = origin + vector(root["vertices"][i]);
    EXPECT_LT((back.transform.rotation * place + back.transform.translation - back.building.origin -
               back.building.vertices[i])
                  .norm(),
              1e-8);
    EXPECT_NEAR(back.building.vertices[i].z(), building.vertices[i].z(), 1e-12);
  }
}

TEST_F(BuildingFile, SaysWhatReadersWantToKnow) {
  const json root = write(test::BoxBuilding::two_rooms());
  EXPECT_EQ(root["units"], "m");
  const json& door = root["openings"][0];
  EXPECT_NEAR(door["width"], 0.9, 1e-12);
  EXPECT_NEAR(door["height"], 2.1, 1e-12);
  EXPECT_NEAR(door["position"][1], 0.95, 1e-12);
  EXPECT_NEAR(door["position"][2], 1.05, 1e-12);
  EXPECT_NEAR(root["faces"][0]["area"], 12, 1e-12);
  EXPECT_EQ(root["faces"][0]["inferred"], false);
  EXPECT_EQ(root["rooms"][1]["volume"].get<double>(), (7 - 4.12) * 3 * 2.5);
}

TEST_F(BuildingFile, IsValidByItsSchema) {
  constexpr auto program =
      "import json, sys, jsonschema\n"
      "schema = json.load(open(sys.argv[1]))\n"
      "jsonschema.Draft202012Validator.check_schema(schema)\n"
      "for e in jsonschema.Draft202012Validator(schema).iter_errors(json.load(open(sys.argv[2]))):\n"
      "    print(list(e.path), e.message)\n";
  const std::string python = test::python_with("jsonschema");
  if (python.empty()) ATRIUM_SKIP_LACKING("python3-jsonschema is not installed");
  const std::string schema = ATRIUM_SOURCE_DIR "/share/schema/building.schema.json";
  const auto complaints = [&] {
    const auto result = test::run_process({python, "-c", program, schema, file.string()});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.out;
  };
  json root = write(far_away());
  EXPECT_EQ(complaints(), "");
  write(Building{});
  EXPECT_EQ(complaints(), "");
  root["faces"][0]["outline"] = {0, 1};
  std::ofstream(file) << root;
  EXPECT_NE(complaints(), "");
}

TEST_F(BuildingFile, ErrorsNameThePlace) {
  const json good = write(test::BoxBuilding::two_rooms());
  const auto damaged = [&](const std::string& pointer, const json& value) {
    json root = good;
    root[json::json_pointer(pointer)] = value;
    return error_of(root);
  };
  const std::string start = file.string() + ": ";
  EXPECT_EQ(damaged("/faces/3/outline/1", 16), start + "faces[3].outline[1] is not a whole number from 0 to 15");
  EXPECT_EQ(damaged("/faces/3/outline", {1, 2}), start + "faces[3].outline has fewer than three corners");
  EXPECT_EQ(damaged("/faces/3/normal", {1, 2, 3}), start + "faces[3].normal is not of unit length");
  EXPECT_EQ(damaged("/faces/0/class", "roof"), start + "faces[0].class is 'roof'");
  EXPECT_EQ(damaged("/openings/0/room_b", 2), start + "openings[0].room_b is not a whole number from -1 to 1");
  EXPECT_EQ(damaged("/rooms/1/storey", 1), start + "rooms[1].storey is not a whole number from 0 to 0");
  EXPECT_EQ(damaged("/rooms/1/faces/2", -1), start + "rooms[1].faces[2] is not a whole number from 0 to 11");
  EXPECT_EQ(damaged("/walls/0/thickness", "thin"), start + "walls[0].thickness is not a number");
  EXPECT_EQ(damaged("/vertices/7", {1, 2}), start + "vertices[7] is not [x, y, z]");
  EXPECT_EQ(damaged("/units", "ft"), start + "units is not \"m\"");
  EXPECT_EQ(damaged("/atrium_building", 2), start + "atrium_building is a version that is not known");
  json root = good;
  root["walls"][0].erase("area");
  EXPECT_EQ(error_of(root), start + "walls[0] has no 'area'");
  EXPECT_NE(error_of({{"planes", json::array()}}).find("no building"), std::string::npos);
  std::ofstream(file) << "{\n\"atrium_building\": 1,\n\"units\" \"m\"}";
  try {
    read();
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("line 3"), std::string::npos) << error.what();
  }
}

TEST_F(BuildingFile, WhatShouldNotBeInAFileIsNotWritten) {
  const auto error = [&](const std::function<void(Building&)>& damage) -> std::string {
    Building building = test::BoxBuilding::two_rooms();
    damage(building);
    try {
      write(building);
    } catch (const Error& e) {
      EXPECT_FALSE(std::filesystem::exists(file));
      return e.what();
    }
    return "no error";
  };
  EXPECT_NE(error([](auto& b) { b.vertices[3].x() = std::nan(""); }).find("vertex 3"), std::string::npos);
  EXPECT_NE(error([](auto& b) { b.faces[2].residual = INFINITY; }).find("face 2"), std::string::npos);
  EXPECT_NE(error([](auto& b) { b.faces[2].outline[0] = 99; }).find("vertex 99 of 16"), std::string::npos);
  EXPECT_NE(error([](auto& b) { b.openings[1].face_a = 12; }).find("face 12 of 12"), std::string::npos);
  EXPECT_NE(error([](auto& b) { b.rooms[0].storey = 3; }).find("storey 3 of 1"), std::string::npos);
}

TEST_F(BuildingFile, ABuildingWithoutRoomsIsReadWithAWarning) {
  write(Building{});
  EXPECT_TRUE(read().building.rooms.empty());
  EXPECT_EQ(host->warnings.size(), 1U);
}

}  // namespace
}  // namespace atrium::io::building_test
