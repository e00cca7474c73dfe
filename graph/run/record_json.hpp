#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "graph/run/runner.hpp"

namespace atrium {

/// {"name": …, "value": …, "unit": …}. JSON has no numbers that are not finite: their value is null, and "special" says
/// "nan", "inf" or "-inf".
nlohmann::ordered_json fact_json(const Fact& fact);
/// Throws nlohmann::json::exception, as all of these do.
Fact read_fact(const nlohmann::ordered_json& json);

/// A word that is no status means `cancelled`.
NodeStatus read_node_status(std::string_view text);

/// All of it, to be read back by another process.
nlohmann::ordered_json record_json(const NodeRecord& record);
NodeRecord read_record_json(const nlohmann::ordered_json& json);

}  // namespace atrium
