#pragma once
#include <optional>
#include <string>
#include <vector>

#include "graph/cache/places.hpp"
#include "graph/cache/record.hpp"

namespace atrium {

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
