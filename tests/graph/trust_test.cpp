// What others may have written is not trusted: lists of files in records and manifests, files that are made to cost
// time, links, locks, and streams that are closed.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <limits>
#include <set>
#include <thread>

#include "graph/api/files.hpp"
#include "graph/api/folder_lock.hpp"
#include "graph/cache/cache.hpp"
#include "graph/pipeline/findings.hpp"
#include "graph/run/runner.hpp"
#include "graph/sweep/plan.hpp"
#include "tests/graph/run_nodes.hpp"
#include "tests/graph/test_nodes.hpp"
#include "tests/support/pipeline_builder.hpp"
#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace atrium::trust_test {
namespace {

namespace fs = std::filesystem;
using test::Call;
using test::Counted;
using test::PipelineBuilder;
using test::ProcessOptions;
using test::read_text;
using test::TemporaryFolder;
using test::write_text;

TEST(PlaceInside, TakesWhatIsInTheFolderAndNothingElse) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "run/sub");
  write_text(folder / "private.txt", "");
  write_text(folder / "run/own.txt", "");
  fs::create_symlink(folder.path(), folder / "run/out");
  fs::create_symlink(folder / "private.txt", folder / "run/link.txt");
  fs::create_symlink(folder / "run/own.txt", folder / "run/inner.txt");
  const fs::path run = folder / "run";
  for (const char* good : {"own.txt", "sub/new/file.ply", "./own.txt", "sub/../own.txt", "inner.txt", "..x"})
    EXPECT_EQ(place_inside(run, good), run / fs::path(good).lexically_normal()) << good;
  for (const char* bad : {"", ".", "..", "../private.txt", "sub/../../private.txt", "/etc/passwd", "out/private.txt",
                          "link.txt", "sub/..", "out"})
    EXPECT_FALSE(place_inside(run, bad)) << bad;
  EXPECT_FALSE(place_inside(run, (folder / "run/own.txt").string()));
  EXPECT_FALSE(place_inside(run, std::string("own\0.txt", 8)));
}

/// A node that writes a file.
void add_writer(PipelineBuilder& builder, const std::string& name) {
  add_call(builder, "write", [name](Context& context) {
    const fs::path file = context.output(name);
    AtomicFile out(file);
    out.write("written");
    out.commit();
    context.wrote(file);
    return input(Counted(1));
  });
}

RunResult run(const Pipeline& pipeline, const fs::path& out, const fs::path& cache_folder) {
  Cache cache({cache_folder});
  RunOptions options;
  options.out = out;
  options.threads = 1;
  options.cache = &cache;
  ProgressSink silent;
  return run_pipeline(pipeline, options, silent);
}

TEST(Trust, AForgedRecordOfTheCacheWritesNothingOutsideOfTheRun) {
  for (const std::string target : {"../escaped.txt", "sub/../../escaped.txt", "absolute"}) {
    const TemporaryFolder folder;
    PipelineBuilder b;
    add_writer(b, "good.txt");
    run(b.pipeline(), folder / "first", folder / "cache");
    fs::path file;
    for (const auto& entry : fs::directory_iterator(folder / "cache/records/test.call")) file = entry.path();
    auto record = read_record(read_text(file));
    ASSERT_TRUE(record);
    ASSERT_EQ(record->files.size(), 1U);
    record->files[0].path = target == "absolute" ? (folder / "escaped.txt").string() : target;
    write_text(file, record_text(*record));  // with a hash that is right
    const auto result = run(b.pipeline(), folder / "second", folder / "cache");
    EXPECT_TRUE(result.failures.empty());
    EXPECT_EQ(result.nodes[0].cache.result, CacheUse::Result::miss);
    EXPECT_FALSE(fs::exists(folder / "escaped.txt")) << target;
    EXPECT_EQ(read_text(folder / "second/good.txt"), "written");
  }
}

