#pragma once
#include <png.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>

#include "tests/support/lacking.hpp"

namespace atrium::test {

/// Pixels of a drawing, row by row: red, green, blue, opacity.
struct SvgDrawing {
  std::uint32_t width = 0, height = 0;
  std::vector<std::array<std::uint8_t, 4>> pixels;

  /// How many pixels have this colour, 0xRRGGBB, and are opaque.
  std::size_t count(std::uint32_t colour) const {
    const std::array<std::uint8_t, 4> wanted{static_cast<std::uint8_t>(colour >> 16),
                                             static_cast<std::uint8_t>(colour >> 8 & 0xFF),
                                             static_cast<std::uint8_t>(colour & 0xFF), 255};
    return static_cast<std::size_t>(std::count(pixels.begin(), pixels.end(), wanted));
  }
  /// Share of the pixels that differ from the first one, the paper's corner.
  double ink() const {
    if (pixels.empty()) return 0;
    const auto paper = std::count(pixels.begin(), pixels.end(), pixels.front());
    return 1 - static_cast<double>(paper) / static_cast<double>(pixels.size());
  }
};

inline SvgDrawing read_drawing(const std::filesystem::path& png) {
  SvgDrawing drawing;
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&image, png.c_str()) == 0) {
    ADD_FAILURE() << png << ": " << image.message;
    return drawing;
  }
  image.format = PNG_FORMAT_RGBA;
  drawing.width = image.width;
  drawing.height = image.height;
  drawing.pixels.resize(std::size_t{image.width} * image.height);
  if (png_image_finish_read(&image, nullptr, drawing.pixels.data(), 0, nullptr) == 0)
    ADD_FAILURE() << png << ": " << image.message;
  return drawing;
}

/// What rsvg-convert draws of an SVG file that xmllint reads first, at `scale` dots an inch. The test fails where
/// either has a complaint.
inline SvgDrawing drawn(const std::filesystem::path& svg, int scale = 96) {
  const auto expect_silence = [&](const std::vector<std::string>& command) {
    const auto result = run_process(command);
    EXPECT_EQ(result.exit_code, 0) << command[0] << " " << svg;
    EXPECT_EQ(result.err + result.out, "") << command[0] << " " << svg;
  };
  std::filesystem::path png = svg;
  png += ".png";
  const std::string dots = std::to_string(scale);
  expect_silence({"xmllint", "--noout", "--nonet", svg.string()});
  expect_silence({"rsvg-convert", "-d", dots, "-p", dots, "-o", png.string(), svg.string()});
  const SvgDrawing drawing = read_drawing(png);
  std::filesystem::remove(png);
  return drawing;
}

}  // namespace atrium::test

#define ATRIUM_SKIP_WITHOUT_SVG_READERS()                                                                   \
  do {                                                                                                      \
    if (!::atrium::test::has_program("xmllint")) ATRIUM_SKIP_LACKING("libxml2-utils is not installed");     \
    if (!::atrium::test::has_program("rsvg-convert")) ATRIUM_SKIP_LACKING("librsvg2-bin is not installed"); \
  } while (false)
