#pragma once
#include <filesystem>
#include <string>

namespace atrium {

/// All bytes of a file. Throws Error (the path and the system's reason) if it cannot be read to its end.
std::string read_text(const std::filesystem::path& file);

/// Makes the folder and those above it; nothing if it is there. Throws Error with the system's reason.
void make_folder(const std::filesystem::path& folder);

}  // namespace atrium
