#include "graph/why/nearest.hpp"

#include <algorithm>
#include <tuple>

#include "graph/cache/records.hpp"

namespace atrium {
namespace {

std::string value_of(const std::vector<NodeKey::Field>& fields, const std::string& name) {
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const auto& field) { return field.name == name; });
  return found == fields.end() ? std::string() : found->value;
}

}  // namespace

std::vector<KeyDifference> differences_of(const std::vector<NodeKey::Field>& then,
                                          const std::vector<NodeKey::Field>& now) {
  std::vector<KeyDifference> differences;
  for (const auto& field : now)
    if (const std::string before = value_of(then, field.name); before != field.value)
      differences.push_back({field.name, before, field.value});
  for (const auto& field : then) {
    const auto same = [&](const auto& other) { return other.name == field.name; };
    if (std::none_of(now.begin(), now.end(), same)) differences.push_back({field.name, field.value, ""});
  }
  return differences;
}

std::optional<NearestRecord> nearest_record(const CachePlaces& places, const CacheRecord& record) {
  std::optional<NearestRecord> nearest;
  // Of two as near, the one of the same address is nearer, then the younger one.
  const auto rank = [&](const NearestRecord& r) {
    return std::tuple(r.differences.size(), r.record.node != record.node);
  };
  for (auto& other : records_of(places, record.type())) {
    if (other.key == record.key || other.made > record.made) continue;
    NearestRecord candidate{std::move(other), {}};
    candidate.differences = differences_of(candidate.record.fields, record.fields);
    if (!nearest || rank(candidate) < rank(*nearest) ||
        (rank(candidate) == rank(*nearest) && candidate.record.made > nearest->record.made))
      nearest = std::move(candidate);
  }
  return nearest;
}

}  // namespace atrium
