#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "graph/cache/places.hpp"

namespace atrium {

/// What a cache holds.
struct CacheContents {
  struct Share {
    std::uint64_t files = 0, bytes = 0;
  };
  Share records, values, files, hashes;
  std::map<std::string, std::uint64_t> of_type;  ///< node type: number of records
  Share all() const;
};
/// Throws Error if the folder cannot be read.
CacheContents contents_of(const CachePlaces& places);

struct Removed {
  std::uint64_t files = 0, bytes = 0;
  std::uint64_t left = 0;  ///< bytes
};
/// Removes what has not been used for longest until at most `most_bytes` are left, and unfinished files of processes
/// that are gone. Returns nothing if another process is removing already. What is not the cache's own stays: see
/// for_each_entry(). Throws Error if the folder is not that of a cache, or cannot be read.
std::optional<Removed> collect_garbage(const CachePlaces& places, std::uint64_t most_bytes);

/// A file that is not as it should be.
struct CacheProblem {
  std::string what;
  bool removed = false;  ///< no: it could not be checked (it may be whole), or could not be removed
};
/// Checks every file; removes those that are damaged. Throws Error if the folder is not that of a cache, or cannot be
/// read.
std::vector<CacheProblem> verify_cache(const CachePlaces& places, std::uint64_t& checked);

/// "20 GB", "512 MiB", "1e9": bytes. Throws Error.
std::uint64_t read_size(const std::string& text);
/// "1.2 GB".
std::string size_text(std::uint64_t bytes);

}  // namespace atrium
