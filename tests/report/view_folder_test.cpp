// `atrium view` of what is no folder of one run.
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace atrium::test::view_folder_test {
namespace {

namespace fs = std::filesystem;

class ViewFolder : public testing::Test {
 protected:
  TemporaryFolder folder;
  ProcessResult view(const std::string& name) {
    ProcessOptions options;
    options.folder = folder.path();
    return run_process({ATRIUM_PROGRAM, "view", name}, options);
  }
};

TEST_F(ViewFolder, OfASweepSaysThatOneVariantIsMeant) {
  for (const char* id : {"5e1f", "0a2b"}) {
    fs::create_directories(folder / "sweep/variants" / id);
    write_text(folder / "sweep/variants" / id / "result.json", "{}");
  }
  fs::create_directories(folder / "sweep/variants/begun");
  write_text(folder / "sweep/sweep.json", "{}");
  // The run of all variants together leaves its own manifest there.
  write_text(folder / "sweep/manifest.json", R"({"status": "ok"})");
  const auto result = view("sweep");
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_NE(result.err.find("sweep is the folder of a sweep, not of one run"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("give one of its variants, as sweep/variants/0a2b (of 2); `atrium report sweep` compares "
                            "all of them"),
            std::string::npos)
      << result.err;
  EXPECT_FALSE(fs::exists(folder / "sweep/view.html"));
}

TEST_F(ViewFolder, OfASweepThatHasNotBegunSaysSo) {
  fs::create_directories(folder / "sweep/variants");
  write_text(folder / "sweep/sweep.json", "{}");
  const auto result = view("sweep");
  EXPECT_NE(result.err.find("none of its variants is done: `atrium sweep run` goes on with it"), std::string::npos)
      << result.err;
}

}  // namespace
}  // namespace atrium::test::view_folder_test
