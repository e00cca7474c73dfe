// Reading pictures: of every kind, and what is damaged.
#include "modules/render/png.hpp"

#include <gtest/gtest.h>
#include <png.h>

#include "graph/api/error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace atrium::render::png_test {
namespace {

/// Writes 2 × 2 pixels with libpng's simplified interface.
void write(const std::filesystem::path& path, png_uint_32 format, const void* pixels) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = image.height = 2;
  image.format = format;
  ASSERT_NE(png_image_write_to_file(&image, path.c_str(), 0, pixels, 0, nullptr), 0);
}

std::string problem(const std::filesystem::path& path) {
  try {
    read_png(path);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Png, ComesBackAsItWasWritten) {
  const test::TemporaryFolder folder;
  Picture picture{3, 2, "", {}};
  for (std::uint8_t i = 0; i < 18; ++i) picture.pixels.push_back(static_cast<std::uint8_t>(13 * i));
  write_png(picture, folder / "a.png");
  const Picture back = read_png(folder / "a.png");
  EXPECT_EQ(back.width, 3);
  EXPECT_EQ(back.height, 2);
  EXPECT_EQ(back.pixels, picture.pixels);
}

TEST(Png, OtherKindsAreConverted) {
  const test::TemporaryFolder folder;
  const std::array<std::uint8_t, 4> grey{0, 100, 200, 255};
  write(folder / "grey.png", PNG_FORMAT_GRAY, grey.data());
  EXPECT_EQ(read_png(folder / "grey.png").pixels,
            (std::vector<std::uint8_t>{0, 0, 0, 100, 100, 100, 200, 200, 200, 255, 255, 255}));
  const std::array<std::uint8_t, 16> clear{255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 0, 9, 9, 9, 255};
  write(folder / "clear.png", PNG_FORMAT_RGBA, clear.data());
  EXPECT_EQ(read_png(folder / "clear.png").pixels,
            (std::vector<std::uint8_t>{255, 0, 0, 0, 255, 0, 255, 255, 255, 9, 9, 9}));
  std::array<std::uint16_t, 12> deep{};
  deep[0] = deep[4] = deep[11] = 65535;
  write(folder / "deep.png", PNG_FORMAT_LINEAR_RGB, deep.data());
  EXPECT_EQ(read_png(folder / "deep.png").pixels,
            (std::vector<std::uint8_t>{255, 0, 0, 0, 255, 0, 0, 0, 0, 0, 0, 255}));
  // Half of the way up, of a file that does not say how its values are meant: as those of 8 bits are.
  deep.fill(0x8080);
  write(folder / "deep.png", PNG_FORMAT_LINEAR_RGB, deep.data());
  std::string bytes = test::read_text(folder / "deep.png");
  for (const auto& [chunk, size] : {std::pair{"gAMA", 16}, std::pair{"cHRM", 44}})
    if (const auto at = bytes.find(chunk); at != std::string::npos) bytes.erase(at - 4, static_cast<std::size_t>(size));
  test::write_text(folder / "plain.png", bytes);
  EXPECT_EQ(read_png(folder / "plain.png").pixels, std::vector<std::uint8_t>(12, 128));
}

TEST(Png, WhereverItIsCutItIsAnError) {
  const test::TemporaryFolder folder;
  Picture picture{60, 40, "", {}};
  for (std::size_t i = 0; i < 60UL * 40 * 3; ++i) picture.pixels.push_back(static_cast<std::uint8_t>(i * i * 31 >> 7));
  write_png(picture, folder / "whole.png");
  const std::string whole = test::read_text(folder / "whole.png");
  ASSERT_GT(whole.size(), 1000U);
  constexpr std::size_t end_chunk = 12;
  for (std::size_t size = 0; size < whole.size() - end_chunk - 8; size += size < 120 ? 1 : 97) {
    test::write_text(folder / "part.png", whole.substr(0, size));
    const std::string words = problem(folder / "part.png");
    EXPECT_NE(words.find("part.png"), std::string::npos) << "of " << size << " bytes: " << words;
    EXPECT_NE(words.find(size < 8 ? "not a PNG" : "damaged or not whole"), std::string::npos) << size << ": " << words;
  }
  std::string damaged = whole;
  damaged[whole.size() / 2] = static_cast<char>(damaged[whole.size() / 2] ^ 0x10);
  test::write_text(folder / "damaged.png", damaged);
  EXPECT_NE(problem(folder / "damaged.png").find("damaged"), std::string::npos);
}

TEST(Png, AHugeOneIsRefusedBeforeItIsRead) {
  const test::TemporaryFolder folder;
  Picture line{1, 1, "", {1, 2, 3}};
  write_png(line, folder / "a.png");
  std::string bytes = test::read_text(folder / "a.png");
  // A header that promises 200 000 × 200 000 pixels, with its checksum.
  std::string header = "IHDR";
  for (int i = 0; i < 2; ++i) header += std::string("\x00\x03\x0d\x40", 4);
  header += bytes.substr(24, 5);
  std::uint32_t crc = 0xffffffff;
  for (const char c : header) {
    crc ^= static_cast<std::uint8_t>(c);
    for (int k = 0; k < 8; ++k) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xedb88320U : 0U);
  }
  crc = ~crc;
  for (int shift = 24; shift >= 0; shift -= 8) header += static_cast<char>(crc >> shift & 0xffU);
  bytes.replace(12, header.size(), header);
  test::write_text(folder / "huge.png", bytes);
  const std::string words = problem(folder / "huge.png");
  EXPECT_NE(words.find("too large: 200000 x 200000"), std::string::npos) << words;
}

TEST(Png, WhatIsNoPngOrNotThereIsAnError) {
  const test::TemporaryFolder folder;
  EXPECT_NE(problem(folder / "none.png").find("cannot read"), std::string::npos);
  test::write_text(folder / "text.png", "not a picture at all");
  EXPECT_NE(problem(folder / "text.png").find("not a PNG"), std::string::npos);
  EXPECT_NO_THROW(require_png_name("a/b.png"));
  for (const char* name : {"a.jpg", "a", "a.png.txt", ".png", ""}) EXPECT_THROW(require_png_name(name), Error) << name;
}

}  // namespace
}  // namespace atrium::render::png_test
