// The page that shows one run: what is packed into it, and how it works in a browser.
#include "graph/report/view.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/lacking.hpp"
#include "tests/support/temporary_folder.hpp"

namespace atrium::test::view_test {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

const fs::path page = fs::path(ATRIUM_PROGRAM).parent_path().parent_path() / "share/atrium/view.html";

ProcessResult atrium(std::vector<std::string> arguments, const fs::path& folder) {
  arguments.insert(arguments.begin(), ATRIUM_PROGRAM);
  ProcessOptions options;
  options.folder = folder;
  options.timeout = 240;
  return run_process(arguments, options);
}

/// The folder of a run whose one node, of the type a.b, wrote these files; the texts are their contents.
void make_run(const fs::path& folder, const std::map<std::string, std::string>& files,
              const std::string& status = "ok") {
  fs::create_directories(folder);
  json artefacts = json::array();
  for (const auto& [name, text] : files) {
    fs::create_directories((folder / name).parent_path());
    write_text(folder / name, text);
    artefacts.push_back({{"path", name}, {"bytes", text.size()}});
  }
  json node{{"node", "n"}, {"type", "a.b"}, {"version", 1}, {"status", status}, {"artefacts", artefacts}};
  if (status == "failed") node["message"] = "no disk </script>";
  if (status == "ok")
    node.update({{"wall_seconds", 1}, {"cpu_seconds", 1}, {"peak_memory", 1}, {"outputs", json::array()}});
  write_text(folder / "manifest.json", json{{"status", status}, {"nodes", {node}}, {"outputs", json::object()}}.dump());
  write_text(folder / "resolved.yaml", "atrium: 1\nnodes:\n  n:\n    type: a.b\n    params:\n      unit: ft\n");
}

report::View packed(const fs::path& folder, const std::vector<report::ViewWish>& parts, std::size_t room = 1'000'000) {
  return report::pack_view(report::read_run(folder), {parts, {}}, room);
}

TEST(ViewParts, HaveTheFirstOfTheWishedFilesThatIsThere) {
  const TemporaryFolder folder;
  make_run(folder / "run", {{"b.csv", "2"}, {"sub/c.csv", "3"}, {"d.svg", "4"}});
  const auto view = packed(folder / "run", {{"one", {"a.csv", "b.csv"}, "x.y"},
                                            {"other", {"c.csv"}, "x.y"},
                                            {"by type", {"plan.svg"}, "a.b"},
                                            {"none", {"plan.glb"}, "a.b"},
                                            {"nobody", {"e.json"}, "x.y"}});
  ASSERT_EQ(view.parts.size(), 5U);
  EXPECT_EQ(view.parts[0].path, "b.csv");
  EXPECT_EQ(view.parts[1].path, "sub/c.csv");
  EXPECT_EQ(view.parts[2].path, "d.svg") << "of another name, by the node type that wrote it";
  EXPECT_EQ(view.parts[3].lacking, "plan.glb is lacking: a.b writes it; in this run 'n' wrote other files");
  EXPECT_EQ(view.parts[4].lacking, "e.json is lacking: x.y writes it, and this run has no such node");
  EXPECT_EQ(view.lacking, 2U);
  EXPECT_EQ(view.files.size(), 3U);
}

TEST(ViewParts, SayWhyTheyAreLacking) {
  const TemporaryFolder folder;
  make_run(folder / "run", {{"gone.csv", "1"}, {"large.csv", std::string(200'000, 'x') + "12345"}});
  fs::remove(folder / "run/gone.csv");
  const auto view = packed(folder / "run", {{"gone", {"gone.csv"}, "a.b"}}, 100);
  EXPECT_NE(view.parts[0].lacking.find("gone.csv is not in the run's folder any more"), std::string::npos);
  std::string noise;
  std::uint32_t state = 1;
  for (int i = 0; i < 100'000; ++i) noise += static_cast<char>((state = state * 1664525U + 1013904223U) >> 24U);
  write_text(folder / "run/large.csv", noise);
  const auto large = packed(folder / "run", {{"large", {"large.csv"}, "a.b"}}, 20'000);
  EXPECT_NE(large.parts[0].lacking.find("has room for 0.0 MB: --max-size gives more"), std::string::npos)
      << large.parts[0].lacking;
  EXPECT_TRUE(large.files.empty());
  make_run(folder / "failed", {}, "failed");
  const auto failed = packed(folder / "failed", {{"plan", {"plan.svg"}, "a.b"}});
  EXPECT_EQ(failed.parts[0].lacking, "plan.svg is lacking: a.b writes it; in this run 'n' failed: no disk </script>");
}

TEST(ViewParts, NeverComeFromOutsideOfTheRunsFolder) {
  const TemporaryFolder folder;
  write_text(folder / "secret.csv", "secret");
  make_run(folder / "run", {});
  json manifest = json::parse(read_text(folder / "run/manifest.json"));
  manifest["nodes"][0]["artefacts"] = {{{"path", "../secret.csv"}, {"bytes", 6}}};
  write_text(folder / "run/manifest.json", manifest.dump());
  const auto view = packed(folder / "run", {{"secret", {"secret.csv"}, "a.b"}});
  EXPECT_TRUE(view.files.empty());
}

TEST(ViewPage, WithoutItsWishesIsRefused) {
  EXPECT_THROW(report::read_wishes("<html></html>", "page"), Error);
  const std::string open = "<script type=\"application/json\" id=\"wishes\">";
  for (const std::string text : {"", "{", "{}", R"({"parts": [{"part": "a"}], "parameters": []})",
                                 R"({"parts": [{"part": "a", "files": [], "node": "b"}], "parameters": []})"})
    EXPECT_THROW(report::read_wishes(open + text + "</script>", "page"), Error) << text;
  const auto wishes = report::read_wishes(
      open + R"({"parts": [{"part": "a", "files": ["f"], "node": "b.c"}], "parameters": [["b.c", "d"]]})" + "</script>",
      "page");
  EXPECT_EQ(wishes.parts[0].node, "b.c");
  EXPECT_EQ(wishes.parameters[0].second, "d");
}

TEST(ViewPage, ThatWasNotBuiltIsNamedWithWhatToDo) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "bin");
  fs::copy_file(ATRIUM_PROGRAM, folder / "bin/atrium");
  make_run(folder / "run", {});
  const auto result = run_process({(folder / "bin/atrium").string(), "view", (folder / "run").string()});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("share/atrium/view.html"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("./share/install-packages, then"), std::string::npos) << result.err;
  EXPECT_FALSE(fs::exists(folder / "run/view.html"));
}

class View : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(page)) ATRIUM_SKIP_LACKING("the view's page was not built (esbuild, libjs-three): " << page);
  }
  /// What the browser said of the page; skips where there is none.
  static void expect_works_in_browser(const std::vector<std::string>& arguments) {
    for (const auto* program : {"chromium", "node"})
      if (!has_program(program)) ATRIUM_SKIP_LACKING(program << " is not installed (share/install-packages --tests)");
    std::vector<std::string> command{"node", ATRIUM_SOURCE_DIR "/tests/report/view.mjs", "chromium"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    ProcessOptions options;
    options.timeout = 900;  // on a busy machine without a graphics card
    const auto result = run_process(command, options);
    EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
    std::printf("%s", result.out.c_str());
  }
  static std::string pipeline(const std::string& name) { return ATRIUM_SOURCE_DIR "/pipelines/" + name; }
  TemporaryFolder folder;
};

TEST_F(View, RefusesWhatIsNoRun) {
  for (const std::string name : {"empty", "nowhere"}) {
    if (name == "empty") fs::create_directories(folder / name);
    const auto result = atrium({"view", name}, folder.path());
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_NE(result.err.find(name + " is no folder of a run"), std::string::npos) << result.err;
  }
  make_run(folder / "run", {});
  write_text(folder / "run/manifest.json", "{\"status\": 3}");
  EXPECT_EQ(atrium({"view", "run"}, folder.path()).exit_code, 1);
}

TEST_F(View, OfARunWithoutItsFilesSaysWhatIsLackingAndWhoWritesIt) {
  make_run(folder / "run", {{"building.json", "{\"atrium_building\": 1, \"vertices\": [[NaN"},
                            {"scan.glb", "glTF"},
                            {"rooms.csv", "number,name\n0,\"a </script><script>window.intruder = 1</script>\"\n"}});
  const auto result = atrium({"view", "run", "--json"}, folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("note: without plan: floorplan.svg is lacking: floorplan.write_svg writes it"),
            std::string::npos)
      << result.err;
  const json written = json::parse(result.out);
  EXPECT_EQ(written.at("parts").size(), 3U);
  EXPECT_EQ(written.at("bytes"), fs::file_size(folder / "run/view.html"));
  EXPECT_EQ(read_text(folder / "run/view.html").find("window.intruder = 1</script>"), std::string::npos);
  expect_works_in_browser({(folder / "run/view.html").string(), "lacking"});
}

TEST_F(View, OfAScannedFlatWorksInABrowserAndWritesCorrections) {
  ASSERT_EQ(atrium({"run", pipeline("simulate.yaml"), "-s", "points=150000", "-s", "yaw=23 deg", "-s",
                    "offset=[500000, 5400000, 300]", "--out", "scan", "--quiet"},
                   folder.path())
                .exit_code,
            0);
  const auto run = [&](const std::string& out, const std::vector<std::string>& more) {
    std::vector<std::string> command{"run",    pipeline("atrium.yaml"), "-s", "scan=scan/scan.ply", "--out", out,
                                     "--quiet"};
    command.insert(command.end(), more.begin(), more.end());
    return atrium(command, folder.path());
  };
  ASSERT_EQ(run("flat", {}).exit_code, 0);
  const auto result = atrium({"view", "flat", "--json"}, folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json written = json::parse(result.out);
  EXPECT_TRUE(written.at("lacking").empty()) << written;
  EXPECT_LT(written.at("bytes"), 25'000'000);
  ASSERT_EQ(atrium({"view", "flat", "-o", "again.html"}, folder.path()).exit_code, 0);
  EXPECT_EQ(read_text(folder / "again.html"), read_text(folder / "flat/view.html"));
  EXPECT_EQ(read_text(folder / "again.html").find(folder.path().string()), std::string::npos)
      << "a path of this machine";
  // The browser leaves the corrections that it wrote; they are what building.correct reads.
  expect_works_in_browser({(folder / "flat/view.html").string(), "flat", (folder / "corrections.yaml").string()});
  if (IsSkipped() || HasFailure()) return;
  const auto corrected = run("corrected", {"-s", "corrections=corrections.yaml"});
  ASSERT_EQ(corrected.exit_code, 0) << corrected.err << read_text(folder / "corrections.yaml");
  const json before = json::parse(read_text(folder / "flat/building.json"));
  const json after = json::parse(read_text(folder / "corrected/building.json"));
  const auto windows = [](const json& building) {
    return std::count_if(building["openings"].begin(), building["openings"].end(),
                         [](const json& o) { return o["kind"] == "window"; });
  };
  EXPECT_EQ(windows(after), windows(before) + 1);
  const auto named = [&](const json& room) { return room["name"] == "Küche \"Süd\""; };
  EXPECT_TRUE(std::any_of(after["rooms"].begin(), after["rooms"].end(), named));
  // What is corrected already is not corrected by its new numbers.
  ASSERT_EQ(atrium({"view", "corrected"}, folder.path()).exit_code, 0);
  expect_works_in_browser({(folder / "corrected/view.html").string(), "corrected"});
}

}  // namespace
}  // namespace atrium::test::view_test
