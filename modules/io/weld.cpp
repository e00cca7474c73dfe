#include "modules/io/weld.hpp"

#include <bit>

#include "graph/api/random.hpp"

namespace atrium::io {

std::vector<std::uint32_t> first_at_same_place(const std::vector<Eigen::Vector3d>& places) {
  constexpr std::uint32_t none = 0xffffffffU;
  std::vector<std::uint32_t> first(places.size());
  const std::size_t slots = std::bit_ceil(2 * places.size() + 1);
  std::vector<std::uint32_t> table(slots, none);
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    first[i] = i;
    if (!places[i].allFinite()) continue;
    std::uint64_t hash = 0;
    for (const double v : places[i]) hash = mix_seed(hash, std::bit_cast<std::uint64_t>(v + 0.0));
    std::size_t slot = hash & (slots - 1);
    while (table[slot] != none && places[table[slot]] != places[i]) slot = (slot + 1) & (slots - 1);
    if (table[slot] == none)
      table[slot] = i;
    else
      first[i] = table[slot];
  }
  return first;
}

}  // namespace atrium::io