// The hash becomes a file's name, and a damaged file is removed.
TEST(Trust, AForgedHashInTheCacheNeitherReadsNorRemovesAFile) {
  for (const bool of_output : {false, true}) {
    const TemporaryFolder folder;
    PipelineBuilder b;
    add_writer(b, "good.txt");
    run(b.pipeline(), folder / "first", folder / "cache");
    write_text(folder / "thesis.tex", "mine");
    fs::path file;
    for (const auto& entry : fs::directory_iterator(folder / "cache/records/test.call")) file = entry.path();
    auto record = read_record(read_text(file));
    ASSERT_TRUE(record);
    (of_output ? record->outputs[0].hash : record->files[0].hash) = (folder / "thesis.tex").string();
    write_text(file, record_text(*record));
    EXPECT_FALSE(read_record(read_text(file)));
    const auto result = run(b.pipeline(), folder / "second", folder / "cache");
    EXPECT_TRUE(result.failures.empty());
    EXPECT_EQ(result.nodes[0].cache.result, CacheUse::Result::miss);
    EXPECT_EQ(read_text(folder / "thesis.tex"), "mine");
    EXPECT_EQ(read_text(folder / "second/good.txt"), "written");
  }
}

enum class Colour : std::uint8_t { red, green, blue };

TEST(Trust, AnEnumOfTheCacheHasOneOfItsValues) {
  const auto read = [](const FlatType* type, const std::string& bytes) {
    FlatReader in(reinterpret_cast<const std::byte*>(bytes.data()), bytes.size(), {});
    type->read(in);
  };
  EXPECT_NO_THROW(read(flat_type<Colour>(), "\2"));
  EXPECT_THROW(read(flat_type<Colour>(), "\3"), Error);
  const std::string two("\2\0\0\0\0\0\0\0", 8);  // how many there are
  EXPECT_NO_THROW(read(flat_type<std::vector<Colour>>(), two + "\1\2"));
  EXPECT_THROW(read(flat_type<std::vector<Colour>>(), two + "\1\xc8"), Error);
}

TEST(Trust, ARunRemovesFilesOfTheEarlierRunOnly) {
  const TemporaryFolder folder;
  PipelineBuilder b;
  add_writer(b, "good.txt");
  run(b.pipeline(), folder / "run", folder / "cache");
  fs::create_directories(folder / "elsewhere");
  write_text(folder / "elsewhere/mine.txt", "mine");
  fs::create_symlink(folder / "elsewhere", folder / "run/link");
  write_text(folder / "run/.film.mkv.part", "a download of mine");
  write_text(folder / "run/.talk.7.part", "and another one");
  write_text(folder / "run/.good.txt.0123abcd-71-00000000deadbeef.part", "unfinished");
  std::string manifest = read_text(folder / "run/manifest.json");
  manifest.replace(manifest.find("\"good.txt\""), 10, "\"link/mine.txt\"");
  manifest.replace(manifest.find("\"bytes\": 7"), 10, "\"bytes\": 4");
  write_text(folder / "run/manifest.json", manifest);
  run(b.pipeline(), folder / "run", folder / "cache");
  EXPECT_EQ(read_text(folder / "elsewhere/mine.txt"), "mine");
  EXPECT_EQ(read_text(folder / "run/.film.mkv.part"), "a download of mine");
  EXPECT_EQ(read_text(folder / "run/.talk.7.part"), "and another one");
  EXPECT_FALSE(fs::exists(folder / "run/.good.txt.0123abcd-71-00000000deadbeef.part"));
}

TEST(Trust, UnfinishedFilesSayWhoseTheyAre) {
  const std::string own = unfinished_file_name("a.b.ply");
  EXPECT_EQ(name_of_unfinished(own), "a.b.ply");
  EXPECT_NE(unfinished_file_name("a.b.ply"), own);
  EXPECT_EQ(is_writer_gone(own), false);
  EXPECT_EQ(is_writer_gone(".x.999999999-1.part"), true);                                  // of earlier versions
  EXPECT_EQ(is_writer_gone(".x.0123abcd-999999999-00000000deadbeef.part"), std::nullopt);  // of another machine
  for (const char* foreign : {"x.part", ".film.mkv.part", ".x..part", ".part", ".x.1-2.par", ".1-2.part"})
    EXPECT_EQ(name_of_unfinished(foreign), "") << foreign;
}

