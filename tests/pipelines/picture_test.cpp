// Pictures by the program: made again from the picture itself, the same with any number of threads, and every bad
// input.
#include <gtest/gtest.h>

#include "tests/support/lacking.hpp"
#include "tests/support/temporary_folder.hpp"

namespace atrium::test::picture_test {
namespace {

namespace fs = std::filesystem;

class Picture : public testing::Test {
 protected:
  ProcessResult atrium(std::vector<std::string> arguments, std::vector<std::string> environment = {}) {
    arguments.insert(arguments.begin(), ATRIUM_PROGRAM);
    return run_process(arguments, {folder.path(), std::move(environment)});
  }
  /// Draws a cloud of this text (one point a line); `params` of the snapshot.
  ProcessResult draw(const std::string& points, const std::string& params, std::vector<std::string> environment = {}) {
    write_text(folder / "cloud.xyz", points);
    write_text(folder / "draw.yaml",
               "atrium: 1\nnodes:\n  cloud: {type: io.read_scan, params: {path: cloud.xyz}}\n"
               "  draw: {type: render.snapshot, in: {cloud: cloud.cloud}, params: {" +
                   params + "}}\n");
    return atrium({"run", "draw.yaml", "--out", "run", "-q"}, std::move(environment));
  }
  /// Files in the run's folder besides the record of the run.
  std::size_t pictures() const {
    std::size_t count = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder / "run"))
      if (entry.path().extension() == ".png" || entry.path().extension() == ".part") ++count;
    return count;
  }
  TemporaryFolder folder;
};

constexpr const char* three = "0 0 0\n1 0 0\n1 1 1\n";  // the least that io.read_scan takes

constexpr const char* room = R"(atrium: 1
seed: 5
nodes:
  room: {type: synth.room}
  scan: {type: synth.scan, in: {scene: room.scene}, params: {points: 20000}}
  write: {type: io.write_cloud, in: {cloud: scan.cloud}, params: {path: scan.ply}}
  views:
    type: render.snapshot
    in: {cloud: scan.cloud, reference: scan.mesh}
    params: {path: view.png, views: [isometric, inside], width: 320, height: 240}
  truth: {type: render.snapshot, in: {truth: scan.truth}, params: {path: truth.png, width: 320, height: 240}}
  sheet: {type: render.contact_sheet, in: {pictures: [views.pictures, truth.pictures]}, params: {cell_width: 160}}
)";

