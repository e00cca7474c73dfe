#include "graph/cache/upkeep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <ctime>

#include "graph/api/context.hpp"
#include "graph/api/error.hpp"
#include "graph/api/files.hpp"
#include "graph/api/folder_lock.hpp"
#include "graph/cache/blob.hpp"
#include "graph/cache/cache_folder.hpp"
#include "graph/cache/file_hashes.hpp"
#include "graph/cache/record.hpp"

namespace atrium {
namespace {

namespace fs = std::filesystem;

/// Whether nobody writes the unfinished file any more. In a shared folder its process may be one of another machine:
/// then the file's age tells.
bool is_abandoned(const CacheEntry& entry) {
  constexpr std::time_t minute = 60;
  constexpr std::time_t day = std::time_t{24} * 3600;
  const auto gone = is_writer_gone(entry.path.filename().string());
  const std::time_t age = std::time(nullptr) - entry.used.tv_sec;
  return gone ? *gone && age > minute : age > day;
}

bool remove_file(const fs::path& file) {
  std::error_code ignored;
  return fs::remove(file, ignored);
}

/// Throws DamagedFile, or another Error if the file cannot be read.
void check(const CacheEntry& entry) {
  const fs::path& file = entry.path;
  const auto refuse_unless = [&](bool good) {
    if (!good) throw DamagedFile(file.string() + " is damaged");
  };
  if (entry.kind == CacheKind::values) {
    check_blob(file);
  } else if (entry.kind == CacheKind::files) {
    refuse_unless(hash_of_file(file) == file.filename());
  } else if (entry.kind == CacheKind::hashes) {
    refuse_unless(FileHashes::is_whole(read_text(file), file.filename().string()));
  } else {
    const auto record = read_record(read_text(file));
    refuse_unless(record && record->key == file.filename() && record->type() == file.parent_path().filename());
  }
}

/// Nothing if the file is whole.
std::optional<CacheProblem> problem_of(const CacheEntry& entry) {
  try {
    check(entry);
    return std::nullopt;
  } catch (const DamagedFile& damage) {
    return CacheProblem{damage.what(), remove_file(entry.path)};
  } catch (const std::exception& problem) {
    return CacheProblem{problem.what(), false};
  }
}

}  // namespace

CacheContents::Share CacheContents::all() const {
  Share all;
  for (const Share* share : {&records, &values, &files, &hashes}) {
    all.files += share->files;
    all.bytes += share->bytes;
  }
  return all;
}

CacheContents contents_of(const CachePlaces& places) {
  CacheContents contents;
  CacheContents::Share* const shares[] = {&contents.records, &contents.values, &contents.files, &contents.hashes};
  for_each_entry(places, [&](const CacheEntry& entry) {
    CacheContents::Share& share = *shares[static_cast<std::size_t>(entry.kind)];
    ++share.files;
    share.bytes += entry.bytes;
    if (entry.kind == CacheKind::records && !entry.unfinished)
      ++contents.of_type[entry.path.parent_path().filename().string()];
  });
  return contents;
}

std::optional<Removed> collect_garbage(const CachePlaces& places, std::uint64_t most_bytes) {
  check_cache_folder(places);
  const FolderLock lock(places.folder, FolderLock::Kind::alone);
  if (!lock.held()) return std::nullopt;
  Removed removed;
  std::vector<CacheEntry> entries;
  const auto remove = [&](const CacheEntry& entry) {
    if (!remove_file(entry.path)) return;
    ++removed.files;
    removed.bytes += entry.bytes;
    removed.left -= entry.bytes;
  };
  for_each_entry(places, [&](const CacheEntry& entry) {
    removed.left += entry.bytes;
    if (!entry.unfinished)
      entries.push_back(entry);
    else if (is_abandoned(entry))
      remove(entry);
  });
  std::sort(entries.begin(), entries.end(), [](const CacheEntry& a, const CacheEntry& b) {
    return std::tie(a.used.tv_sec, a.used.tv_nsec, a.path) < std::tie(b.used.tv_sec, b.used.tv_nsec, b.path);
  });
  for (const CacheEntry& entry : entries) {
    if (removed.left <= most_bytes) break;
    remove(entry);
  }
  AtomicFile(places.folder / ".collected").publish();  // never through a link that somebody has put there
  return removed;
}

std::vector<CacheProblem> verify_cache(const CachePlaces& places, std::uint64_t& checked) {
  check_cache_folder(places);
  std::vector<CacheProblem> problems;
  for_each_entry(places, [&](const CacheEntry& entry) {
    if (entry.unfinished) return;
    ++checked;
    auto problem = problem_of(entry);
    if (!problem || (!problem->removed && !fs::exists(entry.path))) return;  // removed meanwhile by another process
    problems.push_back(std::move(*problem));
  });
  return problems;
}

std::uint64_t read_size(const std::string& text) {
  static constexpr std::array<std::pair<std::string_view, double>, 10> units{{{"", 1},
                                                                              {"B", 1},
                                                                              {"kB", 1e3},
                                                                              {"MB", 1e6},
                                                                              {"GB", 1e9},
                                                                              {"TB", 1e12},
                                                                              {"KiB", 0x1p10},
                                                                              {"MiB", 0x1p20},
                                                                              {"GiB", 0x1p30},
                                                                              {"TiB", 0x1p40}}};
  double number = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
  std::string_view unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
  while (unit.starts_with(' ')) unit.remove_prefix(1);
  for (const auto& [name, factor] : units)
    if (problem == std::errc{} && unit == name && number >= 0 && number * factor < 1e18)
      return static_cast<std::uint64_t>(number * factor);
  throw Error(fmt::format("'{}' is no size", text),
              "a number of bytes, or one with kB, MB, GB, TB, KiB, MiB, GiB, TiB");
}

std::string size_text(std::uint64_t bytes) {
  static constexpr std::array<const char*, 5> units{"B", "kB", "MB", "GB", "TB"};
  auto number = static_cast<double>(bytes);
  std::size_t unit = 0;
  while (number >= 999.5 && unit + 1 < units.size()) {
    number /= 1000;
    ++unit;
  }
  return unit == 0 ? fmt::format("{} B", bytes) : fmt::format("{:.3g} {}", number, units[unit]);
}

}  // namespace atrium
