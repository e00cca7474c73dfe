// The cache's folder as users meet it: what is taken for one, what is removed, what happens when it is full.
#include <fcntl.h>
#include <sys/file.h>
#include <sys/mount.h>
#include <unistd.h>

#include "tests/pipelines/cache_of_runs.hpp"

namespace atrium::test::cache_folder_test {
namespace {

class CacheFolderOfRuns : public CacheOfRuns {};

TEST_F(CacheFolderOfRuns, IsKeptBelowItsSize) {
  atrium({"run", "p.yaml", "--out", "r", "--cache-size", "1 MB"});
  const auto stat = json::parse(atrium({"cache", "stat", "--json"}).out);
  EXPECT_LE(stat["all"]["bytes"], 1'000'000);
  atrium({"run", "p.yaml", "--out", "r", "-s", "number=7"});
  EXPECT_GT(json::parse(atrium({"cache", "stat", "--json"}).out)["all"]["bytes"], 1'000'000);
  const auto gc = json::parse(atrium({"cache", "gc", "--cache-size", "500 kB", "--json"}).out);
  EXPECT_LE(gc["bytes"], 500'000);
  EXPECT_GT(gc["removed_files"], 0);
  ASSERT_EQ(atrium({"run", "p.yaml", "--out", "again", "-s", "number=7"}).exit_code, 0);
  EXPECT_EQ(shown("again"), shown("r"));
  for (const std::vector<std::string>& wrong :
       {std::vector<std::string>{"cache", "gc", "--cache-size", "many"},
        {"run", "p.yaml", "--out", "r", "--cache-size", "20 gb"},
        {"sweep", "run", "s.yaml", "--out", "s", "--isolate", "--mem", "much"}}) {
    const auto result = atrium(wrong);
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_NE(result.err.find("is no size"), std::string::npos) << result.err;
  }
}

TEST_F(CacheFolderOfRuns, AFolderOfSomethingElseIsRefusedAndKept) {
  fs::create_directories(folder / "mine/files");
  write_text(folder / "mine/files/thesis.tex", "years of work");
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"run", "p.yaml", "--out", "r", "--cache", "mine"},
        {"cache", "gc", "--cache", "mine", "--cache-size", "0"},
        {"cache", "verify", "--cache", "mine"},
        {"cache", "stat", "--cache", "mine"}}) {
    const auto result = atrium(arguments);
    EXPECT_EQ(result.exit_code, arguments[0] == "run" ? 2 : 1) << result.err;
    EXPECT_NE(result.err.find("not"), std::string::npos) << result.err;
    EXPECT_EQ(read_text(folder / "mine/files/thesis.tex"), "years of work");
  }
  EXPECT_FALSE(fs::exists(folder / "r"));
  // One that was not asked for is none to stop at.
  fs::rename(folder / "mine", folder / "cache");
  const auto result = atrium({"run", "p.yaml", "--out", "r"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("warning: without a cache: "), std::string::npos) << result.err;
}

TEST_F(CacheFolderOfRuns, IsLookedAfterWhereThereIsOneOnly) {
  for (const char* verb : {"gc", "verify", "stat"}) {
    const auto result = atrium({"cache", verb});
    EXPECT_EQ(result.exit_code, 1) << verb;
    EXPECT_NE(result.err.find("there is no cache in "), std::string::npos) << result.err;
  }
  EXPECT_FALSE(fs::exists(folder / "cache"));
  ASSERT_EQ(atrium({"run", "p.yaml", "--out", "r"}).exit_code, 0);
  EXPECT_NE(atrium({"cache", "stat"}).out.find("\nhashes "), std::string::npos);
  const int other = ::open((folder / "cache/.atrium-lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  ASSERT_EQ(::flock(other, LOCK_EX | LOCK_NB), 0);
  const auto busy = atrium({"cache", "gc", "--cache-size", "0"});
  ::close(other);
  EXPECT_EQ(busy.exit_code, 1);
  EXPECT_NE(busy.err.find("another process is removing files"), std::string::npos) << busy.err;
  EXPECT_EQ(busy.out, "");
}

TEST_F(CacheFolderOfRuns, VerifySaysWhatItCouldNotRemove) {
  fs::create_directories(folder / "disk");
  const std::string path = (folder / "disk").string();
  if (::mount("none", path.c_str(), "tmpfs", 0, "size=50m") != 0)
    GTEST_SKIP() << "a file system can be mounted by root only";
  const auto run = atrium({"run", "p.yaml", "--out", "r", "--cache", "disk/cache"});
  const fs::path type = fs::directory_iterator(folder / "disk/cache/records")->path();
  write_text(fs::directory_iterator(type)->path(), "damaged");
  ::mount("none", path.c_str(), nullptr, MS_REMOUNT | MS_RDONLY, nullptr);
  const auto left = atrium({"cache", "verify", "--cache", "disk/cache"});
  ::mount("none", path.c_str(), nullptr, MS_REMOUNT, nullptr);
  const auto removed = atrium({"cache", "verify", "--cache", "disk/cache"});
  ::umount(path.c_str());
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(left.exit_code, 1);
  EXPECT_NE(left.out.find("left: "), std::string::npos) << left.out;
  EXPECT_NE(left.out.find(" 0 removed, 1 could not be checked or removed\n"), std::string::npos) << left.out;
  EXPECT_EQ(removed.exit_code, 1);
  EXPECT_NE(removed.out.find(" 1 removed\n"), std::string::npos) << removed.out;
}

TEST_F(CacheFolderOfRuns, AFullDiskCostsTheCacheNotTheRun) {
  fs::create_directories(folder / "small");
  if (::mount("none", (folder / "small").c_str(), "tmpfs", 0, "size=100k") != 0)
    GTEST_SKIP() << "a small file system can be mounted by root only";
  const auto result = atrium({"run", "p.yaml", "--out", "r", "--cache", "small"});
  const auto again = atrium({"run", "p.yaml", "--out", "r", "--cache", "small"});
  const std::string uncached = (atrium({"run", "p.yaml", "--out", "off", "--no-cache"}), shown("off"));
  const std::string cached = shown("r");
  ::umount((folder / "small").c_str());
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(again.exit_code, 0);
  const std::size_t first = result.err.find("nothing more is kept in this run");
  EXPECT_NE(first, std::string::npos) << result.err;
  EXPECT_EQ(result.err.find("nothing more is kept in this run", first + 1), std::string::npos) << result.err;
  EXPECT_EQ(cached, uncached);
}

}  // namespace
}  // namespace atrium::test::cache_folder_test
