#include "modules/baseline/helper_program.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "graph/api/error.hpp"

namespace atrium::baseline::helper_program_test {
namespace {

/// A helper that is a shell script beside the plugin, for as long as the test runs.
class Script {
 public:
  explicit Script(const std::string& text) : file_(helper_file("test-helper-" + std::to_string(::getpid()))) {
    std::ofstream(file_) << "#!/bin/sh\n" << text << "\n";
    std::filesystem::permissions(file_, std::filesystem::perms::owner_all);
  }
  ~Script() { std::filesystem::remove(file_); }
  HelperProgram helper(double seconds = 60, double mebibytes = 1000) const {
    return {file_.filename().string(), "", seconds, mebibytes};
  }

 private:
  std::filesystem::path file_;
};

std::string problem(const HelperProgram& helper) {
  Context context;
  try {
    run_helper(helper, {}, context);
  } catch (const Error& error) {
    return std::string(error.what()) + " / " + error.help();
  }
  return "none";
}
bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

Exchange example() {
  Exchange exchange;
  exchange.numbers = {1, 2.5};
  exchange.points = {{1, 2, 3}, {4, 5, 6}};
  exchange.triangles = {{0, 1, 2}};
  exchange.indices = {-1, 7};
  return exchange;
}

TEST(Exchange, ComesBackAsItWent) {
  const Exchange back = from_bytes(to_bytes(example()));
  EXPECT_EQ(back.numbers, example().numbers);
  EXPECT_EQ(back.text, "");
  EXPECT_EQ(back.points, example().points);
  EXPECT_EQ(back.triangles, example().triangles);
  EXPECT_EQ(back.indices, example().indices);
}

TEST(Exchange, RefusesWhatIsNotWhole) {
  const std::string bytes = to_bytes(example());
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THROW(from_bytes(bytes.substr(0, size)), std::runtime_error) << size;
  EXPECT_THROW(from_bytes(bytes + "x"), std::runtime_error);
  EXPECT_THROW(from_bytes("something else altogether"), std::runtime_error);
  std::string huge = bytes;
  for (std::size_t i = 8; i < 16; ++i) huge[i] = '\xff';  // the number of numbers
  EXPECT_THROW(from_bytes(huge), std::runtime_error);
}

TEST(HelperProgram, HandsItsInputOverAndTakesItsOutput) {
  const Script script("cat");
  Context context;
  const HelperResult result = run_helper(script.helper(), example(), context);
  EXPECT_EQ(result.reply.points, example().points);
  EXPECT_EQ(result.reply.indices, example().indices);
  EXPECT_GT(result.mebibytes, 0);
}

TEST(HelperProgram, SaysWhyThereIsNoReply) {
  EXPECT_TRUE(contains(problem({"no-such-helper", "get it there", 1, 1000}), "this build has no no-such-helper"));
  EXPECT_TRUE(contains(problem({"no-such-helper", "get it there", 1, 1000}), "get it there"));
  EXPECT_TRUE(contains(problem(Script("echo this; echo went wrong >&2; exit 7").helper()), "ended with 7"));
  EXPECT_TRUE(contains(problem(Script("echo this; echo went wrong >&2; exit 7").helper()), "went wrong"));
  EXPECT_TRUE(contains(problem(Script("kill -SEGV $$").helper()), "Segmentation fault"));
  EXPECT_TRUE(contains(problem(Script("echo nonsense").helper()), "no reply that can be read"));
  EXPECT_TRUE(contains(problem(Script("exec sleep 60").helper(0.05)), "stopped after 0.05 s, its time limit"));
  EXPECT_TRUE(contains(problem(Script("exec sleep 60").helper(60, 0.001)), "memory limit of 0.001 MiB"));
}

}  // namespace
}  // namespace atrium::baseline::helper_program_test
