// GeoJSON files by RFC 7946: tests/validate-geojson knows its rules, and nothing of what writes them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "modules/floorplan/write_geojson.hpp"
#include "tests/support/lacking.hpp"
#include "tests/unit/floorplan/buildings.hpp"

namespace atrium::floorplan::validate_geojson_test {
namespace {

using nlohmann::json;

class ValidGeojson : public testing::Test {
 protected:
  test::TemporaryFolder folder;

  static test::ProcessResult validate(const std::vector<std::string>& files) {
    return test::run_validator("validate-geojson", files);
  }
  /// What is complained of in each of the texts: "PLACE: RULE; …", empty if nothing is.
  std::vector<std::string> complaints(const std::vector<std::string>& texts) {
    std::vector<std::string> files, result(texts.size());
    for (std::size_t i = 0; i < texts.size(); ++i) {
      files.push_back(folder / std::to_string(i));
      test::write_text(files.back(), texts[i]);
    }
    const auto run = validate(files);
    EXPECT_EQ(run.err, "");
    EXPECT_EQ(run.exit_code, run.out.empty() ? 0 : 1);
    std::istringstream lines(run.out);
    for (std::string line; std::getline(lines, line);)
      for (std::size_t i = 0; i < files.size(); ++i)
        if (const std::string start = files[i] + ": "; line.starts_with(start))
          result[i] += (result[i].empty() ? "" : "; ") + line.substr(start.size());
    return result;
  }
};

TEST_F(ValidGeojson, WhatIsWritten) {
  const auto host = std::make_shared<Host>();
  Context context(1, host);
  MeshBuilder holed, only_ceiling;  // a floor around a stair
  holed.floor(0, 0, 6, 2);
  holed.floor(0, 4, 6, 6);
  holed.floor(0, 2, 2, 4);
  holed.floor(4, 2, 6, 4);
  holed.mesh.origin = {500000.123, 5400000.456, 300.5};
  only_ceiling.ceiling(0, 0, 5, 4, 2.6);
  std::vector<std::string> files;
  for (const FloorPlan& plan : {with_openings(), plan_of(holed.mesh), plan_of(only_ceiling.mesh),
                                plan_of(row_of_rooms(3, 4, 5)), tower(3), FloorPlan{}}) {
    WriteGeojson::Params params;
    params.path.path = std::to_string(files.size()) + ".geojson";
    WriteGeojson::run({input(plan)}, params, context);
    files.push_back(host->folder / params.path.path);
  }
  const auto result = validate(files);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out + result.err, "");
}

// A polygon with a hole, a line and a feature without a place.
constexpr const char* sound = R"({"type": "FeatureCollection", "bbox": [0, 0, 4, 3], "features": [
  {"type": "Feature", "id": 1, "properties": {}, "geometry": {"type": "Polygon", "coordinates": [
    [[0, 0], [4, 0], [4, 3], [0, 3], [0, 0]], [[1, 1], [1, 2], [2, 2], [2, 1], [1, 1]]]}},
  {"type": "Feature", "properties": null, "geometry": {"type": "LineString", "coordinates": [[0, 0, 1], [1, 1, 1]]}},
  {"type": "Feature", "properties": {}, "geometry": null}]})";

