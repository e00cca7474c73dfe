// The parts of the cache: keys, records, hashes of files, its size.
#include "graph/cache/cache.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <limits>
#include <thread>

#include "graph/api/plugin_data.hpp"
#include "graph/cache/blob.hpp"
#include "graph/cache/costs.hpp"
#include "graph/cache/upkeep.hpp"
#include "graph/why/nearest.hpp"
#include "tests/graph/test_nodes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace atrium::cache_test {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;
using test::write_text;

class Keys : public testing::Test {
 protected:
  Keys() { test::add_test_nodes(registry); }
  /// The keys of all nodes, as if each output had the hash "h".
  std::map<std::string, std::string> keys(const std::string& yaml, const std::vector<Override>& set = {}) {
    write_text(folder / "p.yaml", yaml);
    const LoadResult loaded = load_pipeline(folder / "p.yaml", set, registry);
    EXPECT_TRUE(loaded.errors.empty()) << (loaded.errors.empty() ? "" : to_string(loaded.errors.front()));
    std::map<std::string, std::string> result;
    for (const std::size_t n : all_nodes(loaded.pipeline)) {
      const PipelineNode& node = loaded.pipeline[n];
      std::vector<std::vector<std::string>> inputs;
      for (const auto& port : inputs_of(n, loaded.pipeline)) inputs.emplace_back(port.size(), "h");
      result[node.path] = make_key(node, inputs, "build", files).hex();
    }
    return result;
  }

  TemporaryFolder folder;
  Registry registry{std::vector<fs::path>{}};
  FileHashes files;
};

RC_GTEST_FIXTURE_PROP(Keys, DoNotDependOnTheOrderOfAFilesEntries, ()) {
  std::vector<std::string> nodes{
      "  cloud: {type: test.make}\n",
      "  planes: {in: {cloud: cloud.cloud}, type: test.find, params: {PARAMS}}\n",
      "  write: {type: test.write, in: {planes: planes.planes}}\n",
  };
  std::vector<std::string> params{"distance: 2 cm", "angle: 5", "max_planes: 3", "method: hough", "box: [1, 2, 3]"};
  const auto text = [](const std::vector<std::string>& lines, const std::vector<std::string>& settings) {
    std::string list;
    for (const auto& setting : settings) list += (list.empty() ? "" : ", ") + setting;
    std::string yaml = "atrium: 1\nnodes:\n";
    for (const auto& line : lines) yaml += line;
    return yaml.replace(yaml.find("PARAMS"), 6, list);
  };
  const auto before = keys(text(nodes, params));
  const auto seed = static_cast<unsigned>(*rc::gen::inRange(0, 1'000'000));
  std::shuffle(nodes.begin(), nodes.end(), std::mt19937(seed));
  std::shuffle(params.begin(), params.end(), std::mt19937(seed + 1));
  RC_ASSERT(keys(text(nodes, params)) == before);
}

TEST_F(Keys, DependOnValuesAndNotOnHowTheyAreWritten) {
  const auto with = [&](const std::string& params) {
    return keys(
               "atrium: 1\nnodes:\n  cloud: {type: test.make}\n  planes: {type: test.find, in: {cloud: cloud.cloud}, "
               "params: {" +
               params + "}}\noutputs: {p: planes.planes}\n")
        .at("planes");
  };
  const std::string standard = with("");
  EXPECT_EQ(with("distance: 0.5 m, angle: 20"), standard);
  EXPECT_EQ(with("distance: 50 cm"), standard);
  std::set<std::string> different{standard};
  for (const char* params : {"distance: 0.5000001", "angle: 19", "max_planes: 71", "share: 0.2", "method: hough",
                             "refit: false", "box: [1, 2, 4]"})
    EXPECT_TRUE(different.insert(with(params)).second) << params;
}

