#pragma once
#include <cstdint>
#include <vector>

namespace atrium::io {

/// A PNG file (8-bit RGB, marked as sRGB) of width · height · 3 bytes, rows from the top. Throws Error if it cannot be.
std::vector<std::uint8_t> encode_png(std::int32_t width, std::int32_t height, const std::vector<std::uint8_t>& pixels);

}  // namespace atrium::io
