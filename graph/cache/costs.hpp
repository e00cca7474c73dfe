#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "graph/cache/places.hpp"
#include "graph/pipeline/pipeline.hpp"

namespace atrium {

/// What a node will probably take, from the last 20 records of those like it.
struct Cost {
  double wall = 0;  ///< seconds, the median
  /// The 90th percentile of the bytes above what was resident at the start; nothing if none of them ran alone.
  std::optional<std::uint64_t> memory;
};

/// Reads the records of each node type once. Not safe to use from several threads.
class Costs {
 public:
  explicit Costs(CachePlaces places) : places_(std::move(places)) {}
  /// From the records of the same type and address; if there is none, from all of the type; nothing if it never ran.
  std::optional<Cost> of(const std::string& type, const std::string& node);

 private:
  struct OfType {
    std::map<std::string, Cost> by_node;
    std::optional<Cost> all;
  };
  const OfType& read(const std::string& type);

  CachePlaces places_;
  std::map<std::string, OfType> types_;
};

/// The address of a node without the variant of a sweep that it stands in ("ID/planes" → "planes").
std::string address_of(const PipelineNode& node);

}  // namespace atrium
