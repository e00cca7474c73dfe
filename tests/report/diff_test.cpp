// `atrium diff`, on runs and variants that are made here, and its parts.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "graph/report/difference.hpp"
#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace atrium::test::diff_test {
namespace {

using nlohmann::json;
using report::Picture;
namespace fs = std::filesystem;

class Diff : public testing::Test {
 protected:
  Diff() {
    write_text(folder / "p.yaml", R"(atrium: 1
nodes:
  room: {type: synth.room}
  scan: {type: synth.scan, in: {scene: room.scene}, params: {points: 20000}}
  grid: {type: filter.voxel_grid, in: {cloud: scan.cloud}, params: {size: 5 cm}}
  picture: {type: render.snapshot, in: {mesh: scan.mesh}, params: {path: look.png, width: 160, height: 120}}
  write: {type: io.write_cloud, in: {cloud: grid.cloud}, params: {path: sub/grid.ply}}
  faces: {type: metric.faces, in: {mesh: scan.mesh}}
  distance: {type: metric.distance, in: {cloud: grid.cloud, mesh: scan.mesh}}
outputs: {faces: faces.metrics, distance: distance.metrics}
)");
  }
  ProcessResult atrium(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), ATRIUM_PROGRAM);
    ProcessOptions options;
    options.folder = folder.path();
    return run_process(arguments, options);
  }
  void run(const std::string& out, std::vector<std::string> settings = {}) {
    settings.insert(settings.begin(), {"run", "p.yaml", "--quiet", "--out", out});
    const auto result = atrium(std::move(settings));
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }
  json diff(const std::string& a, const std::string& b) {
    const auto result = atrium({"diff", a, b, "--json"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return json::parse(result.out);
  }
  TemporaryFolder folder;
};

/// A run's folder that somebody has sent.
TEST_F(Diff, FilesOutsideOfTheFolderAreNotRead) {
  write_text(folder / "private.png", "secret");
  fs::create_directories(folder / "sent");
  fs::create_symlink(folder / "private.png", folder / "sent/link.png");
  write_text(folder / "sent/resolved.yaml", "atrium: 1\nnodes: {}\n");
  json artefacts = json::array();
  for (const auto& path : {(folder / "private.png").string(), std::string("../private.png"), std::string("link.png")})
    artefacts.push_back({{"path", path}, {"bytes", 6}});
  write_text(folder / "sent/manifest.json",
             json{{"status", "ok"},
                  {"outputs", json::object()},
                  {"nodes", {{{"node", "a"}, {"type", "t.a"}, {"status", "ok"}, {"artefacts", artefacts}}}}}
                 .dump());
  const report::RunRecord record = report::read_run(folder / "sent");
  EXPECT_TRUE(record.files.empty());
  EXPECT_EQ(record.outside.size(), 3U);
  const auto result = atrium({"report", "sent", "-o", "r.html"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("is not in the folder"), std::string::npos) << result.err;
  EXPECT_EQ(read_text(folder / "r.html").find("c2VjcmV0"), std::string::npos);  // "secret" in base64
}

TEST_F(Diff, OfTheSameRunTwiceIsNothing) {
  run("a");
  run("b");
  const json same = diff("a", "b");
  EXPECT_TRUE(same.at("same")) << same.dump(1);
  EXPECT_EQ(same.at("nodes"), json::parse(R"({"compared": 7, "different": 0, "unknown": 0})"));
  const auto text = atrium({"diff", "a", "b", "--exit-code"});
  EXPECT_EQ(text.exit_code, 0);
  EXPECT_EQ(text.out, "the same\n");
}

TEST_F(Diff, NamesParametersMetricsFilesAndTheFirstNode) {
  run("a");
  run("b", {"-s", "grid.size=10cm"});
  const json found = diff("a", "b");
  EXPECT_FALSE(found.at("same"));
  EXPECT_EQ(found.at("parameters"), json::parse(R"([{"address": "grid.size", "a": "0.05 m", "b": "0.1 m"}])"));
  // The picture is of the mesh, which has not changed: its stamp has, its pixels have not.
  EXPECT_EQ(found.at("pictures"), json::array());
  EXPECT_EQ(found.at("files"), json::parse(R"([{"path": "sub/grid.ply", "in": "both"}])"));
  EXPECT_EQ(found.at("first_node"), json::parse(R"({"node": "grid", "type": "filter.voxel_grid", "output": "cloud"})"));
  EXPECT_EQ(found.at("nodes").at("different"), 2);  // grid and distance; write has no output
  bool rms = false;
  for (const auto& metric : found.at("metrics")) {
    EXPECT_TRUE(metric.at("name").get<std::string>().starts_with("distance.")) << metric;
    if (metric.at("name") != "distance.cloud_to_mesh.rms") continue;
    rms = true;
    EXPECT_EQ(metric.at("unit"), "m");
    EXPECT_DOUBLE_EQ(metric.at("change").get<double>(), metric.at("b").get<double>() - metric.at("a").get<double>());
  }
  EXPECT_TRUE(rms);
  const auto text = atrium({"diff", "a", "b", "--exit-code"});
  EXPECT_EQ(text.exit_code, 1);
  EXPECT_NE(text.out.find("grid.size  0.05 m  →  0.1 m\n"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("first node that differs\n  grid (filter.voxel_grid), output cloud; 2 of 7"),
            std::string::npos)
      << text.out;
}

TEST_F(Diff, CountsPixelsAndDrawsThem) {
  run("a");
  run("b", {"-s", "picture.edges=false"});
  run("c", {"-s", "picture.width=200"});
  const auto result = atrium({"diff", "a", "b", "--json", "--pictures", "shown"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json picture = json::parse(result.out).at("pictures").at(0);
  EXPECT_EQ(picture.at("path"), "look.png");
  EXPECT_EQ(picture.at("pixels"), 160 * 120);
  const Picture drawn = report::read_picture(folder / "shown/look.png");
  std::size_t vermilion = 0;
  for (std::size_t i = 0; i < drawn.pixels.size(); i += 4)
    vermilion += drawn.pixels[i] == 0xd5 && drawn.pixels[i + 1] == 0x5e && drawn.pixels[i + 2] == 0 ? 1 : 0;
  EXPECT_GT(vermilion, 100U);
  EXPECT_EQ(picture.at("different"), vermilion);
  EXPECT_EQ(diff("a", "c").at("pictures").at(0).at("same_size"), false);
}

TEST_F(Diff, OfVariantsAndOfARunWithoutHashes) {
  write_text(folder / "s.yaml", "atrium: 1\nsweep: p.yaml\ngrid: {grid.size: [5 cm, 10 cm]}\n");
  ASSERT_EQ(atrium({"sweep", "run", "s.yaml", "--out", "out", "--quiet"}).exit_code, 0);
  std::vector<std::string> variants;
  for (const auto& entry : fs::directory_iterator(folder / "out/variants")) variants.push_back(entry.path().string());
  const json found = diff(variants.at(0), variants.at(1));
  EXPECT_EQ(found.at("parameters").size(), 1U);
  EXPECT_EQ(found.at("first_node").at("node"), "grid");
  run("alone");  // the same as one of the variants
  EXPECT_NE(diff("alone", variants[0]).at("same").get<bool>(), diff("alone", variants[1]).at("same").get<bool>());
  run("bare", {"--no-hashes"});
  const json unknown = diff("alone", "bare");
  EXPECT_TRUE(unknown.at("same"));
  EXPECT_EQ(unknown.at("nodes").at("unknown"), 6);  // all but write, which has no output
}

TEST_F(Diff, SaysWhereARunFailed) {
  run("a");
  const auto failed = atrium({"run", "p.yaml", "--quiet", "--out", "b", "-s", "write.path=resolved.yaml/no.ply"});
  ASSERT_EQ(failed.exit_code, 1);
  const json found = diff("a", "b");
  EXPECT_EQ(found.at("status"), json({"ok", "failed"}));
  EXPECT_EQ(found.at("first_node").at("node"), "write");
  EXPECT_EQ(found.at("files").at(0), json::parse(R"({"path": "sub/grid.ply", "in": "a"})"));
}

TEST_F(Diff, RefusesWhatIsNoRun) {
  run("a");
  fs::create_directories(folder / "empty");
  const auto empty = atrium({"diff", "a", "empty"});
  EXPECT_EQ(empty.exit_code, 2);  // 1 says that they differ
  EXPECT_EQ(atrium({"diff", "a", "nowhere", "--exit-code"}).exit_code, 2);
  EXPECT_NE(empty.err.find("empty is no folder of a run"), std::string::npos) << empty.err;
  write_text(folder / "empty/manifest.json", "{\"status\": 3}");
  EXPECT_NE(atrium({"diff", "a", "empty"}).err.find("cannot be understood"), std::string::npos);
  write_text(folder / "empty/manifest.json", "nothing");
  EXPECT_NE(atrium({"diff", "a", "empty"}).err.find("is no JSON file"), std::string::npos);
  write_text(folder / "a/look.png", "no picture");
  run("b");
  const json found = diff("a", "b");
  EXPECT_NE(found.at("pictures").at(0).at("problem").get<std::string>().find("cannot be read as a PNG file"),
            std::string::npos);
}

TEST(DiffParts, PicturesAreComparedPixelByPixel) {
  const Picture a{2, 1, {10, 20, 30, 255, 0, 0, 0, 255}};
  Picture b = a;
  EXPECT_EQ(report::compare(a, b).different, 0U);
  b.pixels[5] = 7;
  b.pixels[6] = 3;
  const auto found = report::compare(a, b);
  EXPECT_EQ(found.different, 1U);
  EXPECT_EQ(found.pixels, 2U);
  EXPECT_EQ(found.largest, 7);
  EXPECT_FALSE(report::compare(a, Picture{1, 2, a.pixels}).comparable);
  const TemporaryFolder folder;
  report::write_picture(folder / "new/x.png", a);
  EXPECT_EQ(report::read_picture(folder / "new/x.png").pixels, a.pixels);
}

}  // namespace
}  // namespace atrium::test::diff_test
