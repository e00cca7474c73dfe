#pragma once
#include <nlohmann/json_fwd.hpp>

#include "graph/api/value.hpp"

namespace atrium {

/// {"name": …, "value": …, "unit": …}. JSON has no numbers that are not finite: their value is null, and "special" says
/// "nan", "inf" or "-inf".
nlohmann::ordered_json fact_json(const Fact& fact);
/// Throws nlohmann::json::exception, if it is no fact.
Fact read_fact(const nlohmann::ordered_json& json);

}  // namespace atrium
