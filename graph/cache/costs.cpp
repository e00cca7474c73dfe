#include "graph/cache/costs.hpp"

#include <algorithm>

#include "graph/cache/nearest.hpp"

namespace atrium {

const Costs::OfType& Costs::read(const std::string& type) {
  const auto [known, fresh] = types_.try_emplace(type);
  OfType& seen = known->second;
  if (!fresh) return seen;
  for (const auto& record : records_of(places_, type))
    for (Seen* to : {&seen.by_node[record.node], &seen.all}) {
      to->walls.push_back(record.wall);
      to->memory = std::max(to->memory, record.growth);
    }
  std::sort(seen.all.walls.begin(), seen.all.walls.end());
  for (auto& [node, of_node] : seen.by_node) std::sort(of_node.walls.begin(), of_node.walls.end());
  return seen;
}

std::optional<Cost> Costs::of(const std::string& type, const std::string& node) {
  const OfType& seen = read(type);
  const auto found = seen.by_node.find(node);
  const Seen& near = found == seen.by_node.end() ? seen.all : found->second;
  if (near.walls.empty()) return std::nullopt;
  return Cost{near.walls[near.walls.size() / 2], near.memory};
}

std::string address_of(const PipelineNode& node) {
  const std::string variant = node.folder.filename().string() + "/";
  return !node.folder.empty() && node.path.starts_with(variant) ? node.path.substr(variant.size()) : node.path;
}

}  // namespace atrium
