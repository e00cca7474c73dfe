#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

namespace atrium::report {

/// 8-bit RGBA, row by row from the top.
struct Picture {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> pixels;
};

/// Reads a PNG file. Throws Error.
Picture read_picture(const std::filesystem::path& file);

/// Writes a PNG file: beside, then renamed; its folder is made. Throws Error.
void write_picture(const std::filesystem::path& file, const Picture& picture);

struct PixelDifference {
  bool comparable = false;      ///< both have the same size
  std::uint64_t different = 0;  ///< pixels that are not the same
  std::uint64_t pixels = 0;
  int largest = 0;  ///< difference of a channel, of 255
};
PixelDifference compare(const Picture& a, const Picture& b);

/// The first picture pale and grey, with what differs in vermilion. Both must have the same size.
Picture difference_picture(const Picture& a, const Picture& b);

}  // namespace atrium::report
