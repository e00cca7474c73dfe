#include "graph/api/plugin_data.hpp"

#include <algorithm>
#include <fstream>

#include "graph/api/error.hpp"

namespace atrium {

namespace fs = std::filesystem;

fs::path data_folder(const fs::path& library, const std::string& name) {
  std::error_code ignored;
  fs::path above = fs::weakly_canonical(library, ignored);
  while (above.has_relative_path()) {
    above = above.parent_path();
    for (const char* below : {"share/atrium", "share"})
      if (fs::is_directory(above / below / name, ignored)) return above / below / name;
  }
  return {};
}

std::vector<fs::path> plugin_data_files(const fs::path& library) {
  std::vector<fs::path> files;
  std::ifstream list(fs::path(library).replace_extension(".data"));
  for (std::string name; std::getline(list, name);) {
    std::error_code ignored;
    const fs::path folder = data_folder(library, name);
    if (name.empty() || folder.empty()) continue;
    fs::recursive_directory_iterator it(folder, ignored);
    for (const fs::recursive_directory_iterator end; !ignored && it != end; it.increment(ignored))
      if (std::error_code unknown; it->is_regular_file(unknown)) files.push_back(it->path());
  }
  if (list.bad()) throw Error("cannot read the list of the files that belong to " + library.string());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace atrium
