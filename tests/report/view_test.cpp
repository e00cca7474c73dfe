// The page that shows one run: what is packed into it, and how it works in a browser.
#include "graph/report/view.hpp"

#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>

#include "graph/report/thinned_points.hpp"
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

TEST(ViewParts, NameTheNodeThatWroteThem) {
  const TemporaryFolder folder;
  make_run(folder / "run", {{"model.ply", "1"}});
  EXPECT_EQ(packed(folder / "run", {{"model", {"model.ply"}, "x.y"}}).parts[0].node, "n");
  json manifest = json::parse(read_text(folder / "run/manifest.json"));
  manifest["nodes"][0]["artefacts"] = json::array();
  write_text(folder / "run/manifest.json", manifest.dump());
  write_text(folder / "run/model.ply", "1");
  for (const auto& part : packed(folder / "run", {{"model", {"model.ply"}, "x.y"}}).parts) EXPECT_EQ(part.node, "");
}

/// A GLB file of points: places and colours, each of three 16-bit numbers in rows of 8 bytes; in two tiles.
std::string glb_of_points(std::size_t first, std::size_t second, const std::string& more = {}) {
  std::string bytes;
  const auto number = [](std::string& to, std::size_t value, int size) {
    for (int i = 0; i < size; ++i) to += static_cast<char>((value >> (8 * i)) & 255U);
  };
  std::uint32_t state = 1;
  for (const std::size_t what : {0, 1})  // a colour says which place is its own
    for (std::size_t i = 0; i < first + second; ++i) {
      for (int k = 0; k < 2; ++k)
        number(bytes, what == 0 ? (state = state * 1664525U + 1013904223U) >> 16U : i >> (8 * k), 2);
      number(bytes, i, 2);
      number(bytes, 0, 2);
    }
  const auto accessor = [&](int view, std::size_t from, std::size_t count) {
    return json{
        {"bufferView", view}, {"byteOffset", 8 * from}, {"componentType", 5123}, {"type", "VEC3"}, {"count", count}};
  };
  const std::size_t half = 8 * (first + second);
  json description{
      {"asset", {{"version", "2.0"}}},
      {"nodes", {{{"mesh", 0}}, {{"mesh", 1}}}},
      {"meshes",
       {{{"primitives", {{{"mode", 0}, {"attributes", {{"POSITION", 0}, {"COLOR_0", 1}}}}}}},
        {{"primitives", {{{"mode", 0}, {"attributes", {{"POSITION", 2}, {"COLOR_0", 3}}}}}}}}},
      {"accessors",
       {accessor(0, 0, first), accessor(1, 0, first), accessor(0, first, second), accessor(1, first, second)}},
      {"bufferViews",
       {{{"buffer", 0}, {"byteLength", half}, {"byteStride", 8}},
        {{"buffer", 0}, {"byteOffset", half}, {"byteLength", half}, {"byteStride", 8}}}},
      {"buffers", {{{"byteLength", 2 * half}}}}};
  if (!more.empty()) description["meshes"][0]["primitives"][0].merge_patch(json::parse(more));
  std::string text = description.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::string glb;
  for (const std::size_t n :
       {std::size_t{0x46546c67}, std::size_t{2}, 28 + text.size() + bytes.size(), text.size(), std::size_t{0x4e4f534a}})
    number(glb, n, 4);
  glb += text;
  number(glb, bytes.size(), 4);
  number(glb, 0x004e4942, 4);
  return glb + bytes;
}

/// Its accessors' rows, as numbers.
std::vector<std::vector<std::array<unsigned, 3>>> rows_of(const std::string& glb) {
  const auto number = [&](std::size_t at, int size) {
    std::size_t value = 0;
    for (int i = size; i-- > 0;)
      value = value << 8U | static_cast<unsigned char>(glb.at(at + static_cast<std::size_t>(i)));
    return value;
  };
  EXPECT_EQ(number(8, 4), glb.size());
  const std::size_t length = number(12, 4);
  const json description = json::parse(glb.substr(20, length));
  EXPECT_EQ(number(20 + length, 4), description["buffers"][0]["byteLength"]);
  std::vector<std::vector<std::array<unsigned, 3>>> result;
  for (const auto& accessor : description["accessors"]) {
    const json& view = description["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    const std::size_t offset = accessor["byteOffset"], count = accessor["count"];
    EXPECT_LE(offset + 8 * count, view["byteLength"].get<std::size_t>());
    auto& rows = result.emplace_back();
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t at = 28 + length + view.value("byteOffset", std::size_t{0}) + offset + 8 * i;
      rows.push_back({static_cast<unsigned>(number(at, 2)), static_cast<unsigned>(number(at + 2, 2)),
                      static_cast<unsigned>(number(at + 4, 2))});
    }
  }
  return result;
}

