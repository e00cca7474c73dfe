// `atrium report`, as its users see it: on sweeps and runs that are made here, looked at in a browser.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "graph/report/attachments.hpp"
#include "graph/report/base64.hpp"
#include "tests/support/lacking.hpp"
#include "tests/support/temporary_folder.hpp"

namespace atrium::test::report_test {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

const fs::path page = fs::path(ATRIUM_PROGRAM).parent_path().parent_path() / "share/atrium/report.html";

// Everything that a text could do to a page that does not take it as a text.
const std::string wicked =
    "</script><script>window.intruder = 1</script><!-- <img src=x onerror=window.intruder=2> & \"'";

ProcessResult atrium(std::vector<std::string> arguments, const fs::path& folder) {
  arguments.insert(arguments.begin(), ATRIUM_PROGRAM);
  ProcessOptions options;
  options.folder = folder;
  return run_process(arguments, options);
}

std::string quoted(const std::string& text) { return json(text).dump(); }

/// The JSON in a report.
json data_of(const std::string& html) {
  const std::string open = "<script type=\"application/json\" id=\"data\">";
  const auto begin = html.find(open) + open.size();
  return json::parse(html.substr(begin, html.find("</script>", begin) - begin));
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++found;
  return found;
}

/// A sweep with pictures, models, seeds, and variants that fail.
class Report : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(page)) ATRIUM_SKIP_LACKING("the report's page was not built (esbuild, libjs-three): " << page);
  }
  static void make_sweep(const fs::path& folder) {
    write_text(folder / "base.yaml", R"(atrium: 1
summary: A room.
nodes:
  room: {type: synth.room}
  scan: {type: synth.scan, in: {scene: room.scene}, params: {points: 20000}}
  picture: {type: render.snapshot, in: {mesh: scan.mesh}, params: {path: look.png, width: 160, height: 120}}
  model: {type: io.write_mesh, in: {mesh: scan.mesh}, params: {path: models/room.glb}}
  other: {type: io.write_mesh, in: {mesh: scan.mesh}, params: {path: models/room.ply}}
  faces: {type: metric.faces, in: {mesh: scan.mesh}}
  distance: {type: metric.distance, in: {cloud: scan.cloud, mesh: scan.mesh}}
outputs: {faces: faces.metrics, distance: distance.metrics}
)");
    write_text(folder / "s.yaml",
               "atrium: 1\nsweep: base.yaml\nsummary: " + quoted(wicked) +
                   "\ngrid: {scan.noise: [1 mm, 1 cm, 5 cm]}\nlist:\n  plain: {}\n  " +
                   "broken: {other.path: " + quoted("resolved.yaml/" + wicked + ".ply") + "}\nseeds: [1, 2]\n" +
                   "metrics:\n  RMS: {of: distance.distance.cloud_to_mesh.rms, unit: mm, digits: 2}\n" +
                   "  area: faces.faces.area\n  time: {seconds: all}\n");
    const auto result = atrium({"sweep", "run", "s.yaml", "--out", "out", "--quiet"}, folder);
    ASSERT_TRUE(result.exit_code == 0 || result.exit_code == 4) << result.err;
  }
  /// What the browser said of the report; skips where there is none.
  static void expect_works_in_browser(const fs::path& report, bool models) {
    for (const auto* program : {"chromium", "node"})
      if (!has_program(program)) ATRIUM_SKIP_LACKING(program << " is not installed (share/install-packages --tests)");
    std::vector<std::string> command{"node", ATRIUM_SOURCE_DIR "/tests/report/check.mjs", "chromium", report.string()};
    if (models) command.emplace_back("models");
    ProcessOptions options;
    options.timeout = 240;
    const auto result = run_process(command, options);
    EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
    std::printf("%s", result.out.c_str());
  }
  TemporaryFolder folder;
};

