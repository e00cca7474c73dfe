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

/// A field of the key that is not the same. Empty: it was not, or is not, there.
struct KeyDifference {
  std::string name, then, now;
};
std::vector<KeyDifference> differences_of(const std::vector<NodeKey::Field>& then,
                                          const std::vector<NodeKey::Field>& now);

struct NearestRecord {
  CacheRecord record;
  std::vector<KeyDifference> differences;
};
/// The record of the same node type that differs in the fewest fields and is not younger; of several one of the same
/// address, then the youngest.
std::optional<NearestRecord> nearest_record(const CachePlaces& places, const CacheRecord& record);

}  // namespace atrium