TEST_F(Keys, DependOnTheContentsOfFilesAndOfFolders) {
  const auto with = [&](const std::string& path) {
    return keys("atrium: 1\nnodes: {cloud: {type: test.read, params: {path: " + path +
                "}}}\noutputs: {c: cloud.cloud}\n")
        .at("cloud");
  };
  fs::create_directories(folder / "a/in");
  fs::create_directories(folder / "b/in");
  write_text(folder / "a/in/scan.ply", "1");
  write_text(folder / "b/in/scan.ply", "1");
  EXPECT_EQ(with("a/in/scan.ply"), with("b/in/scan.ply"));
  EXPECT_EQ(with("a/in"), with("b/in"));
  const std::string before = with("a/in");
  write_text(folder / "b/in/scan.ply", "2");
  EXPECT_NE(with("a/in/scan.ply"), with("b/in/scan.ply"));
  EXPECT_NE(with("a/in"), with("b/in"));
  write_text(folder / "a/in/more.ply", "");
  EXPECT_NE(with("a/in"), before);
  // A .gltf names files that hold its numbers.
  write_text(folder / "a/m.gltf", R"({"buffers": [{"uri" : "the%20part.bin"}, {"uri":"data:,x"}, {"uri":"lost"}]})");
  write_text(folder / "a/the part.bin", "1");
  const std::string of_one = with("a/m.gltf");
  write_text(folder / "a/the part.bin", "2");
  EXPECT_NE(with("a/m.gltf"), of_one);
  write_text(folder / "a/the part.bin", "1");
  EXPECT_EQ(with("a/m.gltf"), of_one);
}

TEST(NodeKeys, TellWhereOneFieldEnds) {
  EXPECT_NE((NodeKey{{{"a", "1\nb=1:2"}}}).hex(), (NodeKey{{{"a", "1"}, {"b", "2"}}}).hex());
  EXPECT_NE((NodeKey{{{"a", "12"}}}).hex(), (NodeKey{{{"a1", "2"}}}).hex());
}

TEST(Builds, AreThoseOfThePluginAndOfWhatStandsBesideIt) {
  const TemporaryFolder folder;
  write_text(folder / "libatrium_trial.so", "one");
  write_text(folder / "libatrium_other.so", "one");
  NodeType type = describe_node<test::Make>();
  type.library = folder / "libatrium_trial.so";
  FileHashes files;
  const auto build = [&] { return BuildIds(files).of(type); };
  const std::string before = build();
  BuildIds builds(files);
  EXPECT_EQ(builds.of(type), before);
  write_text(folder / "libatrium_other.so", "another plugin");
  EXPECT_EQ(build(), before);
  EXPECT_TRUE(builds.unchanged(type));
  write_text(folder / "libatrium_trial-run.so", "its second library");
  const std::string with_second = build();
  EXPECT_NE(with_second, before);
  write_text(folder / "libatrium_trial.so", "two");
  EXPECT_NE(build(), with_second);
  EXPECT_EQ(builds.of(type), before);  // what is loaded
  EXPECT_FALSE(builds.unchanged(type));
  type.library.clear();
  EXPECT_NE(build(), before);
}

TEST(Builds, AreAlsoThoseOfTheFilesThatAPluginReads) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "lib/atrium");
  fs::create_directories(folder / "share/colours");
  fs::create_directories(folder / "share/others");
  NodeType type = describe_node<test::Make>();
  type.library = folder / "lib/atrium/libatrium_trial.so";
  write_text(type.library, "code");
  write_text(folder / "lib/atrium/libatrium_trial.data", "colours\nnowhere\n");
  write_text(folder / "share/colours/red.txt", "255 0 0");
  write_text(folder / "share/others/red.txt", "255 0 0");
  const auto nodes = [&] {
    FileHashes files;
    return BuildIds(files).of(type);
  };
  const auto all = [&] { return build_of_all(Registry({folder / "lib/atrium"})); };
  const std::pair<std::string, std::string> before{nodes(), all()};
  FileHashes files;
  BuildIds builds(files);
  builds.of(type);
  write_text(folder / "share/others/red.txt", "254 0 0");
  EXPECT_EQ(nodes(), before.first);
  EXPECT_EQ(all(), before.second);
  EXPECT_TRUE(builds.unchanged(type));
  write_text(folder / "share/colours/red.txt", "254 0 0");
  EXPECT_NE(nodes(), before.first);
  EXPECT_NE(all(), before.second);
  EXPECT_FALSE(builds.unchanged(type));
  // As installed, and of the pictures' plugin.
  fs::create_directories(folder / "share/atrium");
  fs::rename(folder / "share/colours", folder / "share/atrium/colours");
  EXPECT_EQ(plugin_data_files(type.library), std::vector<fs::path>{folder / "share/atrium/colours/red.txt"});
  const fs::path built = fs::path(ATRIUM_PROGRAM).parent_path().parent_path() / "lib/atrium/libatrium_render.so";
  std::set<std::string> names;
  for (const auto& file : plugin_data_files(built)) names.insert(file.filename());
  EXPECT_TRUE(names.contains("viridis.txt"));
}

