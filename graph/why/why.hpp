#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "graph/run/runner.hpp"
#include "graph/why/nearest.hpp"

namespace atrium {

/// Why a node of a run was computed, or where its result came from.
struct Reason {
  std::string node;                      ///< as it was asked for
  NodeRecord record;                     ///< what became of it
  std::vector<NodeRecord> nodes;         ///< of the whole run or variant
  bool is_kept = false;                  ///< of a miss: its record is in the cache
  std::optional<NearestRecord> nearest;  ///< of a miss whose record is kept: the one that is most like it
};

/// `run` is the folder of a run, or of a sweep; then the node is VARIANT/NODE. `cache`: the cache's folder; empty: that
/// of the run. Throws Error.
Reason reason_of(const std::filesystem::path& run, const std::string& node, const std::filesystem::path& cache);

/// As people read it, and as JSON.
std::string as_text(const Reason& reason);
std::string as_json(const Reason& reason);

}  // namespace atrium
