// What a picture says of its run: the chunks, damage, and a pipeline loaded from one.
#include "graph/pipeline/png_stamp.hpp"

#include <gtest/gtest.h>

#include "graph/pipeline/registry.hpp"
#include "graph/run/runner.hpp"
#include "tests/graph/run_nodes.hpp"
#include "tests/support/pipeline_builder.hpp"
#include "tests/support/temporary_folder.hpp"

namespace atrium::png_stamp_test {
namespace {

using test::read_text;
using test::TemporaryFolder;
using test::write_text;

/// A PNG file of one orange pixel.
std::string pixel() {
  constexpr std::string_view digits =
      "89504e470d0a1a0a0000000d4948445200000001000000010802000000907753de0000000c49444154789c63f8dfc000"
      "0004010180c52a185d0000000049454e44ae426082";
  std::string bytes;
  for (std::size_t i = 0; i < digits.size(); i += 2)
    bytes += static_cast<char>(std::stoi(std::string(digits.substr(i, 2)), nullptr, 16));
  return bytes;
}

std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(PngStamp, IsReadBackAndReplaced) {
  TemporaryFolder folder;
  const auto file = folder / "a.png";
  write_text(file, pixel());
  stamp_png(file, {"0123", "atrium: 1\nsummary: Größe in m²\n"});
  EXPECT_EQ(read_png_stamp(file).run, "0123");
  EXPECT_EQ(read_png_stamp(file).resolved, "atrium: 1\nsummary: Größe in m²\n");
  const auto size = std::filesystem::file_size(file);
  stamp_png(file, {"4567", "atrium: 1\nsummary: Größe in m³\n"});
  EXPECT_EQ(read_png_stamp(file).run, "4567");
  EXPECT_EQ(read_png_stamp(file).resolved, "atrium: 1\nsummary: Größe in m³\n");
  EXPECT_EQ(std::filesystem::file_size(file), size) << "one stamp, not two";
  EXPECT_EQ(read_text(file).substr(read_text(file).size() - 12, 12), pixel().substr(pixel().size() - 12, 12));
}

TEST(PngStamp, ATruncatedOrChangedFileIsAnErrorAndIsLeftAsItIs) {
  TemporaryFolder folder;
  const auto file = folder / "a.png";
  write_text(file, pixel());
  stamp_png(file, {"0123", "atrium: 1\n"});
  const std::string whole = read_text(file);
  for (std::size_t size = 8; size < whole.size(); ++size) {
    const std::string part = whole.substr(0, size);
    write_text(file, part);
    EXPECT_NE(message_of([&] { read_png_stamp(file); }).find("not whole"), std::string::npos) << size;
    EXPECT_NE(message_of([&] { stamp_png(file, {"1", "2"}); }).find("not whole"), std::string::npos) << size;
    ASSERT_EQ(read_text(file), part);
  }
  for (std::size_t at = 8; at < whole.size(); ++at) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ 4);
    write_text(file, changed);
    EXPECT_NE(message_of([&] { read_png_stamp(file); }), "no error") << at;
  }
  write_text(folder / "plain.png", pixel());
  EXPECT_NE(message_of([&] { read_png_stamp(folder / "plain.png"); }).find("atrium:resolved"), std::string::npos);
  write_text(folder / "text.png", "not a picture");
  EXPECT_FALSE(is_png(folder / "text.png"));
  EXPECT_NE(message_of([&] { read_png_stamp(folder / "text.png"); }).find("not a PNG"), std::string::npos);
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path())) ++files;
  EXPECT_EQ(files, 3U) << "no unfinished file is left";
}

TEST(PngStamp, EveryPictureOfARunCarriesItAndOtherFilesDoNot) {
  TemporaryFolder folder;
  test::PipelineBuilder b;
  test::Call::functions.emplace_back([](Context& context) {
    for (const std::string name : {"a.png", "sub/b.picture", "text.png"}) {
      AtomicFile file(context.output(name));
      file.write(name == "text.png" ? "text" : pixel());
      file.commit();
      context.wrote(context.output(name));
    }
    return input(test::Counted(1));
  });
  b.add<test::Call>("draw");
  b.set("which", static_cast<std::int64_t>(test::Call::functions.size() - 1));
  RunOptions options;
  options.out = folder / "run";
  ProgressSink silent;
  ASSERT_TRUE(run_pipeline(b.pipeline(), options, silent).failures.empty());
  const PngStamp stamp = stamp_of(b.pipeline());
  EXPECT_EQ(stamp.resolved, resolved_yaml(b.pipeline()));
  EXPECT_EQ(read_png_stamp(folder / "run/a.png").resolved, stamp.resolved);
  EXPECT_EQ(read_png_stamp(folder / "run/sub/b.picture").run, stamp.run);
  EXPECT_NE(read_text(folder / "run/manifest.json").find("\"run\": \"" + stamp.run), std::string::npos);
  EXPECT_EQ(read_text(folder / "run/text.png"), "text");
}

struct Start {
  static constexpr std::string_view type = "test.start";
  static constexpr std::string_view summary = "Would start a program.";
  static constexpr bool runs_programs = true;
  static void run() {}
};

TEST(PngStamp, APictureStartsNoProgram) {
  TemporaryFolder folder;
  Registry registry{std::vector<std::filesystem::path>{}};
  registry.add(describe_node<Start>());
  const std::string starting = "atrium: 1\nnodes: {start: {type: test.start}}\n";
  write_text(folder / "plain.yaml", starting);
  EXPECT_TRUE(load_pipeline(folder / "plain.yaml", {}, registry).errors.empty());
  write_text(folder / "a.png", pixel());
  stamp_png(folder / "a.png", {"0123", starting});
  write_text(folder / "with_picture.yaml", "atrium: 1\nnodes: {sub: {pipeline: a.png}}\n");
  for (const std::string name : {"a.png", "with_picture.yaml"}) {
    const LoadResult result = load_pipeline(folder / name, {}, registry);
    ASSERT_EQ(result.errors.size(), 1U) << name;
    EXPECT_NE(result.errors[0].message.find("would start a program"), std::string::npos) << name;
  }
}

TEST(PngStamp, APictureWithoutOneIsNoPipeline) {
  TemporaryFolder folder;
  write_text(folder / "plain.png", pixel());
  Registry registry;
  const LoadResult result = load_pipeline(folder / "plain.png", {}, registry);
  ASSERT_EQ(result.errors.size(), 1U);
  EXPECT_NE(result.errors[0].message.find("does not say what made it"), std::string::npos);
}

}  // namespace
}  // namespace atrium::png_stamp_test