TEST(FolderLock, IsOfAFileAndNamesItsHolder) {
  const TemporaryFolder folder;
  const std::string self = "process " + std::to_string(::getpid()) + " on ";
  {
    const FolderLock first(folder.path(), FolderLock::Kind::alone);
    ASSERT_TRUE(first.held());
    EXPECT_TRUE(fs::is_regular_file(folder / ".atrium-lock"));
    const FolderLock second(folder.path(), FolderLock::Kind::shared);
    EXPECT_FALSE(second.held());
    EXPECT_TRUE(second.holder().starts_with(self)) << second.holder();
  }
  EXPECT_TRUE(fs::is_empty(folder.path()));
  const FolderLock a(folder.path(), FolderLock::Kind::shared);
  const FolderLock b(folder.path(), FolderLock::Kind::shared);
  EXPECT_TRUE(a.held() && b.held());
  EXPECT_FALSE(FolderLock(folder.path(), FolderLock::Kind::alone).held());
}

TEST(FolderLock, IsNotTakenThroughAPlantedLink) {
  const TemporaryFolder folder;
  write_text(folder / "precious", "precious");
  fs::create_directories(folder / "run");
  fs::create_symlink(folder / "precious", folder / "run/.atrium-lock");
  EXPECT_THROW(FolderLock(folder / "run", FolderLock::Kind::alone), Error);
  EXPECT_EQ(read_text(folder / "precious"), "precious");
}

TEST(Trust, APieceOfAnySizeIsCalledOnce) {
  std::vector<std::pair<std::size_t, std::size_t>> pieces;
  const Context context;
  context.parallel_chunks(10, std::numeric_limits<std::size_t>::max(),
                          [&](std::size_t, std::size_t b, std::size_t e) { pieces.emplace_back(b, e); });
  EXPECT_EQ(pieces, (std::vector<std::pair<std::size_t, std::size_t>>{{0, 10}}));
}