CacheRecord some_record() {
  CacheRecord record;
  record.fields = {{"type", "test.find"}, {"version", "1"}, {"distance", "0.5 m"}};
  record.key = NodeKey{record.fields}.hex();
  record.node = "shell/planes";
  record.made = "2024-02-03T04:05:06Z";
  const double infinity = std::numeric_limits<double>::infinity();
  record.outputs = {{"planes", "Planes", 12, std::string(32, 'a'), {}},
                    {"report",
                     "Metrics",
                     7,
                     std::string(32, 'b'),
                     {{"a", 0.1, "m"},
                      {"b", std::nan(""), ""},
                      {"c", -infinity, "s"},
                      {"d", std::int64_t{3}, ""},
                      {"e", 3.0, ""},
                      {"f", std::string("inf"), ""},
                      {"g", true, ""}}}};
  record.warnings = {"one", "two \"quoted\"\n"};
  record.files = {{"a/b.ply", 5, std::string(32, 'c')}};
  record.wall = 1.25;
  record.growth = 12345;
  return record;
}

TEST(CacheRecords, ComeBackAsTheyWere) {
  const CacheRecord record = some_record();
  const std::string text = record_text(record);
  const auto back = read_record(text);
  ASSERT_TRUE(back);
  EXPECT_EQ(record_text(*back), text);
  const auto& facts = back->outputs.at(1).facts;
  EXPECT_EQ(std::get<double>(facts.at(0).value), 0.1);
  EXPECT_TRUE(std::isnan(std::get<double>(facts.at(1).value)));
  EXPECT_EQ(std::get<double>(facts.at(2).value), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(std::get<std::int64_t>(facts.at(3).value), 3);
  EXPECT_EQ(std::get<double>(facts.at(4).value), 3.0);
  EXPECT_EQ(std::get<std::string>(facts.at(5).value), "inf");
  EXPECT_EQ(std::get<bool>(facts.at(6).value), true);
}

RC_GTEST_PROP(CacheRecords, AreNotBelievedWhenDamaged, ()) {
  std::string text = record_text(some_record());
  if (*rc::gen::arbitrary<bool>())
    text[*rc::gen::inRange<std::size_t>(0, text.size())] ^= static_cast<char>(1U << *rc::gen::inRange(0U, 8U));
  else
    text.resize(*rc::gen::inRange<std::size_t>(0, text.size()));
  RC_ASSERT(!read_record(text));
}

TEST(FileHashing, SeesAChangeThatKeepsSizeAndTime) {
  const TemporaryFolder folder;
  FileHashes hashes(folder.path());
  const fs::path file = folder / "scan.ply";
  write_text(file, "one");
  // Made to look old: a young file is not remembered at all.
  const auto long_ago = fs::file_time_type::clock::now() - std::chrono::hours(24);
  fs::last_write_time(file, long_ago);
  const std::string before = hashes.of(file);
  EXPECT_EQ(before, hash_of_file(file));
  write_text(file, "two");
  fs::last_write_time(file, long_ago);
  EXPECT_NE(hashes.of(file), before);
  EXPECT_NE(FileHashes(folder.path()).of(file), before);
  EXPECT_THROW(hashes.of(folder / "nowhere"), Error);
}

TEST(CacheSizes, AreReadAndShown) {
  EXPECT_EQ(read_size("20 GB"), 20'000'000'000U);
  EXPECT_EQ(read_size("512MiB"), 512U << 20U);
  EXPECT_EQ(read_size("1.5 kB"), 1500U);
  EXPECT_EQ(read_size("7"), 7U);
  for (const char* wrong : {"", "GB", "-1 GB", "20 gb", "1e30 GB", "nan", "2 GB more"})
    EXPECT_THROW(read_size(wrong), Error) << wrong;
  EXPECT_EQ(size_text(999), "999 B");
  EXPECT_EQ(size_text(20'000'000'000U), "20 GB");
  EXPECT_EQ(size_text(999'999), "1 MB");
}

TEST(FileHashing, DoesNotBelieveADamagedLine) {
  const TemporaryFolder folder;
  const TemporaryFolder remembered;
  const fs::path file = folder / "scan.ply";
  write_text(file, "one");
  fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(24));
  // The system's time of change of the status cannot be set back: wait until the file is old enough to be remembered.
  while (fs::is_empty(remembered.path())) {
    FileHashes(remembered.path()).of(file);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  const fs::path line = fs::directory_iterator(remembered.path())->path();
  const std::string good = test::read_text(line);
  ASSERT_TRUE(FileHashes::is_whole(good, line.filename()));
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string bad = good;
    bad[i] = bad[i] == '0' ? '1' : '0';
    EXPECT_FALSE(FileHashes::is_whole(bad, line.filename())) << bad;
    write_text(line, bad);
    ASSERT_EQ(FileHashes(remembered.path()).of(file), hash_of_file(file)) << bad;
  }
}

TEST(FileHashing, TakesNothingFromAPipe) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_THROW(FileHashes().of(folder / "pipe"), Error);  // and does not wait for a writer
}

TEST(FileHashing, OfAFolderThatCannotBeReadIsAnError) {
  const TemporaryFolder folder;
  fs::create_symlink("nowhere", folder / "to nothing");
  EXPECT_NO_THROW(FileHashes::fingerprint(folder.path()));
  fs::create_symlink("circle", folder / "circle");
  EXPECT_THROW(FileHashes::fingerprint(folder.path()), Error);
  EXPECT_THROW(FileHashes().of(folder.path()), Error);
}

TEST(CacheCosts, AreOfTheLastRecordsAndOfNodesThatRanAlone) {
  const TemporaryFolder folder;
  Cache cache({folder.path()});
  CacheRecord record = some_record();
  const auto keep = [&](int number, std::optional<std::uint64_t> growth) {
    record.fields[2].value = std::to_string(number);
    record.key = NodeKey{record.fields}.hex();
    record.made = "2024-01-01T00:00:" + std::to_string(10 + number) + "Z";
    record.growth = growth;
    cache.keep(record);
  };
  const auto memory = [&] { return Costs(cache.places()).of("test.find", "shell/planes")->memory; };
  keep(0, std::nullopt);
  EXPECT_EQ(memory(), std::nullopt);
  keep(1, 1'000'000'000'000);  // once, long ago
  EXPECT_EQ(memory(), 1'000'000'000'000);
  for (int i = 2; i < 22; ++i) keep(i, 1000 + i);
  keep(30, 5'000'000);
  EXPECT_EQ(memory(), 1021);  // the largest but one of the last 20
  EXPECT_EQ(Costs(cache.places()).of("test.other", "shell/planes").has_value(), false);
}

TEST(CacheNearest, IsTheRecordWithTheFewestDifferences) {
  const TemporaryFolder folder;
  Cache cache({folder.path()});
  CacheRecord record = some_record();
  const auto keep = [&](std::string version, std::string distance, std::string made) {
    record.fields[1].value = std::move(version);
    record.fields[2].value = std::move(distance);
    record.made = std::move(made);
    record.key = NodeKey{record.fields}.hex();
    cache.keep(record);
  };
  keep("1", "1 m", "2024-01-01T00:00:00Z");
  keep("2", "2 m", "2024-01-02T00:00:00Z");
  keep("1", "3 m", "2024-01-03T00:00:00Z");
  keep("1", "5 m", "2025-01-03T00:00:00Z");
  keep("1", "4 m", "2024-01-04T00:00:00Z");
  const auto nearest = nearest_record(cache.places(), record);
  ASSERT_TRUE(nearest);
  EXPECT_EQ(nearest->record.made, "2024-01-03T00:00:00Z");
  ASSERT_EQ(nearest->differences.size(), 1U);
  EXPECT_EQ(nearest->differences[0].then, "3 m");
  EXPECT_EQ(nearest->differences[0].now, "4 m");
}

}  // namespace
}  // namespace atrium::cache_test
