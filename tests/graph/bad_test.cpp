// Every file tests/bad/NAME.yaml has one kind of mistake, and NAME.expected holds what `atrium check` must say about
// it. Comment lines that begin with "# -s " in the file are settings of the command line. ${DIR} in the expected text
// stands for the folder tests/bad, ${PIPELINES} for the installed pipelines. ATRIUM_UPDATE_EXPECTED=1 writes the
// expected files anew: read them before you commit them.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "graph/pipeline/find_pipeline.hpp"
#include "graph/pipeline/pipeline.hpp"
#include "tests/graph/test_nodes.hpp"

namespace atrium::bad_test {
namespace {

const std::filesystem::path folder = std::filesystem::path(ATRIUM_SOURCE_DIR) / "tests/bad";

std::string contents(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

std::vector<Override> settings(const std::string& text) {
  std::vector<Override> result;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    if (line.starts_with("# -s ")) result.push_back({line.substr(5), line.substr(2)});
  return result;
}

std::string without_folders(std::string text) {
  const auto replace = [&](const std::string& path, const char* name) {
    for (std::size_t at = 0; (at = text.find(path, at)) != std::string::npos;) text.replace(at, path.size(), name);
  };
  replace(folder.string(), "${DIR}");
  replace(installed_pipelines().string(), "${PIPELINES}");
  return text;
}

std::string findings(const std::filesystem::path& file) {
  Registry registry(std::vector<std::filesystem::path>{});
  test::add_test_nodes(registry);
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder);
  const LoadResult result = load_pipeline(file.filename(), settings(contents(file)), registry);
  std::filesystem::current_path(before);
  EXPECT_FALSE(result.errors.empty());
  std::string text;
  for (const auto& diagnostic : result.warnings) text += to_string(diagnostic) + "\n";
  for (const auto& diagnostic : result.errors) text += to_string(diagnostic) + "\n";
  return without_folders(text);
}

std::vector<std::string> bad_files() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

class BadFile : public testing::TestWithParam<std::string> {};

TEST_P(BadFile, IsReportedAsExpected) {
  const std::filesystem::path expected = folder / (GetParam() + ".expected");
  const std::string found = findings(folder / (GetParam() + ".yaml"));
  if (std::getenv("ATRIUM_UPDATE_EXPECTED") != nullptr) std::ofstream(expected, std::ios::binary) << found;
  EXPECT_EQ(found, contents(expected));
}

INSTANTIATE_TEST_SUITE_P(Files, BadFile, testing::ValuesIn(bad_files()), [](const auto& file) { return file.param; });

}  // namespace
}  // namespace atrium::bad_test
