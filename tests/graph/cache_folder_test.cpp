// The folder of a cache: what is its own in it, what is removed, what is left.
#include "graph/cache/cache_folder.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <unistd.h>

#include <set>

#include "graph/cache/blob.hpp"
#include "graph/cache/cache.hpp"
#include "graph/cache/upkeep.hpp"
#include "tests/support/temporary_folder.hpp"

namespace atrium::cache_folder_test {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;
using test::write_text;

CacheRecord some_record() {
  CacheRecord record;
  record.fields = {{"type", "test.find"}, {"version", "1"}};
  record.key = NodeKey{record.fields}.hex();
  return record;
}

/// A name as the cache gives them.
std::string hash_name(int i) { return "aa" + std::string(29, '0') + std::to_string(i); }

TEST(CacheFolder, IsMarkedAndNoOtherIsTaken) {
  const TemporaryFolder folder;
  write_text(folder / ".x.1-1.part", "left by a process that was killed");
  const Cache cache({folder.path()});
  EXPECT_TRUE(test::read_text(folder / "CACHEDIR.TAG").starts_with("Signature: 8a477f597d28d172789f06886806bc55\n"));
  EXPECT_NO_THROW(Cache({folder.path()}));
  const TemporaryFolder foreign;
  const CachePlaces places{foreign.path()};
  EXPECT_THROW(collect_garbage(places, 0), NoCacheFolder);
  // Other programs' caches have a mark of the same name.
  write_text(foreign / "CACHEDIR.TAG", "Signature: 8a477f597d28d172789f06886806bc55\n# of another program\n");
  fs::create_directories(foreign / "values/aa");
  write_text(foreign / "values/aa" / hash_name(1), "theirs");
  std::uint64_t checked = 0;
  EXPECT_THROW(Cache({foreign.path()}), NoCacheFolder);
  EXPECT_THROW(collect_garbage(places, 0), NoCacheFolder);
  EXPECT_THROW(verify_cache(places, checked), NoCacheFolder);
  EXPECT_EQ(test::read_text(foreign / "values/aa" / hash_name(1)), "theirs");
}

TEST(CacheFolder, IsMadeAgainWhenItWasDeletedMeanwhile) {
  const TemporaryFolder folder;
  Cache cache({folder / "cache"});
  cache.keep(some_record());
  fs::remove_all(folder / "cache");
  cache.keep(some_record());
  cache.finish();
  EXPECT_TRUE(cache.use().problems.empty());
  EXPECT_TRUE(is_cache_folder(cache.places()));
  EXPECT_TRUE(cache.find("test.find", some_record().key));
}

TEST(CacheUpkeep, TouchesNothingThatIsNotTheCaches) {
  const TemporaryFolder folder;
  const CachePlaces places{folder.path()};
  make_cache_folder(places);
  const std::string layout = "-0123456789abcdef";
  const std::vector<std::string> foreign{"thesis.tex",
                                         "photos/aa/" + hash_name(1),
                                         "files/notes.txt",
                                         "files/" + hash_name(1),
                                         "files/aa/notes.txt",
                                         "files/aa/.notes.txt.999999999-1.part",
                                         "files/bb/" + hash_name(1),
                                         "files/aa/deep/" + hash_name(1),
                                         "values/aa/" + hash_name(1),
                                         "records/notes/" + hash_name(1),
                                         "records/a.b/notes.txt",
                                         "hashes/notes.txt",
                                         "hashes/aa/" + hash_name(1)};
  const std::vector<std::string> own{"files/aa/" + hash_name(2), "files/aa/." + hash_name(3) + ".999999999-1.part",
                                     "values/aa/" + hash_name(2) + layout, "records/a.b/" + hash_name(2),
                                     "hashes/" + hash_name(2)};
  const auto make_all = [&] {
    for (const auto* names : {&foreign, &own})
      for (const auto& name : *names) {
        fs::create_directories((folder / name).parent_path());
        write_text(folder / name, name);
        fs::last_write_time(folder / name, fs::file_time_type::clock::now() - std::chrono::hours(1));
      }
  };
  const auto expect_foreign = [&] {
    for (const auto& name : foreign) EXPECT_TRUE(fs::exists(folder / name)) << name;
  };
  make_all();
  ASSERT_EQ(collect_garbage(places, 0)->files, own.size());
  expect_foreign();
  make_all();
  std::uint64_t checked = 0;
  EXPECT_EQ(verify_cache(places, checked).size(),
            own.size() - 1);  // all are damaged; unfinished ones are not looked at
  EXPECT_EQ(checked, own.size() - 1);
  expect_foreign();
  EXPECT_EQ(contents_of(places).all().files, 1U);
}

TEST(CacheUpkeep, SaysThatAnotherProcessIsAtIt) {
  const TemporaryFolder folder;
  const CachePlaces places{folder.path()};
  make_cache_folder(places);
  const int other = ::open((folder / ".atrium-lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  ASSERT_EQ(::flock(other, LOCK_EX | LOCK_NB), 0);
  EXPECT_FALSE(collect_garbage(places, 0));
  ::close(other);
  EXPECT_TRUE(collect_garbage(places, 0));
}

/// While one is there, the process can open so many files and no more.
class FewFiles {
 public:
  explicit FewFiles(rlim_t more) {
    ::getrlimit(RLIMIT_NOFILE, &before_);
    const int next = ::dup(0);
    ::close(next);
    const rlimit few{static_cast<rlim_t>(next) + more, before_.rlim_max};
    ::setrlimit(RLIMIT_NOFILE, &few);
  }
  ~FewFiles() { ::setrlimit(RLIMIT_NOFILE, &before_); }
  FewFiles(const FewFiles&) = delete;
  FewFiles& operator=(const FewFiles&) = delete;

 private:
  rlimit before_{};
};

TEST(CacheValues, ThatCannotBeReadNowAreNotRemoved) {
  const TemporaryFolder folder;
  const FlatType& type = *flat_type<std::string>();
  const std::string hash = content_hash(std::string("value"));
  {
    Cache cache({folder.path(), 1'000'000'000, true});
    ASSERT_TRUE(cache.keep_value(type, std::make_shared<const std::string>("value"), hash, 5, 1));
    cache.keep(some_record());
  }
  Cache cache({folder.path(), 1'000'000'000, true});
  {
    const FewFiles none(0);
    EXPECT_EQ(cache.load(type, hash), nullptr);
    EXPECT_FALSE(cache.find("test.find", some_record().key));
  }
  EXPECT_EQ(cache.use().problems.size(), 2U);
  EXPECT_NE(cache.load(type, hash), nullptr);
  EXPECT_TRUE(cache.find("test.find", some_record().key));
  std::uint64_t checked = 0;
  {
    const FewFiles folders_only(2);
    const auto problems = verify_cache(cache.places(), checked);
    EXPECT_EQ(problems.size(), 2U);
    for (const auto& problem : problems) EXPECT_FALSE(problem.removed) << problem.what;
  }
  EXPECT_TRUE(verify_cache(cache.places(), checked).empty());
  const FewFiles none(0);
  EXPECT_THROW(verify_cache(cache.places(), checked), Error);
}

// A value that is there already when its turn comes is not written: that says nothing about the disk.
TEST(CacheValues, ThatAreThereAlreadyDoNotCountAsWritten) {
  const TemporaryFolder folder;
  Cache cache({folder.path()});
  const FlatType& type = *flat_type<std::string>();
  const auto keep = [&](char letter, std::size_t size, double cost) {
    const auto value = std::make_shared<const std::string>(size, letter);
    return cache.keep_value(type, value, content_hash(*value), size, cost);
  };
  ASSERT_TRUE(keep('a', 50'000'000, 1000));  // the others wait for it
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(keep('b', 2'000'000, 1000));
  cache.finish();
  // 900 MB in 50 ms: no disk does that.
  EXPECT_FALSE(cache.keep_value(type, std::make_shared<const std::string>("c"), content_hash(std::string("c")),
                                900'000'000, 0.05));
}

TEST(CacheUpkeep, RemovesWhatWasNotUsedForLongest) {
  const TemporaryFolder folder;
  const CachePlaces places{folder.path()};
  make_cache_folder(places);
  fs::create_directories(folder / "files/aa");
  for (int i = 0; i < 10; ++i) {
    const fs::path file = folder / "files/aa" / hash_name(i);
    write_text(file, std::string(4096, 'x'));
    fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::minutes(100 - i));
  }
  touch(folder / "files/aa" / hash_name(0));
  const std::string running = "." + hash_name(9) + ".1-1.part";
  const fs::path gone = folder / "files/aa" / ("." + hash_name(9) + ".999999999-1.part");
  write_text(folder / "files/aa" / running, "of a process that runs");
  write_text(gone, "of one that is gone");
  fs::last_write_time(gone, fs::file_time_type::clock::now() - std::chrono::hours(1));
  const auto removed = collect_garbage(places, 4 * 4096 + 4096);
  ASSERT_TRUE(removed);
  EXPECT_LE(removed->left, 5U * 4096);
  std::set<std::string> left;
  for (const auto& entry : fs::directory_iterator(folder / "files/aa")) left.insert(entry.path().filename());
  EXPECT_EQ(left, (std::set<std::string>{running, hash_name(0), hash_name(7), hash_name(8), hash_name(9)}));
}

}  // namespace
}  // namespace atrium::cache_folder_test
