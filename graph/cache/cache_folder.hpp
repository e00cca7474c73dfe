#pragma once
#include <cstdint>
#include <ctime>
#include <filesystem>
#include <functional>

#include "graph/cache/places.hpp"

namespace atrium {

/// Not a cache folder.
class NoCacheFolder : public Error {
 public:
  using Error::Error;
};

/// Whether the folder has the mark of a cache: its file CACHEDIR.TAG says so (backup programs know it and pass over
/// the folder).
bool is_cache_folder(const CachePlaces& places);
/// Makes the folder and marks it. Throws NoCacheFolder if it holds anything and has no mark, Error if it cannot be
/// made.
void make_cache_folder(const CachePlaces& places);
/// Throws NoCacheFolder unless it is there and has the mark.
void check_cache_folder(const CachePlaces& places);

enum class CacheKind { records, values, files, hashes };

/// A file of the cache.
struct CacheEntry {
  std::filesystem::path path;
  CacheKind kind = CacheKind::records;
  bool unfinished = false;  ///< it is being written, or was when its process was killed
  std::uint64_t bytes = 0;  ///< on the disk
  timespec used{};
};

/// Calls see(entry) for every file of that kind: those in its own subfolder whose names have the form of a cache's
/// (places.hpp), nothing else. What goes meanwhile is left out. Throws Error if a folder cannot be read.
void for_each_entry(const CachePlaces& places, CacheKind kind, const std::function<void(const CacheEntry&)>& see);
/// The same for all kinds.
void for_each_entry(const CachePlaces& places, const std::function<void(const CacheEntry&)>& see);

}  // namespace atrium
