// The parts of the report's page that need no browser.
#include <gtest/gtest.h>

#include "tests/support/lacking.hpp"
#include "tests/support/temporary_folder.hpp"

namespace atrium::test::page_test {
namespace {

namespace fs = std::filesystem;

TEST(ReportPage, ReadsQuantitiesAndPutsTicksAtRoundPlaces) {
  if (!has_program("node")) ATRIUM_SKIP_LACKING("node is not installed");
  const auto result = run_process({"node", ATRIUM_SOURCE_DIR "/tests/report/parts.mjs"});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
}

TEST(ReportPage, IsLeftOutOfTheBuildWhereEsbuildIsLacking) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "bin");
  for (const std::string tool : {"bash", "dirname", "rm", "env"})
    fs::create_symlink(run_process({"sh", "-c", "command -v " + tool + " | tr -d '\\n'"}).out,
                       folder / ("bin/" + tool));
  write_text(folder / "report.html", "of an earlier build");
  const auto result = run_process({"env", "PATH=" + (folder / "bin").string(),
                                   ATRIUM_SOURCE_DIR "/graph/report/web/build", (folder / "report.html").string()});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("report.html is not built: esbuild and libjs-three are lacking"), std::string::npos)
      << result.out;
  EXPECT_FALSE(fs::exists(folder / "report.html"));
}

}  // namespace
}  // namespace atrium::test::page_test
