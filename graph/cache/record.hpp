#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "graph/api/value.hpp"
#include "graph/cache/node_key.hpp"

namespace atrium {

/// What a node did when it was computed: all that a run shows of it, without the values themselves.
struct CacheRecord {
  struct Output {
    std::string port, type;
    std::uint64_t bytes = 0;
    std::string hash;
    std::vector<Fact> facts;
  };
  struct File {
    std::string path;  ///< relative to where the node writes
    std::uint64_t bytes = 0;
    std::string hash;
  };
  std::string key;
  std::vector<NodeKey::Field> fields;  ///< of the key
  std::string node;                    ///< the address under which it was computed
  std::string made;                    ///< when: UTC, ISO 8601
  std::vector<Output> outputs;
  std::vector<std::string> warnings;
  std::vector<File> files;
  double wall = 0, cpu = 0;       ///< seconds
  std::uint64_t peak_memory = 0;  ///< of the process, bytes
  /// Of the process's memory above what was there when the node began, at most, bytes; nothing: it did not run alone.
  std::optional<std::uint64_t> growth;

  std::string type() const { return fields.empty() ? std::string() : fields.front().value; }
};

/// A line with the hash of the rest, then JSON.
std::string record_text(const CacheRecord& record);
/// Nothing if the text is not whole, not of this version, or not the record of its key.
std::optional<CacheRecord> read_record(const std::string& text);

}  // namespace atrium
