// share/quickstart as a newcomer starts it, but for the packages and the build, which are there.
#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "tests/pipelines/steps.hpp"

namespace atrium::test::quickstart_test {
namespace {

class Quickstart : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* folder : {"share", "build/bin"}) fs::create_directories(checkout / folder);
    fs::create_directory_symlink(source / "pipelines", checkout / "pipelines");
    fs::copy_file(source / "share/quickstart", checkout / "share/quickstart");
    write_program("share/install-packages", "exit 0");
    write_program("share/build", "exit 0");
    write_program("build/bin/atrium", "exec '" ATRIUM_PROGRAM "' \"$@\"");
  }
  void write_program(const fs::path& name, const std::string& command) {
    write_text(checkout / name, "#!/bin/sh\n" + command + "\n");
    fs::permissions(checkout / name, fs::perms::owner_all);
  }
  ProcessResult start(std::vector<std::string> words) {
    words.insert(words.begin(), (checkout / "share/quickstart").string());
    ProcessOptions options;
    options.folder = checkout.path();
    options.timeout = 120;
    return run_process(words, options);
  }
  TemporaryFolder checkout;
};

TEST_F(Quickstart, SaysWhatItFoundAndWhereItIs) {
  ASSERT_EQ(run_pipeline_file("simulate.yaml", {"scene.type=synth.room", "points=50000"}, checkout / "scan").exit_code,
            0);
  const auto result = start({"scan/scan.ply"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::vector<std::string> lines;
  std::istringstream text(result.out);
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  ASSERT_GE(lines.size(), 5U) << result.out;
  EXPECT_TRUE(lines[1].starts_with("1 closed rooms of ")) << lines[1];
  EXPECT_EQ(lines[1].find("  "), std::string::npos) << "a number is missing: " << lines[1];
  EXPECT_TRUE(std::regex_match(lines[2], std::regex("Confidence (1|0[.][0-9]+) of 1; .*(warns of|warn of) .*[.]")))
      << lines[2];
  // The page to look at is named first, where it could be built.
  const fs::path page = fs::path(ATRIUM_PROGRAM).parent_path().parent_path() / "share/atrium/view.html";
  EXPECT_EQ(fs::exists(checkout / "runs/scan-scan/view.html"), fs::exists(page));
  EXPECT_TRUE(lines[4].starts_with(fs::exists(page) ? "  view.html " : "  building.json ")) << lines[4];
  for (const char* file : {"building.json", "building.ifc", "rooms.csv", "building.city.json", "floorplan.svg",
                           "floorplan.pdf", "floorplan.dxf", "floorplan.geojson", "shell.ply", "structure.ply",
                           "scene.glb", "scene.ply", "scene_without_ceiling.ply"}) {
    EXPECT_NE(result.out.find(fs::path(file).extension()), std::string::npos) << file;
    EXPECT_TRUE(fs::exists(checkout / "runs/scan-scan" / file)) << file;
  }
}

TEST_F(Quickstart, EndsWithTheCodeOfWhatFails) {
  EXPECT_EQ(start({"nowhere.ply"}).exit_code, 1);
  EXPECT_EQ(start({"one", "two"}).exit_code, 2);
  write_text(checkout / "scan.ply", "no scan");
  EXPECT_NE(start({"scan.ply"}).exit_code, 0);
}

std::set<std::string> matches(const std::string& text, const std::string& pattern) {
  const std::regex expression(pattern);
  std::set<std::string> found;
  for (std::sregex_iterator i(text.begin(), text.end(), expression), end; i != end; ++i) found.insert((*i)[1]);
  return found;
}

TEST_F(Quickstart, BuildsThePluginsThatItsPipelinesName) {
  const std::string list = read_text(source / "modules/CMakeLists.txt");
  const auto lists = matches(list, "set\\(quickstart_modules ([^)]*)\\)");
  ASSERT_EQ(lists.size(), 1U);
  auto built = matches(*lists.begin(), "([a-z_]+)");
  built.insert("object");  // whose light library has object.none
  std::set<std::string> needed;
  for (const char* pipeline : {"simulate.yaml", "atrium.yaml"})
    needed.merge(matches(read_text(source / "pipelines" / pipeline), "type: ([a-z_]+)\\.[a-z_]+[,}\n]"));
  ASSERT_GT(needed.size(), 5U);
  EXPECT_EQ(built, needed);
  EXPECT_EQ(matches(read_text(source / "pipelines/atrium.yaml"), "type: object\\.([a-z_]+)"),
            std::set<std::string>{"none"});
}

}  // namespace
}  // namespace atrium::test::quickstart_test
