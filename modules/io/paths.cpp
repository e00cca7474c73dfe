#include "modules/io/paths.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace atrium::io {

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension;
}

}  // namespace atrium::io
