#include "graph/cache/places.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <cstdlib>

namespace atrium {

std::filesystem::path CachePlaces::value(const FlatType& type, const std::string& hash) const {
  return folder / "values" / hash.substr(0, 2) / fmt::format("{}-{:016x}", hash, type.layout);
}

std::filesystem::path default_cache_folder() {
  const auto variable = [](const char* name) -> std::string {
    const char* value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe)
    return value == nullptr ? "" : value;
  };
  if (const std::string own = variable("ATRIUM_CACHE"); !own.empty()) return own == "off" ? "" : own;
  if (const std::string cache = variable("XDG_CACHE_HOME"); cache.starts_with('/')) return cache + "/atrium";
  const std::string home = variable("HOME");
  return home.empty() ? "" : home + "/.cache/atrium";
}

bool is_content_hash(std::string_view text) {
  return text.size() == 32 && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

void touch(const std::filesystem::path& file) { ::utimensat(AT_FDCWD, file.c_str(), nullptr, 0); }

}  // namespace atrium
