#include "graph/pipeline/files_of.hpp"

#include <glob.h>

#include <algorithm>

namespace atrium {

bool is_pattern(std::string_view text) { return text.find_first_of("*?[") != std::string_view::npos; }

std::vector<std::filesystem::path> files_of(const std::filesystem::path& from, const std::string& given) {
  std::vector<std::filesystem::path> files;
  std::error_code ignored;
  if (std::filesystem::is_directory(from / given, ignored)) {
    for (const auto& entry : std::filesystem::directory_iterator(from / given, ignored))
      if (entry.is_regular_file(ignored) && !entry.path().filename().string().starts_with('.'))
        files.push_back(entry.path());
  } else {
    std::string pattern;
    if (!std::filesystem::path(given).is_absolute()) {
      for (const char c : from.string())
        pattern += (std::string_view("*?[\\").find(c) != std::string_view::npos ? "\\" : "") + std::string(1, c);
      pattern += "/";
    }
    pattern += given;
    glob_t found{};
    if (::glob(pattern.c_str(), 0, nullptr, &found) == 0) files.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
    ::globfree(&found);
  }
  for (auto& file : files) file = file.lexically_normal();
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace atrium