TEST_F(Picture, IsMadeAgainFromItselfWithTheSameBytes) {
  write_text(folder / "room.yaml", room);
  ASSERT_EQ(atrium({"run", "room.yaml", "--out", "one", "-j", "1"}).exit_code, 0);
  ASSERT_EQ(atrium({"run", "room.yaml", "--out", "two", "-j", "2"}).exit_code, 0);
  const auto again = atrium({"run", "one/sheet.png", "--out", "again"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  for (const std::string name : {"view_isometric.png", "view_inside.png", "truth.png", "sheet.png"}) {
    EXPECT_EQ(read_text(folder / "one" / name), read_text(folder / "two" / name)) << name;
    EXPECT_EQ(read_text(folder / "one" / name), read_text(folder / "again" / name)) << name;
  }
  EXPECT_EQ(atrium({"check", "again/truth.png"}).exit_code, 0);
  EXPECT_NE(atrium({"graph", "again/truth.png"}).out.find("render.contact_sheet"), std::string::npos);
  ASSERT_EQ(atrium({"run", "one/sheet.png", "-s", "seed=6", "--out", "other"}).exit_code, 0);
  EXPECT_NE(read_text(folder / "one/sheet.png"), read_text(folder / "other/sheet.png"));
}

TEST_F(Picture, SaysWhatKeepsItFromBeingMadeAgain) {
  ASSERT_EQ(draw(three, "path: a.png, width: 64, height: 64").exit_code, 0);
  const std::string whole = read_text(folder / "run/a.png");
  write_text(folder / "part.png", whole.substr(0, whole.size() / 2));
  const auto part = atrium({"run", "part.png", "--out", "again"});
  EXPECT_EQ(part.exit_code, 3);
  EXPECT_NE(part.err.find("not whole"), std::string::npos) << part.err;
  fs::copy(ATRIUM_SOURCE_DIR "/tests/golden/truth.png", folder / "plain.png");
  const auto plain = atrium({"run", "plain.png", "--out", "again"});
  EXPECT_EQ(plain.exit_code, 3);
  EXPECT_NE(plain.err.find("does not say what made it"), std::string::npos) << plain.err;
  fs::remove(folder / "cloud.xyz");
  const auto gone = atrium({"run", "run/a.png", "--out", "again"});
  EXPECT_EQ(gone.exit_code, 3);
  EXPECT_NE(gone.err.find("no such file"), std::string::npos) << gone.err;
  EXPECT_NE(gone.err.find("-s cloud.path=FILE"), std::string::npos) << gone.err;
  write_text(folder / "moved.xyz", three);
  EXPECT_EQ(atrium({"run", "run/a.png", "-s", "cloud.path=moved.xyz", "--out", "again"}).exit_code, 0);
  EXPECT_FALSE(fs::is_empty(folder / "again"));
}

TEST_F(Picture, BadParametersAreFoundBeforeAnythingRuns) {
  const auto size = draw(three, "width: 20000, height: 20000");
  EXPECT_EQ(size.exit_code, 3);
  EXPECT_NE(size.err.find("8192"), std::string::npos) << size.err;
  const auto nan = draw(three, "eye: [.nan, 0, 0], target: [0, 0, 1]");
  EXPECT_EQ(nan.exit_code, 3) << nan.err;
  EXPECT_NE(nan.err.find("eye"), std::string::npos) << nan.err;
  EXPECT_EQ(draw(three, "eye: [nan, 0, 0], target: [0, 0, 1]").exit_code, 3);
  EXPECT_EQ(draw(three, "path: ../a.png").exit_code, 3);
  EXPECT_FALSE(fs::exists(folder / "run"));
}

TEST_F(Picture, WhatCannotBeDrawnIsAnErrorWithoutAFile) {
  const auto expect = [&](const std::string& params, const std::string& words) {
    const auto result = draw(three, params);
    EXPECT_EQ(result.exit_code, 1) << params;
    EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
    EXPECT_EQ(pictures(), 0U) << params;
  };
  expect("eye: [1, 2, 3], target: [1, 2, 3]", "same place");
  expect("eye: [1, 2, 3]", "'target' needs three numbers");
  expect("eye: [1, 2], target: [1, 2, 3]", "'eye' needs three numbers");
  expect("views: [below]", "no view 'below'");
  expect("colour_by: distance", "no mesh to measure distances to");
  expect("colour_by: label", "no labels");
  expect("colour_by: height, colour_map: jet", "no colour map 'jet'");
}

TEST_F(Picture, NothingToDrawIsAnError) {
  write_text(folder / "nothing.yaml", "atrium: 1\nnodes:\n  draw: {type: render.snapshot}\n");
  const auto result = atrium({"run", "nothing.yaml", "--out", "run"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("nothing to draw"), std::string::npos) << result.err;
  EXPECT_EQ(pictures(), 0U);
}

TEST_F(Picture, AFolderThatCannotBeWrittenIsAnError) {
  // A file where the picture's folder should be: as good as forbidden, also to root.
  write_text(folder / "draw2.yaml", R"(atrium: 1
nodes:
  room: {type: synth.room}
  scan: {type: synth.scan, in: {scene: room.scene}, params: {points: 100}}
  draw: {type: render.snapshot, in: {cloud: scan.cloud}, params: {path: folder/a.png, width: 64, height: 64}}
)");
  fs::create_directories(folder / "run");
  ASSERT_EQ(draw(three, "width: 64, height: 64").exit_code, 0);
  write_text(folder / "run/folder", "in the way");
  const auto result = atrium({"run", "draw2.yaml", "--out", "run"});
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_NE(result.err.find("cannot make the folder"), std::string::npos) << result.err;
  EXPECT_EQ(pictures(), 0U);
}

TEST_F(Picture, WithoutEglItIsDrawnByAnXServerOrIsAClearError) {
  const std::vector<std::string> no_egl{"__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent", "DISPLAY=:4711"};
  const auto none = draw(three, "path: a.png, width: 64, height: 64", no_egl);
  EXPECT_EQ(none.exit_code, 1) << none.err;
  EXPECT_NE(none.err.find("no picture can be drawn on this machine"), std::string::npos) << none.err;
  EXPECT_NE(none.err.find("xvfb-run -a"), std::string::npos) << none.err;
  EXPECT_EQ(pictures(), 0U);
  if (!has_program("xvfb-run") || !has_program("Xvfb")) ATRIUM_SKIP_LACKING("xvfb is not installed");
  ASSERT_EQ(draw(three, "path: a.png, width: 64, height: 64").exit_code, 0);
  const std::string by_egl = read_text(folder / "run/a.png");
  const auto by_x = run_process({"xvfb-run", "-a", ATRIUM_PROGRAM, "run", "draw.yaml", "--out", "run", "-q"},
                                {folder.path(), {no_egl.front()}});
  ASSERT_EQ(by_x.exit_code, 0) << by_x.err;
  const auto size = static_cast<double>(read_text(folder / "run/a.png").size());
  EXPECT_NEAR(size, static_cast<double>(by_egl.size()), 0.05 * size) << "another rasteriser, much the same picture";
}

TEST_F(Picture, AnXServerDrawsManyByManyThreads) {
  if (!has_program("xvfb-run") || !has_program("Xvfb")) ATRIUM_SKIP_LACKING("xvfb is not installed");
  write_text(folder / "many.yaml", R"(atrium: 1
seed: 5
nodes:
  room: {type: synth.room}
  scan: {type: synth.scan, in: {scene: room.scene}, params: {points: 2000}}
  a: {type: render.snapshot, in: {truth: scan.truth}, params: {path: a.png, views: [top, inside], width: 160, height: 120}}
  b: {type: render.snapshot, in: {cloud: scan.cloud}, params: {path: b.png, views: [top, inside], width: 160, height: 120}}
  c: {type: render.snapshot, in: {truth: scan.truth}, params: {path: c.png, views: [front, left], width: 160, height: 120}}
)");
  // Threads that end after the process has begun to would show memory that was freed before.
  const std::string runs =
      "for i in 1 2 3 4 5 6; do '" ATRIUM_PROGRAM "' run many.yaml --out run -q -j 4 || exit; done";
  const auto result =
      run_process({"xvfb-run", "-a", "sh", "-c", runs},
                  {folder.path(), {"__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent", "MALLOC_PERTURB_=165"}});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(pictures(), 6U);
}

TEST_F(Picture, TheSameViewTwiceOrAnotherFormatIsAnErrorWithoutAFile) {
  for (const std::string params : {"views: [top, top]", "path: a.jpg"}) {
    const auto result = draw(three, params + ", width: 64, height: 64");
    EXPECT_EQ(result.exit_code, 1) << params << result.err;
    EXPECT_EQ(pictures(), 0U) << params;
  }
}

}  // namespace
}  // namespace atrium::test::picture_test
