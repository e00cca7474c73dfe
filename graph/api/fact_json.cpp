#include "graph/api/fact_json.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace atrium {

using Json = nlohmann::ordered_json;

void to_json(Json& json, const Fact& fact) {
  json = {{"name", fact.name}, {"value", value_json(fact)}};
  if (const auto* number = std::get_if<double>(&fact.value); number != nullptr && !std::isfinite(*number)) {
    json["value"] = nullptr;
    json["special"] = fmt::format("{}", std::isnan(*number) ? std::abs(*number) : *number);
  }
  if (!fact.unit.empty()) json["unit"] = fact.unit;
}

void from_json(const Json& json, Fact& fact) {
  fact = {json.value("name", ""), {}, json.value("unit", "")};
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
}

std::optional<double> number_of(const Fact& fact) {
  return std::visit(
      [](const auto& value) -> std::optional<double> {
        if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(value)>>)
          return static_cast<double>(value);
        else
          return std::nullopt;
      },
      fact.value);
}

std::string fact_text(const Fact& fact) {
  if (const auto* number = std::get_if<double>(&fact.value)) {
    const bool whole = std::abs(*number) < 1e15 && *number == std::trunc(*number);
    return whole ? fmt::format("{:.0f}", *number) : fmt::format("{:.6g}", *number);
  }
  return std::visit([](const auto& value) { return fmt::format("{}", value); }, fact.value);
}

Json value_json(const Fact& fact) {
  return std::visit([](const auto& value) { return Json(value); }, fact.value);
}

}  // namespace atrium
