// The examples that the modules' pages begin with run as they are, and draw the pages' pictures: coarsely the same.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/pipelines/steps.hpp"
#include "tests/support/svg_drawing.hpp"

namespace atrium::test::module_examples_test {
namespace {

std::vector<std::string> modules() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(source / "share/examples/modules"))
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

constexpr std::size_t cells = 12;  // both ways

/// The mean colours of a picture's cells, row by row: red, green, blue.
std::vector<double> coarse(const SvgDrawing& picture) {
  std::vector<double> sums(3 * cells * cells, 0.0), counts(cells * cells, 0.0);
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    const std::size_t x = i % picture.width, y = i / picture.width;
    const std::size_t cell = y * cells / picture.height * cells + x * cells / picture.width;
    ++counts[cell];
    for (std::size_t k = 0; k < 3; ++k) sums[3 * cell + k] += picture.pixels[i][k];
  }
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] /= std::max(1.0, counts[i / 3]);
  return sums;
}

/// Of the same size, and of nearly the same colour in each cell: fonts and edges may differ between machines.
void expect_alike(const SvgDrawing& drawn, const SvgDrawing& committed) {
  constexpr double most = 12;  // of 255
  ASSERT_EQ(drawn.width, committed.width);
  ASSERT_EQ(drawn.height, committed.height);
  const auto ours = coarse(drawn), theirs = coarse(committed);
  for (std::size_t i = 0; i < ours.size(); ++i)
    ASSERT_NEAR(ours[i], theirs[i], most)
        << "row " << i / 3 / cells << ", column " << i / 3 % cells << ": run share/pictures and look at it";
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
  expect_alike(read_drawing(folder / "out" / picture.filename()), read_drawing(picture));
  EXPECT_LE(fs::file_size(picture), 60000U);
}
INSTANTIATE_TEST_SUITE_P(Modules, ModuleExample, testing::ValuesIn(modules()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace atrium::test::module_examples_test
