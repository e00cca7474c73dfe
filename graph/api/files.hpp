#pragma once
#include <filesystem>
#include <string>

namespace atrium {

/// All bytes of a file. Throws Error (the path and the system's reason) if it cannot be read to its end.
std::string read_text(const std::filesystem::path& file);

}  // namespace atrium
