#include "graph/cache/cache_folder.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <cctype>
#include <string_view>

#include "graph/api/context.hpp"
#include "graph/api/error.hpp"
#include "graph/api/files.hpp"

namespace atrium {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view mark_name = "CACHEDIR.TAG";
// The first line is that of the Cache Directory Tagging Specification: other programs' caches have it, too.
constexpr std::string_view mark =
    "Signature: 8a477f597d28d172789f06886806bc55\n"
    "# The cache of Atrium: results of earlier runs. All of it can be deleted at any time.\n";

constexpr std::string_view folders[] = {"records", "values", "files", "hashes"};

bool is_hex(std::string_view text, std::size_t size) {
  return text.size() == size && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

/// "module.name"
bool is_type(std::string_view text) {
  const auto good = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '.';
  };
  const std::size_t dot = text.find('.');
  return dot != 0 && dot != std::string_view::npos && std::all_of(text.begin(), text.end(), good);
}

bool is_folder_of(CacheKind kind, std::string_view name) {
  return kind == CacheKind::records ? is_type(name) : is_hex(name, 2);
}

/// Whether a file of that name may stand in the kind's subfolder `folder`.
bool is_file_of(CacheKind kind, std::string_view folder, std::string_view name) {
  constexpr std::size_t digits = 32;
  if (kind == CacheKind::values)
    return name.size() == digits + 17 && name.starts_with(folder) && is_hex(name.substr(0, digits), digits) &&
           name[digits] == '-' && is_hex(name.substr(digits + 1), 16);
  return is_hex(name, digits) && (kind != CacheKind::files || name.starts_with(folder));
}

/// Calls see(path) for what a folder holds; nothing if it is not there.
template <class See>
void for_each_in(const fs::path& folder, See see) {
  std::error_code error;
  fs::directory_iterator it(folder, error);
  for (const fs::directory_iterator end; !error && it != end; it.increment(error)) see(it->path());
  if (error && error != std::errc::no_such_file_or_directory)
    throw Error("cannot read the folder " + folder.string() + ": " + error.message());
}

void see_file(const fs::path& file, CacheKind kind, std::string_view folder,
              const std::function<void(const CacheEntry&)>& see) {
  const std::string name = file.filename().string();
  const std::string_view whole = name_of_unfinished(name);
  if (!is_file_of(kind, folder, whole.empty() ? name : whole)) return;
  struct stat info {};
  if (::lstat(file.c_str(), &info) != 0 || !S_ISREG(info.st_mode)) return;
  see({file, kind, !whole.empty(), static_cast<std::uint64_t>(info.st_blocks) * 512, info.st_mtim});
}

/// But for what killed processes left of files that they were writing.
bool holds_nothing(const fs::path& folder) {
  try {
    return holds_only_unfinished(folder);
  } catch (const fs::filesystem_error& error) {
    throw Error("cannot read the folder " + folder.string() + ": " + error.code().message());
  }
}

}  // namespace

bool is_cache_folder(const CachePlaces& places) {
  const fs::path file = places.folder / mark_name;
  std::error_code ignored;
  return fs::is_regular_file(file, ignored) && read_text(file).starts_with(mark);
}

void make_cache_folder(const CachePlaces& places) {
  make_folder(places.folder);
  if (!is_cache_folder(places)) {
    if (!holds_nothing(places.folder) && !is_cache_folder(places))  // another process may have made it just now
      throw NoCacheFolder(places.folder.string() + " is not empty and is not a cache",
                          "choose another folder with --cache, or empty it");
    AtomicFile file(places.folder / mark_name);
    file.write(std::string(mark));
    file.publish();
  }
  make_folder(places.hashes());
}

void check_cache_folder(const CachePlaces& places) {
  std::error_code ignored;
  if (!fs::exists(places.folder, ignored)) throw NoCacheFolder("there is no cache in " + places.folder.string());
  if (!is_cache_folder(places))
    throw NoCacheFolder(places.folder.string() + " is not the folder of a cache", "it lacks the file CACHEDIR.TAG");
}

void for_each_entry(const CachePlaces& places, CacheKind kind, const std::function<void(const CacheEntry&)>& see) {
  const fs::path top = places.folder / folders[static_cast<std::size_t>(kind)];
  for_each_in(top, [&](const fs::path& path) {
    if (kind == CacheKind::hashes) return see_file(path, kind, {}, see);
    std::error_code ignored;
    const std::string name = path.filename().string();
    if (!is_folder_of(kind, name) || fs::symlink_status(path, ignored).type() != fs::file_type::directory) return;
    for_each_in(path, [&](const fs::path& file) { see_file(file, kind, name, see); });
  });
}

void for_each_entry(const CachePlaces& places, const std::function<void(const CacheEntry&)>& see) {
  for (const auto kind : {CacheKind::records, CacheKind::values, CacheKind::files, CacheKind::hashes})
    for_each_entry(places, kind, see);
}

}  // namespace atrium
