// Corrections by hand through pipelines/atrium.yaml: all that is made from the building follows.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/pipelines/steps.hpp"

namespace atrium::test::corrections_test {
namespace {

using nlohmann::json;

class CorrectedFlat : public testing::Test {
 protected:
  TemporaryFolder folder;

  ProcessResult run(const std::string& out, const std::vector<std::string>& settings) {
    std::vector<std::string> words{ATRIUM_PROGRAM,
                                   "run",
                                   "pipelines/atrium.yaml",
                                   "--quiet",
                                   "--out",
                                   (folder / out).string(),
                                   "-s",
                                   "scan=" + (folder / "scan/scan.ply").string()};
    for (const auto& setting : settings) words.insert(words.end(), {"-s", setting});
    ProcessOptions options;
    options.folder = source;
    options.timeout = 120;
    options.environment = {"ATRIUM_CACHE=" + (folder / "cache").string()};
    return run_process(words, options);
  }
  std::string text(const std::string& name) const { return read_text(folder / name); }
  json building(const std::string& out) const { return json::parse(text(out + "/building.json")); }
  std::string use(const std::string& out, const std::string& node) const {
    const json manifest = json::parse(text(out + "/manifest.json"));
    for (const auto& entry : manifest["nodes"])
      if (entry["node"] == node) return entry["cache"]["result"];
    return "no such node";
  }
};

const json& room(const json& building, const std::string& name) {
  for (const auto& entry : building["rooms"])
    if (entry["name"] == name) return entry;
  throw std::runtime_error("no room " + name);
}

// The living room is 5.712 m × 4.64 m in the corner (0, 0); behind its wall x = 5.712 lies the bedroom up to y = 3.76.
TEST_F(CorrectedFlat, ShowsInAllThatIsMadeFromIt) {
  const auto simulated =
      run_pipeline_file("simulate.yaml", {"points=150000", "yaw=0 deg", "tilt=0 deg"}, folder / "scan");
  ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
  const auto plain = run("plain", {});
  ASSERT_EQ(plain.exit_code, 0) << plain.err;
  const json before = building("plain");
  const auto largest = std::max_element(before["rooms"].begin(), before["rooms"].end(),
                                        [](const json& a, const json& b) { return a["area"] < b["area"]; });
  const double area = (*largest)["area"];
  ASSERT_NEAR(area, 5.712 * 4.64, 0.2);
  const std::string file = (folder / "corrections.yaml").string();
  const std::string lines =
      "atrium_corrections: 1\ncorrections:\n  - rename_room: {room: " + (*largest)["name"].get<std::string>() +
      ", name: Wohnküche}\n"
      "  - move_wall: {room: Wohnküche, at: [0, 2.3], by: 12 cm}\n"
      "  - set_thickness: {room: Wohnküche, at: [0, 2.3], thickness: 40 cm}\n"
      "  - add_opening: {room: Wohnküche, at: [5.7, 0.8], kind: door, corner: right, distance: 40 "
      "cm, width: 80 cm, height: 2 m}\n";
  write_text(file, lines);
  const auto made = run("made", {"corrections=" + file});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(use("made", "confidence"), "hit");
  EXPECT_EQ(use("made", "corrected"), "miss");
  const json after = building("made");
  const json& living = room(after, "Wohnküche");
  EXPECT_NEAR(living["area"].get<double>(), area + 0.12 * 4.64, 0.01);
  EXPECT_NE(living["doubts"].dump().find("moved by 0.120 m"), std::string::npos) << living["doubts"];
  EXPECT_EQ(after["openings"].size(), before["openings"].size() + 1);
  const json& door = after["openings"].back();
  EXPECT_EQ(door["kind"], "door");
  EXPECT_NE(door["room_b"], -1) << "it leads into the bedroom";
  EXPECT_NEAR(door["thickness"].get<double>(), 0.12, 0.01);
  EXPECT_NE(text("made/rooms.csv").find("Wohnküche"), std::string::npos);
  const std::string doors = text("made/doors.csv"), doors_before = text("plain/doors.csv");
  EXPECT_EQ(std::count(doors.begin(), doors.end(), '\n'),
            std::count(doors_before.begin(), doors_before.end(), '\n') + 1);
  EXPECT_NE(text("made/floorplan.svg").find("Wohnküche"), std::string::npos);
  EXPECT_NE(text("made/building.ifc").find("Wohnk\\X2\\00FC\\X0\\che"), std::string::npos);
  EXPECT_NE(text("made/building.ifc").find("corrected by hand"), std::string::npos);

  // The outer wall has its thickness, and what was corrected is marked.
  EXPECT_EQ(text("plain/walls.csv").find(",yes\r\n"), std::string::npos) << "nothing was corrected";
  EXPECT_EQ(text("plain/floorplan.svg").find("corrected by hand"), std::string::npos);
  EXPECT_NE(text("made/walls.csv").find(",0.400,no,"), std::string::npos) << text("made/walls.csv");
  EXPECT_NE(text("made/floorplan.svg").find("corrected by hand"), std::string::npos);
  EXPECT_NE(text("made/building.ifc").find("moved outwards by 0.120 m; face"), std::string::npos);
  EXPECT_EQ(door["corrections"], json::array({"added"}));
  EXPECT_EQ(std::count_if(after["faces"].begin(), after["faces"].end(),
                          [](const json& face) { return face.contains("backing"); }),
            1);

  // Another text in the file is another result; the same text none.
  ASSERT_EQ(run("again", {"corrections=" + file}).exit_code, 0);
  EXPECT_EQ(use("again", "corrected"), "hit");
  write_text(file, lines + "  - drop_opening: {opening: window 99}\n");
  const auto refused = run("refused", {"corrections=" + file});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_NE(refused.err.find("corrections.yaml:7:29: there is no 'window 99'"), std::string::npos) << refused.err;
  EXPECT_FALSE(fs::exists(folder / "refused/building.json"));
}

}  // namespace
}  // namespace atrium::test::corrections_test
