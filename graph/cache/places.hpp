#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "graph/api/error.hpp"
#include "graph/api/flat.hpp"

namespace atrium {

/// Where things stand in the cache's folder:
///
///   records/TYPE/KEY          what a node of that key did (record.hpp)
///   values/AB/HASH-LAYOUT     a value by the hash of its contents (blob.hpp)
///   files/AB/HASH             a file that a node wrote, by the hash of its bytes
///   hashes/FINGERPRINT        hashes of files that nodes read (file_hashes.hpp)
///   CACHEDIR.TAG              says that the folder is a cache (cache_folder.hpp)
///
/// Nothing in it is ever changed: files appear whole (written beside, renamed) and go. All are checked when they are
/// read, and nothing else in the folder is ever touched. The time of change of a file is when it was last used.
struct CachePlaces {
  std::filesystem::path folder;

  std::filesystem::path records(const std::string& type) const { return folder / "records" / type; }
  std::filesystem::path record(const std::string& type, const std::string& key) const { return records(type) / key; }
  std::filesystem::path value(const FlatType& type, const std::string& hash) const;
  std::filesystem::path file(const std::string& hash) const { return folder / "files" / hash.substr(0, 2) / hash; }
  std::filesystem::path hashes() const { return folder / "hashes"; }
};

/// ATRIUM_CACHE, or $XDG_CACHE_HOME/atrium, or ~/.cache/atrium; empty if ATRIUM_CACHE is "off" or there is no home.
std::filesystem::path default_cache_folder();

/// Whether it can be a hash: 32 hexadecimal digits, and so no path.
bool is_content_hash(std::string_view text);

/// Marks a file as used now.
void touch(const std::filesystem::path& file);

}  // namespace atrium