TEST_F(Report, OfASweepWorksInABrowser) {
  make_sweep(folder.path());
  const auto result = atrium({"report", "out", "--json"}, folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json written = json::parse(result.out);
  const std::string html = read_text(folder / "out/report.html");
  EXPECT_EQ(written.at("bytes"), html.size());
  EXPECT_EQ(written.at("variants"), 12);
  EXPECT_EQ(written.at("models"), 12);
  EXPECT_EQ(count(html, "window.intruder = 1</script>"), 0U);
  const json data = data_of(html);
  EXPECT_EQ(data.at("summary"), wicked);
  ASSERT_EQ(data.at("metrics").size(), 3U);
  EXPECT_EQ(data.at("metrics")[0], json({{"name", "RMS"}, {"unit", "mm"}, {"digits", 2}}));
  EXPECT_EQ(data.at("axes")[1].at("choices")[2].at("label"), "5 cm");
  std::size_t failed = 0;
  for (const auto& variant : data.at("variants")) {
    failed += variant.at("status") == "failed" ? 1 : 0;
    if (variant.at("status") == "failed") {
      EXPECT_NE(variant.value("message", "").find("window.intruder"), std::string::npos) << variant.at("message");
    }
    EXPECT_EQ(variant.at("models").size(), 1U);
  }
  EXPECT_EQ(failed, 6U);
  // Equal models are there once: those of the same noise, whatever the seed and the path of the other file.
  EXPECT_LT(data.at("files").size(), 24U);
  expect_works_in_browser(folder / "out/report.html", true);
}

TEST_F(Report, IsTheSameForTheSameFolder) {
  make_sweep(folder.path());
  ASSERT_EQ(atrium({"report", "out", "-o", "a.html"}, folder.path()).exit_code, 0);
  ASSERT_EQ(atrium({"report", "out", "-o", "b.html"}, folder.path()).exit_code, 0);
  EXPECT_EQ(read_text(folder / "a.html"), read_text(folder / "b.html"));
  EXPECT_EQ(read_text(folder / "a.html").find(folder.path().string() + "/out"), std::string::npos)
      << "a path of this machine";
}

TEST_F(Report, SaysWhatItLeavesOut) {
  make_sweep(folder.path());
  const auto few = atrium({"report", "out", "--most-models", "2"}, folder.path());
  ASSERT_EQ(few.exit_code, 0) << few.err;
  EXPECT_NE(few.err.find("10 of 12 models are not in this file"), std::string::npos) << few.err;
  EXPECT_EQ(data_of(read_text(folder / "out/report.html")).at("notes").size(), 1U);
  const auto none = atrium({"report", "out", "--max-size", "0"}, folder.path());
  ASSERT_EQ(none.exit_code, 0) << none.err;
  EXPECT_NE(none.err.find("12 of 12 pictures are not in this file"), std::string::npos) << none.err;
  const json data = data_of(read_text(folder / "out/report.html"));
  EXPECT_EQ(data.at("files").size(), 0U);
}

TEST_F(Report, TakesTheModelsThatAreAskedFor) {
  make_sweep(folder.path());
  ASSERT_EQ(atrium({"report", "out", "--model", "models/room.ply"}, folder.path()).exit_code, 0);
  const json data = data_of(read_text(folder / "out/report.html"));
  EXPECT_EQ(data.at("variants")[0].at("models")[0][0], "models/room.ply");
  const auto unknown = atrium({"report", "out", "--model", "room.glb"}, folder.path());
  EXPECT_EQ(unknown.exit_code, 1);
  EXPECT_NE(unknown.err.find("no variant has the model 'room.glb'"), std::string::npos) << unknown.err;
  EXPECT_NE(unknown.err.find("models/room.glb, models/room.ply"), std::string::npos) << unknown.err;
}

TEST_F(Report, OfOneRunWorksInABrowser) {
  write_text(folder / "one.yaml", R"(atrium: 1
nodes:
  room: {type: synth.room}
  scan: {type: synth.scan, in: {scene: room.scene}, params: {points: 20000}}
  model: {type: io.write_mesh, in: {mesh: scan.mesh}, params: {path: room.ply}}
  faces: {type: metric.faces, in: {mesh: scan.mesh}}
outputs: {faces: faces.metrics}
)");
  ASSERT_EQ(atrium({"run", "one.yaml", "--out", "run", "--quiet"}, folder.path()).exit_code, 0);
  const auto result = atrium({"report", "run"}, folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json data = data_of(read_text(folder / "run/report.html"));
  EXPECT_FALSE(data.at("sweep"));
  EXPECT_EQ(data.at("variants").size(), 1U);
  EXPECT_EQ(data.at("variants")[0].at("models")[0][0], "room.ply");
  EXPECT_GT(data.at("metrics").size(), 3U);
  for (const auto& metric : data.at("metrics")) {
    const std::string name = metric.at("name");
    EXPECT_TRUE(name.starts_with("faces.") && !name.starts_with("faces.faces.")) << name;
  }
  expect_works_in_browser(folder / "run/report.html", true);
}

TEST_F(Report, NodesThatTheCacheKnewHaveTheTimesOfWhenTheyWereComputed) {
  write_text(folder / "one.yaml", R"(atrium: 1
nodes:
  room: {type: synth.room}
  scan: {type: synth.scan, in: {scene: room.scene}, params: {points: 20000}}
outputs: {cloud: scan.cloud}
)");
  write_text(folder / "s.yaml", "atrium: 1\nsweep: one.yaml\ngrid: {scan.points: [10000, 20000]}\n");
  const auto nodes = [&](const std::string& verb, const std::string& out) {
    const std::vector<std::string> run = verb == "run" ? std::vector<std::string>{"run", "one.yaml"}
                                                       : std::vector<std::string>{"sweep", "run", "s.yaml"};
    std::vector<std::string> command = run;
    command.insert(command.end(), {"--out", out, "--quiet", "--cache", "cache-" + verb});
    EXPECT_EQ(atrium(command, folder.path()).exit_code, 0);
    EXPECT_EQ(atrium({"report", out}, folder.path()).exit_code, 0);
    json all = json::array();
    const json data = data_of(read_text(folder / out / "report.html"));
    for (const auto& variant : data.at("variants"))
      for (const auto& node : variant.at("nodes")) all.push_back(node);
    return all;
  };
  for (const std::string verb : {"run", "sweep"}) {
    const json cold = nodes(verb, verb + "-cold");
    const json warm = nodes(verb, verb + "-warm");
    ASSERT_EQ(cold.size(), verb == "run" ? 2U : 4U);
    ASSERT_EQ(warm.size(), cold.size());
    for (std::size_t i = 0; i < cold.size(); ++i) {
      EXPECT_EQ(cold[i][5], 0);
      EXPECT_EQ(warm[i][5], 1);
      EXPECT_EQ(warm[i][2], cold[i][2]);
      EXPECT_EQ(warm[i][4], cold[i][4]);
    }
  }
}

TEST_F(Report, OfASweepWithoutItsTableShowsWhatIsDone) {
  make_sweep(folder.path());
  fs::remove(folder / "out/table.json");
  const auto result = atrium({"report", "out"}, folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("only the variants that are done are shown"), std::string::npos) << result.err;
  EXPECT_EQ(data_of(read_text(folder / "out/report.html")).at("variants").size(), 12U);
}

TEST_F(Report, OfAThousandVariantsOpensAndSorts) {
  json axes = json::parse(R"([{"name": "a.x", "choices": []}, {"name": "seed", "choices": []}])");
  json table{{"columns",
              {{{"title", "a.x"}, {"kind", "axis"}},
               {{"title", "seed"}, {"kind", "axis"}},
               {{"title", "error [mm]"}, {"kind", "metric"}, {"name", "error"}, {"unit", "mm"}},
               {{"title", "count"}, {"kind", "metric"}, {"name", "count"}, {"unit", ""}}}},
             {"variants", json::array()}};
  for (int x = 0; x < 100; ++x)
    axes[0]["choices"].push_back({{"label", std::to_string(x) + " cm"}, {"set", {{"a.x", std::to_string(x) + " cm"}}}});
  for (int seed = 0; seed < 10; ++seed)
    axes[1]["choices"].push_back({{"label", std::to_string(seed)}, {"set", json::object()}});
  for (int v = 0; v < 1000; ++v) {
    const std::string id = "id" + std::to_string(v);
    const fs::path at = folder / ("out/variants/" + id);
    fs::create_directories(at);
    write_text(
        at / "model.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uchar int vertex_indices\nproperty uchar class\nend_header\n0 0 0\n4 0 0\n0 " +
            std::to_string(1 + v % 7) + " 0\n3 0 1 2 2\n");
    json result{{"id", id}, {"status", "ok"}, {"choices", json::object()}, {"outputs", json::array()}};
    result["nodes"] = json::array();
    for (int n = 0; n < 12; ++n)
      result["nodes"].push_back({{"node", "n" + std::to_string(n)},
                                 {"type", "a.b"},
                                 {"status", "ok"},
                                 {"wall_seconds", 0.01 * n},
                                 {"cpu_seconds", 0.01 * n},
                                 {"peak_memory", 1000000}});
    result["artefacts"] = {{{"path", "model.ply"}, {"bytes", fs::file_size(at / "model.ply")}}};
    write_text(at / "result.json", result.dump());
    write_text(at / "resolved.yaml",
               "atrium: 1\nseed: " + std::to_string(v % 10) +
                   "\nnodes:\n  a:\n    type: a.b\n    params:\n      x: " + std::to_string(v / 10) + " cm\n");
    table["variants"].push_back({{"id", id},
                                 {"a.x", std::to_string(v / 10) + " cm"},
                                 {"seed", std::to_string(v % 10)},
                                 {"error [mm]", (v * 7919) % 1000 + 0.25},
                                 {"count", v},
                                 {"status", "ok"}});
  }
  write_text(folder / "out/sweep.json",
             json{{"atrium", "0"}, {"sweep", "/a/many.yaml"}, {"axes", axes}, {"metrics", json::array()}}.dump());
  write_text(folder / "out/table.json", table.dump());
  const auto result = atrium({"report", "out"}, folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  expect_works_in_browser(folder / "out/report.html", true);
}

TEST_F(Report, RefusesWhatIsNoSweepAndNoRun) {
  fs::create_directories(folder / "empty");
  for (const std::string name : {"empty", "nowhere"}) {
    const auto result = atrium({"report", name}, folder.path());
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_NE(result.err.find(name), std::string::npos) << result.err;
  }
  fs::create_directories(folder / "old");
  write_text(folder / "old/sweep.json", R"({"atrium": "0.1.0", "sweep": "s.yaml"})");
  const auto old = atrium({"report", "old"}, folder.path());
  EXPECT_EQ(old.exit_code, 1);
  EXPECT_NE(old.err.find("older version"), std::string::npos) << old.err;
  write_text(folder / "old/sweep.json",
             R"({"atrium": "0.1.0", "sweep": "s.yaml", "axes": [], "metrics": [{"digits": 1}]})");
  EXPECT_NE(atrium({"report", "old"}, folder.path()).err.find("cannot be understood"), std::string::npos);
}

TEST(ReportPage, ThatWasNotBuiltIsNamedWithWhatToDo) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "bin");
  fs::copy_file(ATRIUM_PROGRAM, folder / "bin/atrium");
  write_text(folder / "manifest.json", R"({"status": "ok", "nodes": [], "outputs": {}})");
  write_text(folder / "resolved.yaml", "seed: 1\n");
  const auto result = run_process({(folder / "bin/atrium").string(), "report", folder.path().string()});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("share/atrium/report.html"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("./share/install-packages, then"), std::string::npos) << result.err;
  EXPECT_FALSE(fs::exists(folder / "report.html"));
}

TEST(ReportParts, ATableOfOtherAxesIsNotTakenForTheSweeps) {
  // A sweep over a.x had ended; its file was changed to vary b.y, begun again in the same folder, and killed.
  const TemporaryFolder folder;
  const auto variant = [&](const std::string& id, const std::string& axis, const std::string& choice) {
    fs::create_directories(folder / ("variants/" + id));
    const json result{{"id", id},
                      {"status", "ok"},
                      {"choices", {{axis, choice}, {"seed", "1"}}},
                      {"nodes", json::array()},
                      {"outputs", json::array()},
                      {"artefacts", json::array()}};
    write_text(folder / ("variants/" + id + "/result.json"), result.dump());
    write_text(folder / ("variants/" + id + "/resolved.yaml"), "atrium: 1\nseed: 1\nnodes: {}\n");
  };
  const auto write_sweep = [&](const std::string& axis, const std::vector<std::string>& labels) {
    json axes = json::array({{{"name", "seed"}, {"choices", {{{"label", "1"}, {"set", json::object()}}}}},
                             {{"name", axis}, {"choices", json::array()}}});
    for (const auto& label : labels) axes[1]["choices"].push_back({{"label", label}, {"set", json::object()}});
    write_text(folder / "sweep.json", json{{"sweep", "/s.yaml"}, {"axes", axes}, {"metrics", json::array()}}.dump());
  };
  variant("old", "a.x", "1 cm");
  variant("new", "b.y", "1 cm");
  const auto write_table = [&](const std::string& id, const std::string& axis, const std::string& choice) {
    const json columns{{{"title", "seed"}, {"kind", "axis"}},
                       {{"title", axis}, {"kind", "axis"}},
                       {{"title", "count"}, {"kind", "metric"}, {"name", "count"}, {"unit", ""}}};
    const json row{{"id", id}, {"seed", "1"}, {axis, choice}, {"count", 7}, {"status", "ok"}};
    write_text(folder / "table.json", json{{"columns", columns}, {"variants", {row}}}.dump());
  };
  write_table("old", "a.x", "1 cm");
  const auto shown = [&] {
    std::vector<std::string> ids;
    const auto record = report::read_sweep_folder(folder.path());
    for (const auto& found : record.variants) ids.push_back(found.run.id);
    return std::pair(ids, record.notes.size());
  };
  using Ids = std::vector<std::string>;
  write_sweep("a.x", {"1 cm", "2 cm"});
  EXPECT_EQ(shown(), std::pair(Ids{"old"}, std::size_t{0}));
  write_sweep("b.y", {"1 cm", "2 cm"});
  EXPECT_EQ(shown(), std::pair(Ids{"new"}, std::size_t{2}));
  // The same axes, other choices.
  write_table("gone", "b.y", "5 cm");
  EXPECT_EQ(shown(), std::pair(Ids{"new"}, std::size_t{2}));
  write_text(folder / "table.json", "cut off");
  EXPECT_EQ(shown(), std::pair(Ids{"new"}, std::size_t{2}));
}

TEST(ReportParts, AFileThatIsTooLargeIsNotRead) {
  const TemporaryFolder folder;
  write_text(folder / "model.glb", "");
  fs::resize_file(folder / "model.glb", std::uintmax_t{1} << 36U);  // a hole: it takes no room on the disk
  report::SweepRecord record;
  report::RunRecord run;
  run.folder = folder.path();
  run.files = {{"model.glb", std::uintmax_t{1} << 36U, "some hash"}, {"gone.png", 10, "another hash"}};
  record.variants.push_back({run, {}});
  const auto attachments = report::attach(record, {});
  EXPECT_TRUE(attachments.files.empty());
  ASSERT_EQ(attachments.notes.size(), 3U);
  EXPECT_TRUE(attachments.notes[1].starts_with("1 of 1 models are not in this file")) << attachments.notes[1];
  EXPECT_NE(attachments.notes[2].find("gone.png cannot be read"), std::string::npos) << attachments.notes[2];
}

TEST(ReportParts, Base64IsThatOfTheStandard) {  // RFC 4648, section 10
  EXPECT_EQ(report::to_base64(""), "");
  EXPECT_EQ(report::to_base64("f"), "Zg==");
  EXPECT_EQ(report::to_base64("fo"), "Zm8=");
  EXPECT_EQ(report::to_base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(report::to_base64("\xff\xfe"), "//4=");
}

}  // namespace
}  // namespace atrium::test::report_test
