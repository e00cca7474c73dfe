#pragma once
#include <nlohmann/json_fwd.hpp>

#include "graph/run/runner.hpp"

namespace atrium {

/// The form that a node's record has in manifest.json and in a variant's result.json: see
/// share/schema/manifest.schema.json. Seconds are rounded to microseconds.
nlohmann::ordered_json node_json(const NodeRecord& record);
/// With what only the run that it is of can make use of: times since its start, threads, what outputs show.
nlohmann::ordered_json whole_node_json(const NodeRecord& record);
/// Reads either. A status that is no word of NodeStatus means `cancelled`. Throws nlohmann::json::exception.
NodeRecord read_node(const nlohmann::ordered_json& json);

/// Why a node was run whose record was found.
inline constexpr const char* run_again = "run again: its value was needed and is not kept";

/// To the microsecond: more digits are noise.
double rounded_seconds(double seconds);

}  // namespace atrium
