#include "graph/sweep/samples.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "graph/api/random.hpp"

namespace atrium {
namespace {

struct Quantity {
  double number = 0;
  std::string unit;
};

Quantity quantity(const YamlNode& node) {
  Quantity result;
  const char* end = node.text.data() + node.text.size();
  const auto [rest, problem] = std::from_chars(node.text.data(), end, result.number);
  if (!node.is_scalar() || problem != std::errc{} || !std::isfinite(result.number))
    throw Error(fmt::format("has the bound '{}', which is no number", node.text), "as in {uniform: [1 cm, 4 cm]}");
  result.unit = std::string(rest, end);
  return result;
}

}  // namespace

Distribution read_distribution(const YamlNode& node) {
  const Error shape(
      "is not drawn from a distribution",
      "{uniform: [low, high]}, {loguniform: [low, high]}, {integers: [low, high]} or {choice: [a, b, …]}");
  if (!node.is_mapping() || node.entries.size() != 1) throw shape;
  const auto& [name, place, range] = node.entries.front();
  constexpr std::array<std::string_view, 4> kinds{"uniform", "loguniform", "integers", "choice"};  // as Kind has them
  const auto kind = std::find(kinds.begin(), kinds.end(), name);
  if (kind == kinds.end()) throw shape;
  Distribution result;
  result.kind = static_cast<Distribution::Kind>(kind - kinds.begin());
  if (!range.is_sequence() || range.items.empty()) throw shape;
  if (result.kind == Distribution::Kind::choice) {
    for (const auto& item : range.items) {
      if (!item.is_scalar())
        throw Error("is drawn from a choice that is not a single value", "give each list as a variant under `list:`");
      result.choices.push_back(item.text);
    }
    return result;
  }
  if (range.items.size() != 2) throw Error(fmt::format("needs two bounds, not {}", range.items.size()), shape.help());
  const Quantity low = quantity(range.items[0]);
  const Quantity high = quantity(range.items[1]);
  if (low.unit != high.unit)
    throw Error(fmt::format("has bounds in different units: '{}' and '{}'", range.items[0].text, range.items[1].text),
                "write both in the same unit");
  if (low.number > high.number) throw Error("has its bounds the wrong way round", "the lower one first");
  if (result.kind == Distribution::Kind::loguniform && low.number <= 0)
    throw Error("is drawn loguniformly from bounds that are not above zero", "{loguniform: [1 mm, 1 m]}");
  if (result.kind == Distribution::Kind::integers &&
      (low.number != std::floor(low.number) || high.number != std::floor(high.number)))
    throw Error("is drawn from integers between bounds that are none", "{integers: [1, 9]}");
  result.low = low.number;
  result.high = high.number;
  result.unit = low.unit;
  return result;
}

std::string sample(const Distribution& distribution, std::uint64_t seed, std::string_view target, std::uint64_t index) {
  Random random(mix_seed(mix_seed(seed, XXH3_64bits(target.data(), target.size())), index));
  switch (distribution.kind) {
    case Distribution::Kind::uniform:
      return fmt::format("{}{}", random.uniform(distribution.low, distribution.high), distribution.unit);
    case Distribution::Kind::loguniform:
      return fmt::format("{}{}",
                         std::clamp(std::exp(random.uniform(std::log(distribution.low), std::log(distribution.high))),
                                    distribution.low, distribution.high),
                         distribution.unit);
    case Distribution::Kind::integers: {
      const auto steps = static_cast<std::uint64_t>(distribution.high - distribution.low) + 1;
      return fmt::format("{:.0f}{}", distribution.low + static_cast<double>(random.index(steps)), distribution.unit);
    }
    default: return distribution.choices[random.index(distribution.choices.size())];
  }
}

}  // namespace atrium
