#pragma once
#include <filesystem>

#include "modules/types/picture.hpp"

namespace atrium::render {

/// Writes a PNG (beside, then renamed). Throws Error with the path.
void write_png(const Picture& picture, const std::filesystem::path& path);

/// Reads one back, as written by write_png. Throws Error.
Picture read_png(const std::filesystem::path& path);

}  // namespace atrium::render
