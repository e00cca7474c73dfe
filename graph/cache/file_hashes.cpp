#include "graph/cache/file_hashes.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <fstream>
#include <system_error>
#include <vector>

#include "graph/api/context.hpp"
#include "graph/api/error.hpp"
#include "graph/api/walk.hpp"
#include "graph/cache/blob.hpp"

namespace atrium {
namespace {

namespace fs = std::filesystem;
constexpr std::time_t racy_seconds = 2;

struct stat status_of(const fs::path& file) {
  struct stat info {};
  if (::stat(file.c_str(), &info) != 0)
    throw Error("cannot read " + file.string() + ": " + std::generic_category().message(errno));
  return info;
}

std::string text_of(const struct stat& info) {
  return fmt::format("{}:{}:{}:{}.{:09}:{}.{:09}", info.st_dev, info.st_ino, info.st_size, info.st_mtim.tv_sec,
                     info.st_mtim.tv_nsec, info.st_ctim.tv_sec, info.st_ctim.tv_nsec);
}

std::string hash_of_text(const std::string& text) {
  ContentHash hash;
  hash.bytes(text.data(), text.size());
  return hash.hex();
}

/// All files in a folder and below, by name.
std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder, fs::directory_options::skip_permission_denied))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

bool is_racy(const struct stat& info) {
  return std::time(nullptr) - std::max(info.st_mtim.tv_sec, info.st_ctim.tv_sec) < racy_seconds;
}

}  // namespace

std::string FileHashes::fingerprint(const fs::path& path) {
  const struct stat info = status_of(path);
  if (!S_ISDIR(info.st_mode)) return text_of(info);
  std::string text;
  for (const auto& file : files_in(path)) text += file.string() + " " + text_of(status_of(file)) + "\n";
  return text;
}

std::string FileHashes::of(const fs::path& path) {
  if (!S_ISDIR(status_of(path).st_mode)) return of_file(path);
  std::string text;
  for (const auto& file : files_in(path)) text += file.lexically_relative(path).string() + " " + of_file(file) + "\n";
  return hash_of_text(text);
}

std::string FileHashes::of_file(const fs::path& file) {
  const struct stat before = status_of(file);
  const std::string fingerprint = text_of(before);
  const fs::path remembered = folder_.empty() ? fs::path() : folder_ / hash_of_text(fingerprint);
  {
    const std::lock_guard lock(mutex_);
    if (const auto found = known_.find(fingerprint); found != known_.end()) return found->second;
  }
  std::string hash;
  // The line's first half is the fingerprint itself: a damaged or foreign file is no answer.
  if (std::ifstream in(remembered); !remembered.empty() && in) {
    std::string whose;
    if (in >> whose >> hash && whose == fingerprint && hash.size() == 32 && in.get() == '\n') {
      const std::lock_guard lock(mutex_);
      return known_[fingerprint] = hash;
    }
  }
  hash = hash_of_file(file);
  if (is_racy(before) || text_of(status_of(file)) != fingerprint) return hash;
  if (!remembered.empty()) {
    try {
      AtomicFile out(remembered);
      out.write(fingerprint + " " + hash + "\n");
      out.publish();
    } catch (const Error&) {  // it is computed again next time
    }
  }
  const std::lock_guard lock(mutex_);
  return known_[fingerprint] = hash;
}

}  // namespace atrium
