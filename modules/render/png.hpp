#pragma once
#include <cstdint>
#include <filesystem>

#include "modules/types/picture.hpp"

namespace atrium::render {

/// A picture of more pixels is neither read nor put together.
inline constexpr std::int64_t most_pixels = 100'000'000;

/// Throws Error if the name of a picture's file does not end in ".png".
void require_png_name(const std::filesystem::path& path);

/// Writes a PNG (beside, then renamed). Throws Error with the path.
void write_png(const Picture& picture, const std::filesystem::path& path);

/// Reads a PNG of any kind: grey ones, those with a palette and those of 16 bits are converted, transparent ones are
/// laid on white. Throws Error if it is no PNG, damaged, not whole or of more than `most_pixels`.
Picture read_png(const std::filesystem::path& path);

}  // namespace atrium::render
