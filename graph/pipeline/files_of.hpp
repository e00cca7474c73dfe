#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace atrium {

/// Whether the text has a character that is special in patterns of names: * ? [
bool is_pattern(std::string_view text);

/// The files of a folder, or those that fit a pattern (glob(3)), by name. It is relative to `from`.
std::vector<std::filesystem::path> files_of(const std::filesystem::path& from, const std::string& given);

}  // namespace atrium
