// pipelines/atrium.yaml on parts of a scanned room: what is no room is refused, and says what is lacking.
#include <gtest/gtest.h>

#include "tests/pipelines/steps.hpp"

namespace atrium::test::no_room_test {
namespace {

constexpr const char* cropped = R"(atrium: 1
vars: {scan: , min: , max: }
nodes:
  scan: {type: io.read_scan, params: {path: "${scan}"}}
  part: {type: filter.crop, in: {cloud: scan.cloud}, params: {min: "${min}", max: "${max}"}}
  rooms: {pipeline: PIPELINE, in: {cloud: part.cloud}}
)";

class PartOfARoom : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    scratch = std::make_unique<TemporaryFolder>();
    const auto simulated =
        run_pipeline_file("simulate.yaml", {"scene.type=synth.room", "points=150000", "noise=4 mm"}, *scratch / "scan");
    ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
    std::string text = cropped;
    text.replace(text.find("PIPELINE"), 8, (source / "pipelines/atrium.yaml").string());
    write_text(*scratch / "cropped.yaml", text);
  }
  static void TearDownTestSuite() { scratch.reset(); }

  static ProcessResult run(const std::string& min, const std::string& max) {
    return atrium({"run", (*scratch / "cropped.yaml").string(), "--quiet", "--out", (*scratch / "made").string(), "-s",
                   "scan=" + (*scratch / "scan/scan.ply").string(), "-s", "min=" + min, "-s", "max=" + max});
  }
  static std::unique_ptr<TemporaryFolder> scratch;
};
std::unique_ptr<TemporaryFolder> PartOfARoom::scratch;

TEST_F(PartOfARoom, AllOfItIsARoomThatCanBeTrusted) {
  const auto result = run("[-100 m, -100 m, -100 m]", "[100 m, 100 m, 100 m]");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto building = nlohmann::json::parse(read_text(*scratch / "made/rooms/building.json"));
  EXPECT_GT(building["confidence"], 0.8);
  EXPECT_GT(building["rooms"][0]["confidence"], 0.8);
}

TEST_F(PartOfARoom, ACornerIsRefused) {
  const auto result = run("[-1 m, -1 m, -1 m]", "[1.6 m, 1.4 m, 5 m]");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("no room"), std::string::npos) << result.err;
}

TEST_F(PartOfARoom, AStripIsRefused) {
  const auto result = run("[1.5 m, -1 m, -1 m]", "[2.5 m, 20 m, 5 m]");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("no room"), std::string::npos) << result.err;
}

TEST_F(PartOfARoom, WhatStandsInItIsRefused) {
  const auto result = run("[0.1 m, 0.1 m, 0.1 m]", "[3.9 m, 2.9 m, 2.0 m]");
  EXPECT_EQ(result.exit_code, 1) << result.err;
}

}  // namespace
}  // namespace atrium::test::no_room_test
