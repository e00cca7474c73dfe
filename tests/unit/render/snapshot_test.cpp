#include "modules/render/snapshot.hpp"

#include <gtest/gtest.h>

#include "modules/render/contact_sheet.hpp"
#include "modules/render/png.hpp"
#include "modules/types/palette.hpp"
#include "tests/unit/render/pictures.hpp"

namespace atrium::render::snapshot_test {
namespace {

TEST(Snapshot, LooksIntoARoomFromAbove) {
  auto host = std::make_shared<Folder>();
  Context context(1, host);
  Snapshot::Params params;
  params.width = 320;
  params.height = 240;
  params.views = {"top", "isometric"};
  params.path.path = "room.png";
  const auto out = Snapshot::run({.meshes = input(room({500000, 5400000, 100}))}, params, context);
  ASSERT_EQ(out.pictures.pictures.size(), 2U);
  const Picture& top = out.pictures.pictures[0];
  EXPECT_TRUE(same_hue(pixel(top, 0.5, 0.5), class_colour(SurfaceClass::floor))) << "the ceiling is left out";
  EXPECT_EQ(pixel(top, 0.01, 0.5), (Colour{255, 255, 255}));
  const Picture written = read_png(host->path_ / "room_top.png");
  EXPECT_EQ(written.pixels, top.pixels);
  EXPECT_TRUE(fs::exists(host->path_ / "room_isometric.png"));
}

TEST(Snapshot, GivesTheSamePixelsEveryTime) {
  auto host = std::make_shared<Folder>();
  Context context(1, host);
  Snapshot::Params params;
  params.width = 320;
  params.height = 240;
  params.title = "A room";
  const auto meshes = input(room(Eigen::Vector3d::Zero()));
  const auto first = Snapshot::run({.meshes = meshes}, params, context);
  const auto second = Snapshot::run({.meshes = meshes}, params, context);
  EXPECT_EQ(first.pictures.pictures[0].pixels, second.pictures.pictures[0].pixels);
}

TEST(Snapshot, DrawsPointsWhereTheyAre) {
  auto host = std::make_shared<Folder>();
  Context context(1, host);
  Cloud cloud;
  for (int i = 0; i <= 200; ++i)
    for (int k = 0; k <= 200; ++k)
      if (i <= 100 || k <= 100)
        cloud.points.emplace_back(0.02F * static_cast<float>(i), 0.02F * static_cast<float>(k), 0);
  cloud.colours.assign(cloud.size(), {200, 30, 30});
  Snapshot::Params params;
  params.width = params.height = 240;
  params.views = {"top"};
  params.cut_below_top = 0;
  const auto out = Snapshot::run({.cloud = input(cloud)}, params, context);
  const Picture& top = out.pictures.pictures[0];
  EXPECT_EQ(pixel(top, 0.3, 0.7), (Colour{200, 30, 30}));
  EXPECT_EQ(pixel(top, 0.7, 0.3), (Colour{255, 255, 255})) << "the corner of the L is empty";
}

TEST(ContactSheet, PutsEachPictureInItsCell) {
  auto host = std::make_shared<Folder>();
  Context context(1, host);
  const auto plain = [](Colour colour) {
    Picture picture{200, 100, "a", {}};
    for (int i = 0; i < 200 * 100; ++i) picture.pixels.insert(picture.pixels.end(), colour.begin(), colour.end());
    return input(Pictures{{picture}});
  };
  ContactSheet::Params params;
  params.cell_width = 100;
  const auto out = ContactSheet::run({{plain({255, 0, 0}), plain({0, 255, 0}), plain({0, 0, 255})}}, params, context);
  const Picture& sheet = out.sheet.pictures.at(0);
  EXPECT_EQ(pixel(sheet, 0.3, 0.25), (Colour{255, 0, 0}));
  EXPECT_EQ(pixel(sheet, 0.7, 0.25), (Colour{0, 255, 0}));
  EXPECT_EQ(pixel(sheet, 0.3, 0.7), (Colour{0, 0, 255}));
  EXPECT_EQ(pixel(sheet, 0.7, 0.7), (Colour{255, 255, 255}));
  EXPECT_EQ(read_png(host->path_ / "sheet.png").pixels, sheet.pixels);
  EXPECT_THROW(ContactSheet::run({{input(Pictures{})}}, params, context), Error);
}

TEST(Snapshot, SaysWhatIsWrong) {
  auto host = std::make_shared<Folder>();
  Context context(1, host);
  EXPECT_THROW(Snapshot::run({}, {}, context), Error);
  EXPECT_THROW(Snapshot::run({.cloud = input(Cloud{})}, {}, context), Error);
  Snapshot::Params params;
  params.views = {"bottom"};
  EXPECT_THROW(Snapshot::run({.meshes = input(room(Eigen::Vector3d::Zero()))}, params, context), Error);
  params.views = {"top"};
  params.eye = {1, 2, 3};
  EXPECT_THROW(Snapshot::run({.meshes = input(room(Eigen::Vector3d::Zero()))}, params, context), Error);
  EXPECT_TRUE(fs::is_empty(host->path_)) << "no half-written file";
}

}  // namespace
}  // namespace atrium::render::snapshot_test
