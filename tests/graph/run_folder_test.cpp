#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "graph/run/runner.hpp"
#include "tests/graph/run_nodes.hpp"
#include "tests/support/pipeline_builder.hpp"
#include "tests/support/temporary_folder.hpp"

namespace atrium::run_folder_test {
namespace {

using nlohmann::json;
using test::Call;
using test::Counted;
using test::PipelineBuilder;
using test::read_text;
using test::Sum;
using test::TemporaryFolder;
using test::write_text;

RunResult run(const Pipeline& pipeline, const std::filesystem::path& out, int threads = 2) {
  RunOptions options;
  options.out = out;
  options.threads = threads;
  ProgressSink silent;
  return run_pipeline(pipeline, options, silent);
}

json manifest(const std::filesystem::path& folder) { return json::parse(read_text(folder / "manifest.json")); }

// A node that writes `text` to `name` and warns.
void add_writer(PipelineBuilder& builder, const std::string& name, const std::string& text) {
  Call::functions.emplace_back([name, text](Context& context) {
    AtomicFile file(context.output(name));
    file.write(text);
    file.commit();
    context.wrote(context.output(name));
    context.warn("it is only a test");
    return input(Counted(1));
  });
  builder.add<Call>("write " + name);
  builder.set("which", static_cast<std::int64_t>(Call::functions.size() - 1));
}

TEST(RunFolder, HoldsTheManifestTheTraceAndTheResolvedPipeline) {
  TemporaryFolder folder;
  PipelineBuilder b;
  const auto a = b.add<Sum>("a");
  b.add<Sum>("bad", {{{a, 0}}});
  b.set("fail", true);
  b.add<Sum>("after", {{{1, 0}}});
  add_writer(b, "sub/x.txt", "12345");
  b.output("a", {a, 0});
  b.pipeline()[whole].seed = 7;
  run(b.pipeline(), folder / "new/run");
  const auto m = manifest(folder / "new/run");
  EXPECT_EQ(m["status"], "failed");
  EXPECT_EQ(m["seed"], 7);
  EXPECT_EQ(m["threads"], 2);
  ASSERT_EQ(m["nodes"].size(), 4U);
  EXPECT_EQ(m["nodes"][0]["status"], "ok");
  EXPECT_EQ(m["nodes"][0]["outputs"][0]["hash"], content_hash(Counted(1)));
  EXPECT_EQ(m["nodes"][0]["outputs"][0]["bytes"], 8);
  EXPECT_EQ(m["outputs"]["a"]["hash"], content_hash(Counted(1)));
  EXPECT_EQ(m["nodes"][1]["status"], "failed");
  EXPECT_EQ(m["nodes"][1]["message"], "told to fail");
  EXPECT_EQ(m["nodes"][1]["help"], "do not tell it");
  EXPECT_EQ(m["nodes"][2]["status"], "skipped");
  EXPECT_EQ(m["nodes"][2]["because"], "bad");
  EXPECT_EQ(m["nodes"][3]["warnings"], json::array({"it is only a test"}));
  EXPECT_EQ(m["nodes"][3]["artefacts"], json::array({{{"path", "sub/x.txt"}, {"bytes", 5}}}));
  EXPECT_GT(m["peak_memory"], 1'000'000);
  const auto trace = json::parse(read_text(folder / "new/run/trace.json"));
  std::set<std::string> names;
  for (const auto& event : trace["traceEvents"])
    if (event["ph"] == "X") names.insert(event["name"]);
  EXPECT_EQ(names, (std::set<std::string>{"a", "bad", "write sub/x.txt"}));
  EXPECT_TRUE(std::filesystem::exists(folder / "new/run/resolved.yaml"));
}

TEST(RunFolder, HashesAreThoseOfAnyNumberOfThreads) {
  TemporaryFolder folder;
  PipelineBuilder b;
  for (std::size_t i = 0; i < 50; ++i) {
    b.add<Sum>("n" + std::to_string(i), {i < 5 ? std::vector<Source>{} : std::vector<Source>{{i - 5, 0}, {i / 2, 0}}});
  }
  const auto outputs = [&](int threads) {
    run(b.pipeline(), folder / "run", threads);
    json list = json::array();
    const auto all = manifest(folder / "run");
    for (const auto& node : all["nodes"]) list.push_back({node["node"], node["outputs"]});
    return list;
  };
  const auto serial = outputs(1);
  ASSERT_EQ(serial.size(), 50U);
  EXPECT_EQ(serial[49][1][0]["hash"].get<std::string>().size(), 32U);
  EXPECT_EQ(serial, outputs(2));
  EXPECT_EQ(serial, outputs(4));
}

TEST(RunFolder, AFolderOfOtherThingsIsRefusedAndLeftAlone) {
  TemporaryFolder folder;
  write_text(folder / "thesis.tex", "years of work");
  PipelineBuilder b;
  add_writer(b, "thesis.tex", "gone");
  EXPECT_THROW(run(b.pipeline(), folder.path()), FolderError);
  EXPECT_EQ(read_text(folder / "thesis.tex"), "years of work");
  write_text(folder / "manifest.json", R"({"name": "of something else"})");
  EXPECT_THROW(run(b.pipeline(), folder.path()), FolderError);
  write_text(folder / "file", "");
  EXPECT_THROW(run(b.pipeline(), folder / "file"), FolderError);
}

TEST(RunFolder, ASecondRunLeavesNothingOfTheFirst) {
  TemporaryFolder folder;
  PipelineBuilder first;
  add_writer(first, "stale.txt", "stale");
  add_writer(first, "edited.txt", "as written");
  add_writer(first, "both.txt", "first");
  run(first.pipeline(), folder.path());
  write_text(folder / "edited.txt", "by hand, after the run");
  PipelineBuilder second;
  add_writer(second, "both.txt", "second");
  run(second.pipeline(), folder.path());
  EXPECT_FALSE(std::filesystem::exists(folder / "stale.txt"));
  EXPECT_EQ(read_text(folder / "edited.txt"), "by hand, after the run");
  EXPECT_EQ(read_text(folder / "both.txt"), "second");
  EXPECT_EQ(manifest(folder.path())["nodes"].size(), 1U);
}

TEST(RunFolder, IsLockedAgainstASecondRun) {
  TemporaryFolder folder;
  const int lock = ::open((folder / ".atrium-lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  ASSERT_EQ(::flock(lock, LOCK_EX), 0);
  EXPECT_THROW(run(Pipeline{}, folder.path()), FolderError);
  ::close(lock);
  EXPECT_NO_THROW(run(Pipeline{}, folder.path()));
}

TEST(RunFolder, SaysThatItIsNotFinishedUntilItIs) {
  TemporaryFolder folder;
  PipelineBuilder b;
  std::string status;
  Call::functions.emplace_back([&](Context& context) {
    status = manifest(context.output("x").parent_path())["status"];
    return input(Counted(1));
  });
  b.add<Call>("look");
  b.set("which", static_cast<std::int64_t>(Call::functions.size() - 1));
  run(b.pipeline(), folder.path());
  EXPECT_EQ(status, "running");
  EXPECT_EQ(manifest(folder.path())["status"], "ok");
}

}  // namespace
}  // namespace atrium::run_folder_test
