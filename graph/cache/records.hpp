#pragma once
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "graph/cache/places.hpp"
#include "graph/cache/record.hpp"

namespace atrium {

/// The record of a key as it stands in the cache, or nothing.
std::optional<CacheRecord> record_of(const CachePlaces& places, const std::string& type, const std::string& key);
/// The records of a node type that were used last, so many at most.
std::vector<CacheRecord> records_of(const CachePlaces& places, const std::string& type,
                                    std::size_t most = std::numeric_limits<std::size_t>::max());

}  // namespace atrium
