#pragma once
#include <filesystem>
#include <string>

namespace atrium {

/// Of a path at which no file can be found: "is a link to …, which is not there" if it is a link; else empty.
inline std::string broken_link(const std::filesystem::path& path) {
  namespace fs = std::filesystem;
  std::error_code error, ignored;
  if (!fs::is_symlink(fs::symlink_status(path, ignored)) || fs::exists(path, error)) return {};
  const bool circle = error == std::errc::too_many_symbolic_link_levels;
  return "is a link to " + fs::read_symlink(path, ignored).string() +
         (circle ? ", which leads round in a circle" : ", which is not there");
}

}  // namespace atrium
