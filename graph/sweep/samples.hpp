#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "graph/api/error.hpp"
#include "graph/pipeline/yaml_tree.hpp"

namespace atrium {

/// What a random axis of a sweep draws from: `{uniform: [1 cm, 4 cm]}`, `{loguniform: [1 mm, 1 m]}`, `{integers: [1,
/// 9]}` (both ends included) or `{choice: [a, b, c]}`.
struct Distribution {
  enum class Kind { uniform, loguniform, integers, choice } kind = Kind::uniform;
  double low = 0, high = 0;
  std::string unit;                  ///< of both ends: " cm"
  std::vector<std::string> choices;  ///< as -s takes them
};

/// Throws Error; its message goes on after the name of what is drawn.
Distribution read_distribution(const YamlNode& node);

/// The value that is drawn for `target` in sample `index`: it depends on nothing else, so samples can be added without
/// changing the others.
std::string sample(const Distribution& distribution, std::uint64_t seed, std::string_view target, std::uint64_t index);

}  // namespace atrium
