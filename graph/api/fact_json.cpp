#include "graph/api/fact_json.hpp"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace atrium {

using Json = nlohmann::ordered_json;

Json fact_json(const Fact& fact) {
  Json json{{"name", fact.name}};
  std::visit([&](const auto& value) { json["value"] = value; }, fact.value);
  const auto* number = std::get_if<double>(&fact.value);
  if (number != nullptr && !std::isfinite(*number)) {
    json["value"] = nullptr;
    json["special"] = std::isnan(*number) ? "nan" : *number > 0 ? "inf" : "-inf";
  }
  if (!fact.unit.empty()) json["unit"] = fact.unit;
  return json;
}

Fact read_fact(const Json& json) {
  Fact fact{json.value("name", ""), {}, json.value("unit", "")};
  const Json& value = json.at("value");
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (value.is_boolean())
    fact.value = value.get<bool>();
  else if (value.is_number_integer())
    fact.value = value.get<std::int64_t>();
  else if (value.is_string())
    fact.value = value.get<std::string>();
  else if (!value.is_null())
    fact.value = value.get<double>();
  else
    fact.value = json.value("special", "") == "inf"    ? infinity
                 : json.value("special", "") == "-inf" ? -infinity
                                                       : std::nan("");
  return fact;
}

}  // namespace atrium
