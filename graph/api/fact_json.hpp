#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "graph/api/value.hpp"

namespace atrium {

/// {"name": …, "value": …, "unit": …}. JSON has no numbers that are not finite: their value is null, and "special" says
/// "nan", "inf" or "-inf".
void to_json(nlohmann::ordered_json& json, const Fact& fact);
/// Throws nlohmann::json::exception, if it is no fact.
void from_json(const nlohmann::ordered_json& json, Fact& fact);

/// The fact's number, of a truth value 1 or 0; nothing if it is a text.
std::optional<double> number_of(const Fact& fact);
/// Its value for people: six digits of a number; whole ones are shown whole.
std::string fact_text(const Fact& fact);
/// Its value alone, in JSON.
nlohmann::ordered_json value_json(const Fact& fact);

}  // namespace atrium
