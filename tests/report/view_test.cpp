// The page that shows one run: how it is written, and how it works in a browser.
#include "graph/report/view.hpp"

#include <gtest/gtest.h>

#include "runs.hpp"
#include "tests/support/lacking.hpp"

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

TEST(ViewPage, NeverTakesMoreThanItMay) {
  const TemporaryFolder folder;
  make_run(folder / "run", {{"scan.csv", std::string(3000, 'x')}});
  const std::string wishes = R"({"parts": [{"part": "scan", "files": ["scan.csv"], "node": "a.b"},)"
                             R"({"part": "none", "files": [")" +
                             std::string(5000, 'n') + R"("], "node": "x.y"}], "parameters": []})";
  write_text(folder / "page.html", "<script type=\"application/json\" id=\"wishes\">" + wishes + "</script>");
  const report::RunRecord run = report::read_run(folder / "run");
  const std::size_t page_size = fs::file_size(folder / "page.html");
  // Between the page without a word of what it lacks, and the page with it.
  try {
    report::write_view(folder / "view.html", run, folder / "page.html", page_size + 3000);
    ADD_FAILURE() << "nothing was refused: " << fs::file_size(folder / "view.html");
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("with what it says of the run's files"), std::string::npos)
        << error.what();
  }
  EXPECT_FALSE(fs::exists(folder / "view.html"));
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
  const std::string two_storeys =
      "ply\nformat ascii 1.0\nelement vertex 6\nproperty double x\nproperty double y\nproperty double z\n"
      "element face 2\nproperty list uchar int vertex_indices\nproperty uchar class\nproperty int storey\n"
      "property int primitive\nend_header\n0 0 0\n4 0 0\n0 3 0\n0 0 3\n4 0 3\n0 3 3\n3 0 1 2 2 0 0\n3 3 4 5 2 1 1\n";
  make_run(folder / "run", {{"building.json", "{\"atrium_building\": 1, \"vertices\": []}"},
                            {"scene.ply", two_storeys},
                            {"scan.glb", "glTF"},
                            {"rooms.csv", "number,name\n0,\"a </script><script>window.intruder = 1</script>\"\n"}});
  const auto result = atrium({"view", "run", "--json"}, folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("note: without plan: floorplan.svg is lacking: floorplan.write_svg writes it"),
            std::string::npos)
      << result.err;
  const json written = json::parse(result.out);
  EXPECT_EQ(written.at("parts").size(), 4U);
  EXPECT_EQ(written.at("bytes"), fs::file_size(folder / "run/view.html"));
  EXPECT_EQ(read_text(folder / "run/view.html").find("window.intruder = 1</script>"), std::string::npos);
  expect_works_in_browser({(folder / "run/view.html").string(), "lacking"});
}

TEST_F(View, KeepsToItsSizeAndRefusesLessThanThePageItselfTakes) {
  make_run(folder / "run", {{"scan.glb", glb_of_points(60'000, 60'000)}});
  const auto refused = atrium({"view", "run", "--max-size", "0.1"}, folder.path());
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_NE(refused.err.find("without any file of the run, --max-size allows 0.10 MB"), std::string::npos)
      << refused.err;
  EXPECT_FALSE(fs::exists(folder / "run/view.html"));
  const auto least = refused.err.find("--max-size ", refused.err.find('\n'));
  ASSERT_NE(least, std::string::npos) << refused.err;
  // What it says would do does; and a page is never larger than was allowed.
  std::string words = refused.err.substr(least + 11);
  words = words.substr(0, words.find(' '));
  std::size_t before = 0;
  for (const std::string& size :
       {words, fmt::format("{}", std::stod(words) + 0.2), fmt::format("{}", std::stod(words) + 0.5)}) {
    const auto result = atrium({"view", "run", "--max-size", size, "--json"}, folder.path());
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const json written = json::parse(result.out);
    const std::size_t bytes = written.at("bytes");
    EXPECT_EQ(bytes, fs::file_size(folder / "run/view.html"));
    EXPECT_LE(static_cast<double>(bytes), 1e6 * std::stod(size));
    EXPECT_GT(bytes, before) << "more points have room";
    EXPECT_EQ(written.at("notes").size(), 1U) << written;
    before = bytes;
  }
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
  // The model is written by a node whose name says nothing, in feet: the page has both from the manifest.
  ASSERT_EQ(run("flat", {"-s", "write_scene.path=other.ply", "-s", "write_structure.path=scene.ply", "-s",
                         "write_structure.unit=ft"})
                .exit_code,
            0);
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
  const auto named = [&](const std::string& beginning) {
    return std::count_if(after["rooms"].begin(), after["rooms"].end(),
                         [&](const json& room) { return room["name"].get<std::string>().starts_with(beginning); });
  };
  EXPECT_EQ(named("Küche \"Süd\" <script>"), 1);
  EXPECT_EQ(named("left part") + named("right part"), 2);
  EXPECT_EQ(after["rooms"].size(), before["rooms"].size() + 1);
  const auto thick = [](const json& face) { return face.value("backing", 0.0) == 0.36; };
  EXPECT_EQ(std::count_if(after["faces"].begin(), after["faces"].end(), thick), 1);
  EXPECT_NE(read_text(folder / "corrected/walls.csv").find(",0.360,no,"), std::string::npos);
  // What is corrected already is not corrected by its new numbers.
  ASSERT_EQ(atrium({"view", "corrected"}, folder.path()).exit_code, 0);
  expect_works_in_browser({(folder / "corrected/view.html").string(), "corrected"});
}

}  // namespace
}  // namespace atrium::test::view_test