class Loading : public testing::Test {
 protected:
  Loading() { test::add_test_nodes(registry); }
  /// The first error, "" if there is none.
  std::string first_error(const fs::path& file, const std::vector<Override>& set = {}) {
    const LoadResult loaded = load_pipeline(file, set, registry);
    nodes = loaded.pipeline;
    return loaded.errors.empty() ? "" : to_string(loaded.errors.front());
  }
  double seconds_for(const fs::path& file) {
    const auto start = std::chrono::steady_clock::now();
    first_error(file);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  TemporaryFolder folder;
  Registry registry{std::vector<fs::path>{}};
  Pipeline nodes;
};

// A machine writes no line breaks. The same file with them is the measure.
TEST_F(Loading, OneLongLineCostsNoMoreThanManyShortOnes) {
  const auto text = [](const std::string& end) {
    std::string yaml = "{\"atrium\": 1, \"nodes\": {\"n0\": {\"type\": \"test.make\"}";
    for (int i = 1; i < 5000; ++i)
      yaml += "," + end + "\"n" + std::to_string(i) + "\": {\"type\": \"test.find\", \"in\": {\"cloud\": \"n" +
              std::to_string(i - 1) + (i == 1 ? ".cloud" : ".rest") + "\"}}";
    return yaml + "}, \"outputs\": {\"rest\": \"n4999.rest\"}}";
  };
  write_text(folder / "lines.yaml", text("\n"));
  write_text(folder / "line.yaml", text(""));
  EXPECT_EQ(first_error(folder / "line.yaml"), "");
  EXPECT_LT(seconds_for(folder / "line.yaml"), 5 * seconds_for(folder / "lines.yaml") + 0.5);
}

TEST_F(Loading, SubPipelinesThatDoubleAtEachLevelAreRefusedSoon) {
  write_text(folder / "p30.yaml", "atrium: 1\nnodes: {}\n");
  for (int i = 0; i < 30; ++i) {
    const std::string next = "{pipeline: p" + std::to_string(i + 1) + ".yaml}";
    write_text(folder / ("p" + std::to_string(i) + ".yaml"), "atrium: 1\nnodes: {a: " + next + ", b: " + next + "}\n");
  }
  const auto start = std::chrono::steady_clock::now();
  const LoadResult loaded = load_pipeline(folder / "p0.yaml", {}, registry);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
  std::string all;
  for (const auto& error : loaded.errors) all += error.message + "\n";
  EXPECT_NE(all.find("more than 20000 sub-pipelines"), std::string::npos) << all.substr(0, 1000);
}

TEST_F(Loading, APipelineMayComeFromAPipe) {
  const fs::path pipe = folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::thread writer([&] { write_text(pipe, "atrium: 1\nnodes: {a: {type: test.make}}\noutputs: {a: a.cloud}\n"); });
  EXPECT_EQ(first_error(pipe), "");
  writer.join();
}

TEST_F(Loading, AScanInThePlaceOfAPipelineIsNamed) {
  write_text(folder / "scan.ply", "ply\nformat binary_little_endian 1.0\nend_header\n\xca\xfe");
  const std::string error = first_error(folder / "scan.ply");
  EXPECT_NE(error.find("this is no pipeline file, but data"), std::string::npos) << error;
  EXPECT_NE(error.find("atrium run atrium.yaml -s scan=" + (folder / "scan.ply").string()), std::string::npos) << error;
}

TEST_F(Loading, ASettingThatIsNotUtf8IsSaid) {
  write_text(folder / "a", "");
  write_text(folder / "p.yaml",
             "atrium: 1\nvars: {scan: a}\nnodes: {a: {type: test.read, params: {path: \"${scan}\"}}}\n"
             "outputs: {a: a.cloud}\n");
  const std::string error = first_error(folder / "p.yaml", {{"scan=caf\xe9.xyz", "-s", {}}});
  EXPECT_NE(error.find("is not UTF-8: its byte 8 is 0xe9"), std::string::npos) << error;
}

// Values go from a sweep to its variants as they are, not through a text that is read again.
TEST_F(Loading, ASweepsValuesAreWhatTheFileSays) {
  write_text(folder / "p.yaml",
             "atrium: 1\nnodes:\n  c: {type: test.make}\n  p: {type: test.find, in: {cloud: c.cloud}}\n"
             "  w: {type: test.write, in: {planes: p.planes}}\n");
  write_text(folder / "s.yaml",
             R"({"atrium": 1, "sweep": "p.yaml", "grid": {"w.path": ["a\nb.ply", "it's \"b\".ply"],)"
             R"( "p.distance": ["1 m", "20 cm", 0.3], "p.box": [["1 m", "2 m", "3 m"], [1, 2, 3.5]]}})");
  Findings findings;
  const auto sweep = read_sweep(folder / "s.yaml", "s.yaml", findings);
  ASSERT_EQ(findings.error_count(), 0U) << to_string(findings.errors().front());
  const SweepLoad load = plan_sweep(*sweep, {}, registry);
  ASSERT_TRUE(load.errors.empty()) << to_string(load.errors.front());
  EXPECT_EQ(load.plan.variants.size(), 12U);
  std::set<std::string> paths;
  for (const std::size_t n : all_nodes(load.plan.merged))
    if (const PipelineNode& node = load.plan.merged[n]; node.type->type == "test.write")
      paths.insert(std::get<std::string>(node.params.at(0)));
  EXPECT_EQ(paths, (std::set<std::string>{"a\nb.ply", "it's \"b\".ply"}));
}

class Streams : public testing::Test {
 protected:
  Streams() { write_text(folder / "bad.yaml", "atrium: 1\nnodes: {a: {type: test.mak}}\n"); }
  int shell(const std::string& command) {
    ProcessOptions options;
    options.folder = folder.path();
    options.environment.push_back("ATRIUM=" ATRIUM_PROGRAM);
    const fs::path plugins = fs::path(ATRIUM_PROGRAM).parent_path().parent_path() / "tests/plugins";
    options.environment.push_back("ATRIUM_PLUGIN_PATH=" + plugins.string());
    return test::run_process({"/bin/sh", "-c", command}, options).exit_code;
  }
  TemporaryFolder folder;
};

TEST_F(Streams, WhatCannotBeSaidChangesNoExitCode) {
  EXPECT_EQ(shell("\"$ATRIUM\" check bad.yaml"), 3);
  EXPECT_EQ(shell("\"$ATRIUM\" check bad.yaml 2>&-"), 3);
  EXPECT_EQ(shell("\"$ATRIUM\" check bad.yaml 2>/dev/full"), 3);
  EXPECT_EQ(shell("cat bad.yaml | \"$ATRIUM\" check /dev/stdin"), 3);
  write_text(folder / "good.yaml", "atrium: 1\nnodes: {a: {type: test.make}}\noutputs: {a: a.cloud}\n");
  EXPECT_EQ(shell("\"$ATRIUM\" run good.yaml --out r 2>/dev/full"), 0);
  EXPECT_EQ(shell("cat good.yaml | \"$ATRIUM\" run /dev/stdin --out s"), 0);
}

}  // namespace
}  // namespace atrium::trust_test