TEST(ThinnedPoints, KeepTheirAttributesAndAreSpreadOverTheFile) {
  const std::string glb = glb_of_points(6000, 2000);
  const auto whole = rows_of(glb);
  const auto thinned = report::thinned_points(glb, 0.25);
  ASSERT_TRUE(thinned);
  EXPECT_EQ(thinned->points, 2000U);
  EXPECT_EQ(thinned->of, 8000U);
  EXPECT_EQ(thinned->glb, report::thinned_points(glb, 0.25)->glb);
  const auto rows = rows_of(thinned->glb);
  ASSERT_EQ(rows.size(), 4U);
  for (const std::size_t tile : {0, 2}) {
    ASSERT_EQ(rows[tile].size(), tile == 0 ? 1500U : 500U);
    ASSERT_EQ(rows[tile + 1].size(), rows[tile].size());
    for (std::size_t i = 0; i < rows[tile].size(); ++i) {
      const unsigned number = rows[tile][i][2], in_tile = number - (tile == 0 ? 0 : 6000);
      EXPECT_EQ(rows[tile + 1][i][2], number) << "a place with another one's colour";
      EXPECT_EQ(rows[tile][i], whole[tile][in_tile]);
      EXPECT_EQ(in_tile / 4, i) << "one of each four";
    }
  }
  EXPECT_EQ(report::thinned_points(glb, 1e-9)->points, 2U) << "one of each tile";
}

TEST(ThinnedPoints, LeaveOtherFilesAlone) {
  const std::string glb = glb_of_points(50, 50);
  EXPECT_TRUE(report::thinned_points(glb, 0.5));
  EXPECT_FALSE(report::thinned_points("ply\n", 0.5));
  EXPECT_FALSE(report::thinned_points("", 0.5));
  EXPECT_FALSE(report::thinned_points(glb.substr(0, glb.size() - 8), 0.5)) << "cut short";
  EXPECT_FALSE(report::thinned_points(glb_of_points(50, 50, R"({"mode": 4})"), 0.5)) << "triangles";
  EXPECT_FALSE(report::thinned_points(glb_of_points(50, 50, R"({"indices": 1})"), 0.5));
  EXPECT_FALSE(report::thinned_points(glb_of_points(50, 50, R"({"attributes": {"COLOR_0": 3}})"), 0.5)) << "shared";
}

TEST(ViewParts, ThinPointsUntilTheyHaveRoom) {
  const TemporaryFolder folder;
  make_run(folder / "run", {{"scan.glb", glb_of_points(60'000, 60'000)}, {"plan.svg", "<svg/>"}});
  const std::vector<report::ViewWish> wishes{{"plan", {"plan.svg"}, "a.b"}, {"scan", {"scan.glb"}, "a.b"}};
  const auto whole = packed(folder / "run", wishes, 10'000'000);
  EXPECT_TRUE(whole.parts[1].note.empty());
  const std::size_t size = whole.files[1].base64.size();
  const auto thinned = packed(folder / "run", wishes, size / 3);
  ASSERT_EQ(thinned.files.size(), 2U);
  EXPECT_LE(thinned.files[0].base64.size() + thinned.files[1].base64.size(), size / 3);
  EXPECT_GT(thinned.files[1].base64.size(), size / 4) << "more points had room";
  EXPECT_NE(thinned.parts[1].note.find("of its 120000 points are in the page"), std::string::npos)
      << thinned.parts[1].note;
  EXPECT_EQ(packed(folder / "run", wishes, size / 3).files[1].base64, thinned.files[1].base64);
  const auto none = packed(folder / "run", wishes, 2000);
  EXPECT_EQ(none.files.size(), 1U) << "a handful of points is no scan";
  EXPECT_NE(none.parts[1].lacking.find("--max-size gives more"), std::string::npos);
}

TEST(ViewParts, OfAGigabyteAreNotReadToBeThinned) {
  const TemporaryFolder folder;
  make_run(folder / "run", {{"scan.glb", "glTF"}});
  fs::resize_file(folder / "run/scan.glb", 1'100'000'000);  // a hole: it takes no place
  const auto view = packed(folder / "run", {{"scan", {"scan.glb"}, "a.b"}}, 25'000'000);
  EXPECT_EQ(view.parts[0].lacking,
            "scan.glb takes 1100.0 MB of the page, which has room for 25.0 MB: --max-size gives more");
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