TEST_F(ValidGeojson, EachRuleThatIsBrokenIsNamed) {
  const std::string polygon = "/features/0/geometry", ring = polygon + "/coordinates/0",
                    hole = polygon + "/coordinates/1", line = "/features/1/geometry";
  struct Case {
    std::string member;
    json value;
    std::string rule;
  };
  const std::vector<Case> cases{
      {"/type", "featureCollection", "type is 'featureCollection'"},
      {"/features", json::object(), "features: is no array"},
      {"/features/2/type", "Point", "type is 'Point', not one of Feature"},
      {"/coordinates", "metres", "FeatureCollection with the member 'coordinates' (§7.1)"},
      {"/features/2/features", json::array(), "Feature with the member 'features' (§7.1)"},
      {line + "/properties", json::object(), "LineString with the member 'properties' (§7.1)"},
      {"/crs", json{{"type", "name"}}, "has the member 'crs'"},
      {"/features/2/properties", 1, "properties: is neither an object nor null"},
      {"/features/0/id", json::array(), "id: is neither a string nor a number"},
      {polygon + "/type", "Ring", "type is 'Ring'"},
      {polygon + "/type", "MultiPolygon", "coordinates[0][0][0]: is no position"},
      {ring, json::parse("[[0, 0], [4, 0], [0, 0]]"), "fewer than four positions"},
      {ring + "/4", json::parse("[0, 1]"), "not closed"},
      {ring, json::parse("[[0, 0], [0, 3], [4, 3], [4, 0], [0, 0]]"), "not counter-clockwise"},
      {ring, json::parse("[[0, 0], [4, 0], [2, 0], [0, 0]]"), "without an area"},
      {hole, json::parse("[[1, 1], [2, 1], [2, 2], [1, 2], [1, 1]]"), "a hole that is not clockwise"},
      {hole, json::parse("[[3, 1], [3, 2], [5, 2], [5, 1], [3, 1]]"), "a hole that is not within"},
      {line + "/coordinates", json::parse("[[0, 0]]"), "fewer than two positions"},
      {line + "/coordinates/1", json::parse("[1]"), "coordinates[1]: is no position"},
      {line + "/coordinates/1", json::parse("[1, 2, 3, 4]"), "is no position"},
      {line + "/coordinates/1", json::parse("[1, true]"), "is no position"},
      {line + "/coordinates/1/1", nullptr, "is no position"},
      {line + "/coordinates/1/1", "1.5", "is no position"},
      {"/bbox", json::parse("[0, 0, 3]"), "bbox: has 3 numbers"},
      {"/bbox", json::parse("[4, 3, 0, 0]"), "bbox: has 4 numbers for positions of 3"},
      {"/bbox", json::parse("[0, 4, 0, 3, 0, 1]"), "lowest values first"},
      {"/bbox", json::parse("[0, 0, 0, 3.5, 3, 1]"), "does not hold [4, 0]"}};
  std::vector<std::string> texts;
  for (const auto& [member, value, rule] : cases) {
    json root = json::parse(sound);
    if (!member.starts_with("/bbox")) root.erase("bbox");
    root[json::json_pointer(member)] = value;
    texts.push_back(root.dump());
  }
  const auto found = complaints(texts);
  for (std::size_t i = 0; i < cases.size(); ++i)
    EXPECT_NE(found[i].find(cases[i].rule), std::string::npos) << cases[i].member << ": " << found[i];
}

TEST_F(ValidGeojson, MembersAndTextsThatAreMissingAreNamed) {
  std::vector<std::string> texts, rules;
  json root = json::parse(sound);
  root.erase("bbox");
  const auto add = [&](const std::string& text, const std::string& rule) {
    texts.push_back(text);
    rules.push_back(rule);
  };
  const std::string text = root.dump();
  for (const auto& [place, name] :
       std::vector<std::pair<std::string, std::string>>{{"", "features"},
                                                        {"/features/1", "geometry"},
                                                        {"/features/1", "properties"},
                                                        {"/features/1/geometry", "coordinates"}}) {
    json lacking = root;
    lacking[json::json_pointer(place)].erase(name);
    add(lacking.dump(), "without the member '" + name + "'");
  }
  add("\xEF\xBB\xBF" + text, "byte order mark");
  add(text.substr(0, text.size() / 2), "is no JSON text");
  add("[]", "is no object");
  add(R"({"type": "Point", "coordinates": [NaN, 0]})", "NaN is no number");
  add(R"({"type": "Point", "coordinates": [1e999, 0]})", "is no position");
  add(R"({"type": "Point", "type": "Point", "coordinates": [1, 0]})", "'type' is there twice");
  add("{\"type\": \"Point\", \"coordinates\": [1, 0], \"name\": \"\xFF\"}", "is no JSON text");
  const std::size_t sound_ones = texts.size();
  for (const std::string& good :
       {text, std::string(R"({"type": "Point", "coordinates": [1, 0], "bbox": [1, 0, 1, 0]})"),
        std::string(
            R"({"type": "MultiPoint", "coordinates": [[177, -20], [-178, -16]], "bbox": [177, -20, -178, -16]})"),
        std::string(R"({"type": "GeometryCollection", "geometries": [{"type": "Point", "coordinates": [1, 0]}]})")})
    add(good, "");
  const auto found = complaints(texts);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    EXPECT_NE(found[i].find(rules[i]), std::string::npos) << texts[i] << ": " << found[i];
    if (i >= sound_ones) {
      EXPECT_EQ(found[i], "") << texts[i];
    }
  }
}

}  // namespace
}  // namespace atrium::floorplan::validate_geojson_test
