// The examples that the modules' pages begin with run as they are, and draw the pages' pictures.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/pipelines/steps.hpp"

namespace atrium::test::module_examples_test {
namespace {

std::vector<std::string> modules() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(source / "share/examples/modules"))
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

class ModuleExample : public testing::TestWithParam<std::string> {};

TEST_P(ModuleExample, RunsAndDrawsItsPicture) {
  const std::string& module = GetParam();
  const fs::path example = source / "share/examples/modules" / (module + ".yaml");
  const TemporaryFolder folder;
  const auto run = atrium({"run", example.string(), "--quiet", "--out", (folder / "out").string()});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(read_text(example).find("type: " + module + "."), std::string::npos) << "it shows no node of its module";
  const fs::path picture = source / "share/doc/modules" / (module + ".png");
  ASSERT_EQ(fs::exists(folder / "out" / picture.filename()), fs::exists(picture)) << "run share/pictures " << module;
  if (!fs::exists(picture)) return;
  constexpr std::size_t header = 24;  // of a PNG: with width and height
  EXPECT_EQ(read_text(folder / "out" / picture.filename()).substr(0, header), read_text(picture).substr(0, header));
  EXPECT_LE(fs::file_size(picture), 60000U);
}
INSTANTIATE_TEST_SUITE_P(Modules, ModuleExample, testing::ValuesIn(modules()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace atrium::test::module_examples_test
