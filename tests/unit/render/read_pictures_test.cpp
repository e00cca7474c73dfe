#include "modules/render/read_pictures.hpp"

#include <gtest/gtest.h>

#include "modules/render/png.hpp"
#include "tests/support/temporary_folder.hpp"

namespace atrium::render::read_pictures_test {
namespace {

Picture grey(int width, int height, std::uint8_t value) {
  return {width, height, "", std::vector<std::uint8_t>(3 * static_cast<std::size_t>(width * height), value)};
}

TEST(ReadPicturesNode, ReadsPicturesInOrderAndFillsInWhatIsMissing) {
  const test::TemporaryFolder folder;
  write_png(grey(4, 3, 10), folder / "a.png");
  write_png(grey(2, 2, 20), folder / "b.png");
  Context context;
  const auto out = ReadPictures::run(
      {{(folder / "none.png").string(), (folder / "a.png").string(), (folder / "b.png").string()}, {"first"}}, context);
  const auto& pictures = out.pictures.pictures;
  ASSERT_EQ(pictures.size(), 3U);
  EXPECT_EQ(pictures[0].caption, "first (no picture)");
  EXPECT_EQ(pictures[0].width, 4);
  EXPECT_EQ(pictures[0].pixels.size(), pictures[1].pixels.size());
  EXPECT_EQ(pictures[1].caption, "a.png");
  EXPECT_EQ(pictures[1].pixels, grey(4, 3, 10).pixels);
  EXPECT_EQ(pictures[2].height, 2);
}

TEST(ReadPicturesNode, APictureThatIsNotWholeIsAnError) {
  const test::TemporaryFolder folder;
  write_png(grey(64, 64, 10), folder / "a.png");
  const std::string whole = test::read_text(folder / "a.png");
  test::write_text(folder / "part.png", whole.substr(0, whole.size() / 2));
  Context context;
  EXPECT_THROW(ReadPictures::run({{(folder / "part.png").string()}, {}}, context), Error);
}

TEST(ReadPicturesNode, SaysWhatIsWrong) {
  const test::TemporaryFolder folder;
  test::write_text(folder / "text.png", "no picture");
  Context context;
  EXPECT_THROW(ReadPictures::run({}, context), Error);
  EXPECT_THROW(ReadPictures::run({{(folder / "none.png").string()}, {}}, context), Error);
  EXPECT_THROW(ReadPictures::run({{(folder / "text.png").string()}, {}}, context), Error);
  EXPECT_THROW(ReadPictures::run({{(folder / "text.png").string()}, {"a", "b"}}, context), Error);
}

}  // namespace
}  // namespace atrium::render::read_pictures_test
