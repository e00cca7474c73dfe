#pragma once
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "graph/api/value.hpp"
#include "graph/cache/node_key.hpp"

namespace atrium {

/// What one output of a node was.
struct OutputRecord {
  std::string port, type;
  std::uint64_t bytes = 0;  ///< held by the value itself, without what it shares with others
  std::string hash;         ///< of its contents; empty: not taken
  std::vector<Fact> facts;  ///< what is printed of it
};
void to_json(nlohmann::ordered_json& json, const OutputRecord& output);
void from_json(const nlohmann::ordered_json& json, OutputRecord& output);

/// A file that a node wrote.
struct Artefact {
  std::string path;  ///< relative to the folder that its record is of; absolute if it is not in it
  std::uint64_t bytes = 0;
  std::string hash = {};  ///< of its bytes; empty: not taken
};
void to_json(nlohmann::ordered_json& json, const Artefact& file);
void from_json(const nlohmann::ordered_json& json, Artefact& file);

/// What a node did when it was computed: all that a run shows of it, without the values themselves.
struct CacheRecord {
  std::string key;
  std::vector<NodeKey::Field> fields;  ///< of the key
  std::string node;                    ///< the address under which it was computed
  std::string made;                    ///< when: UTC, ISO 8601
  std::vector<OutputRecord> outputs;
  std::vector<std::string> warnings;
  std::vector<Artefact> files;    ///< relative to where the node writes
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
