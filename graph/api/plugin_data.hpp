#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace atrium {

/// A folder of files that came with Atrium or with a plugin: share/atrium/NAME or share/NAME, beside one of the folders
/// in which the library lies, as built or as installed. Empty if there is none.
std::filesystem::path data_folder(const std::filesystem::path& library, const std::string& name);

/// All files in the folders that a plugin's nodes read besides what their parameters name (DATA of atrium_add_plugin():
/// a file beside the library, of the same name with .data, has one NAME per line). What is computed depends on them.
std::vector<std::filesystem::path> plugin_data_files(const std::filesystem::path& library);

}  // namespace atrium
