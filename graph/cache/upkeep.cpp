#include "graph/cache/upkeep.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <fstream>
#include <sstream>

#include "graph/api/error.hpp"
#include "graph/cache/blob.hpp"
#include "graph/cache/record.hpp"

namespace atrium {
namespace {

namespace fs = std::filesystem;

struct Entry {
  fs::path path;
  std::uint64_t bytes = 0;
  timespec used{};
};

/// Calls see(entry) for every file of the cache. What goes meanwhile is left out.
template <class See>
void for_each_file(const fs::path& folder, See see) {
  std::error_code ignored;
  for (fs::recursive_directory_iterator it(folder, ignored), end; it != end; it.increment(ignored)) {
    struct stat info {};
    if (::lstat(it->path().c_str(), &info) == 0 && S_ISREG(info.st_mode))
      see(Entry{it->path(), static_cast<std::uint64_t>(info.st_blocks) * 512, info.st_mtim});
  }
}

bool is_unfinished(const fs::path& file) {
  return file.extension() == ".part" && file.filename().string().starts_with(".");
}

/// Whether the process that was writing the file (".NAME.PID-NUMBER.part") is gone. In a shared folder it may be one of
/// another machine: then the file's age tells.
bool is_abandoned(const Entry& entry) {
  const std::string name = entry.path.stem().string();
  const std::size_t dot = name.rfind('.');
  pid_t process = 0;
  std::from_chars(name.data() + dot + 1, name.data() + name.size(), process);
  const bool gone = process <= 0 || (::kill(process, 0) != 0 && errno == ESRCH);
  return gone && std::time(nullptr) - entry.used.tv_sec > 60;
}

bool remove_file(const fs::path& file) {
  std::error_code ignored;
  return fs::remove(file, ignored);
}

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// "" if the file is whole.
std::string problem_of(const CachePlaces& places, const fs::path& file) {
  const std::string kind = file.lexically_relative(places.folder).begin()->string();
  try {
    if (kind == "values") {
      check_blob(file);
    } else if (kind == "files") {
      if (hash_of_file(file) != file.filename()) return file.string() + " is damaged";
    } else if (kind == "records") {
      const auto record = read_record(text_of(file));
      if (!record || record->key != file.filename() || record->type() != file.parent_path().filename())
        return file.string() + " is damaged";
    }
  } catch (const Error& error) {
    return error.what();
  }
  return {};
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
  const auto add = [](CacheContents::Share& share, const Entry& entry) {
    ++share.files;
    share.bytes += entry.bytes;
  };
  for_each_file(places.folder / "values", [&](const Entry& entry) { add(contents.values, entry); });
  for_each_file(places.folder / "files", [&](const Entry& entry) { add(contents.files, entry); });
  for_each_file(places.hashes(), [&](const Entry& entry) { add(contents.hashes, entry); });
  for_each_file(places.folder / "records", [&](const Entry& entry) {
    add(contents.records, entry);
    if (!is_unfinished(entry.path)) ++contents.of_type[entry.path.parent_path().filename().string()];
  });
  return contents;
}

Removed collect_garbage(const CachePlaces& places, std::uint64_t most_bytes) {
  Removed removed;
  const int lock = ::open(places.folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock < 0) return removed;
  if (::flock(lock, LOCK_EX | LOCK_NB) == 0) {
    std::vector<Entry> entries;
    const auto remove = [&](const Entry& entry) {
      if (!remove_file(entry.path)) return;
      ++removed.files;
      removed.bytes += entry.bytes;
      removed.left -= entry.bytes;
    };
    for_each_file(places.folder, [&](Entry entry) {
      if (entry.path.filename() == ".collected") return;
      removed.left += entry.bytes;
      if (!is_unfinished(entry.path))
        entries.push_back(std::move(entry));
      else if (is_abandoned(entry))
        remove(entry);
    });
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
      return std::tie(a.used.tv_sec, a.used.tv_nsec, a.path) < std::tie(b.used.tv_sec, b.used.tv_nsec, b.path);
    });
    for (const Entry& entry : entries) {
      if (removed.left <= most_bytes) break;
      remove(entry);
    }
    std::ofstream(places.folder / ".collected") << "";
  }
  ::close(lock);
  return removed;
}

std::vector<std::string> verify_cache(const CachePlaces& places, std::uint64_t& checked) {
  std::vector<std::string> problems;
  for_each_file(places.folder, [&](const Entry& entry) {
    if (is_unfinished(entry.path) || entry.path.parent_path() == places.folder) return;
    ++checked;
    std::string problem = problem_of(places, entry.path);
    if (problem.empty() || !fs::exists(entry.path)) return;
    remove_file(entry.path);
    problems.push_back(std::move(problem));
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
