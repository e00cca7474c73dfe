#include "graph/cache/file_hashes.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <ctime>
#include <system_error>
#include <vector>

#include "graph/api/context.hpp"
#include "graph/api/error.hpp"
#include "graph/api/files.hpp"
#include "graph/api/walk.hpp"
#include "graph/cache/blob.hpp"
#include "graph/cache/places.hpp"

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

/// Without the device: machines that share a file system number them differently.
std::string text_of(const struct stat& info) {
  return fmt::format("{}:{}:{}.{:09}:{}.{:09}", info.st_ino, info.st_size, info.st_mtim.tv_sec, info.st_mtim.tv_nsec,
                     info.st_ctim.tv_sec, info.st_ctim.tv_nsec);
}

std::string text_with_device(const struct stat& info) { return fmt::format("{}:{}", info.st_dev, text_of(info)); }

/// Adds all files in a folder and below. Links are followed, as a node that reads the folder does.
void add_files_in(const fs::path& folder, int depth, std::vector<fs::path>& files) {
  constexpr int deepest = 40;  // as many links as the system follows
  std::error_code error;
  fs::directory_iterator it(folder, fs::directory_options::skip_permission_denied, error);
  if (depth > deepest) error = std::make_error_code(std::errc::too_many_symbolic_link_levels);
  for (const fs::directory_iterator end; !error && it != end; it.increment(error)) {
    const fs::file_status status = it->status(error);
    if (error == std::errc::no_such_file_or_directory) error.clear();  // a link to nothing, or it has just gone
    if (error) break;
    if (status.type() == fs::file_type::regular) files.push_back(it->path());
    if (status.type() == fs::file_type::directory) add_files_in(it->path(), depth + 1, files);
  }
  if (error) throw Error("cannot read the folder " + folder.string() + ": " + error.message());
}

/// All files in a folder and below, by name. Throws Error.
std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  add_files_in(folder, 0, files);
  std::sort(files.begin(), files.end());
  return files;
}

/// What is remembered of a file: fingerprint, its hash, and the hash of both.
std::string line_of(const std::string& fingerprint, const std::string& hash) {
  const std::string text = fingerprint + " " + hash;
  return text + " " + hash_of_text(text) + "\n";
}

/// The hash in a remembered line; empty if the line is not that of this fingerprint, or is damaged.
std::string hash_in(const std::string& text, const std::string& fingerprint) {
  constexpr std::size_t digits = 32;
  if (!text.starts_with(fingerprint + " ")) return {};
  std::string hash = text.substr(fingerprint.size() + 1, digits);
  return text == line_of(fingerprint, hash) ? hash : std::string();
}

bool is_racy(const struct stat& info) {
  return std::time(nullptr) - std::max(info.st_mtim.tv_sec, info.st_ctim.tv_sec) < racy_seconds;
}

/// Empty if it cannot be read.
std::string remembered_text(const fs::path& file) {
  try {
    return read_text(file);
  } catch (const Error&) {
    return {};
  }
}

/// "%20" is a blank.
std::string without_percents(std::string_view uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned code = 0;
    const bool coded =
        uri[i] == '%' && i + 2 < uri.size() && std::from_chars(&uri[i + 1], &uri[i] + 3, code, 16).ptr == &uri[i] + 3;
    text += coded ? static_cast<char>(code) : uri[i];
    i += coded ? 2 : 0;
  }
  return text;
}

/// A .gltf names files that hold its numbers and images: those that are there. Empty for all other files.
std::vector<fs::path> named_by(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  std::vector<fs::path> named;
  if (extension != ".gltf") return named;
  const std::string text = remembered_text(file);
  constexpr std::string_view key = "\"uri\"", blanks = " \t\r\n";
  for (std::size_t at = text.find(key); at != std::string::npos; at = text.find(key, at)) {
    at = text.find_first_not_of(blanks, at + key.size());
    if (at == std::string::npos || text[at] != ':') continue;
    at = text.find_first_not_of(blanks, at + 1);
    if (at == std::string::npos || text[at] != '"') continue;
    const std::size_t end = std::min(text.find('"', at + 1), text.size());
    const std::string_view uri = std::string_view(text).substr(at + 1, end - at - 1);
    std::error_code ignored;
    if (!uri.starts_with("data:"))
      if (fs::path place = file.parent_path() / without_percents(uri); fs::is_regular_file(place, ignored))
        named.push_back(std::move(place));
  }
  return named;
}

}  // namespace

std::string FileHashes::fingerprint(const fs::path& path) {
  const struct stat info = status_of(path);
  std::string text;
  if (!S_ISDIR(info.st_mode)) {
    text = text_of(info);
    for (const auto& file : named_by(path)) text += " " + text_of(status_of(file));
    return text;
  }
  for (const auto& file : files_in(path)) text += file.string() + " " + text_of(status_of(file)) + "\n";
  return text;
}

std::string FileHashes::of(const fs::path& path) {
  std::string text;
  if (!S_ISDIR(status_of(path).st_mode)) {
    const auto named = named_by(path);
    if (named.empty()) return of_file(path);
    text = of_file(path);
    for (const auto& file : named) text += " " + of_file(file);
    return hash_of_text(text);
  }
  for (const auto& file : files_in(path)) text += file.lexically_relative(path).string() + " " + of_file(file) + "\n";
  return hash_of_text(text);
}

std::string FileHashes::of_file(const fs::path& file) {
  const struct stat before = status_of(file);
  // To open a pipe is to take part in it.
  if (!S_ISREG(before.st_mode)) throw Error(file.string() + " is no regular file: it has no hash");
  const bool racy = is_racy(before);  // before it is read, which may take longer than that
  const std::string fingerprint = text_with_device(before);
  const fs::path remembered = folder_.empty() ? fs::path() : folder_ / hash_of_text(fingerprint);
  {
    const std::lock_guard lock(mutex_);
    if (const auto found = known_.find(fingerprint); found != known_.end()) return found->second;
  }
  std::string hash;
  if (!remembered.empty()) hash = hash_in(remembered_text(remembered), fingerprint);
  if (!hash.empty()) {
    const std::lock_guard lock(mutex_);
    return known_[fingerprint] = hash;
  }
  hash = hash_of_file(file);
  if (racy || text_with_device(status_of(file)) != fingerprint) return hash;
  if (!remembered.empty()) {
    try {
      AtomicFile out(remembered);
      out.write(line_of(fingerprint, hash));
      out.publish();
    } catch (const Error&) {  // it is computed again next time
    }
  }
  const std::lock_guard lock(mutex_);
  return known_[fingerprint] = hash;
}

bool FileHashes::is_whole(const std::string& text, const std::string& name) {
  const std::string fingerprint = text.substr(0, text.find(' '));
  return !hash_in(text, fingerprint).empty() && hash_of_text(fingerprint) == name;
}

}  // namespace atrium
