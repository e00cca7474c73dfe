#include "graph/cache/costs.hpp"

#include <algorithm>
#include <tuple>

#include "graph/cache/records.hpp"

namespace atrium {
namespace {

constexpr std::size_t most_records = 20;
constexpr std::size_t most_read = 1000;  // large sweeps leave hundreds of thousands

/// A share of them is at most so much.
template <class T>
T quantile(std::vector<T> values, double share) {
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<std::size_t>(share * static_cast<double>(values.size()));
  return values[std::min(rank, values.size() - 1)];
}

/// From the youngest of the records.
Cost cost_of(std::vector<const CacheRecord*> records) {
  std::sort(records.begin(), records.end(),
            [](const auto* a, const auto* b) { return std::tie(a->made, a->key) > std::tie(b->made, b->key); });
  std::vector<double> walls;
  std::vector<std::uint64_t> growths;
  for (const auto* record : records) {
    if (walls.size() < most_records) walls.push_back(record->wall);
    if (record->growth && growths.size() < most_records) growths.push_back(*record->growth);
  }
  Cost cost{quantile(std::move(walls), 0.5), std::nullopt};
  if (!growths.empty()) cost.memory = quantile(std::move(growths), 0.9);
  return cost;
}

}  // namespace

const Costs::OfType& Costs::read(const std::string& type) {
  const auto [known, fresh] = types_.try_emplace(type);
  OfType& seen = known->second;
  if (!fresh) return seen;
  const auto records = records_of(places_, type, most_read);
  std::vector<const CacheRecord*> all;
  std::map<std::string, std::vector<const CacheRecord*>> by_node;
  for (const auto& record : records) {
    all.push_back(&record);
    by_node[record.node].push_back(&record);
  }
  for (auto& [node, of_node] : by_node) seen.by_node.emplace(node, cost_of(std::move(of_node)));
  if (!all.empty()) seen.all = cost_of(std::move(all));
  return seen;
}

std::optional<Cost> Costs::of(const std::string& type, const std::string& node) {
  const OfType& seen = read(type);
  const auto found = seen.by_node.find(node);
  return found == seen.by_node.end() ? seen.all : found->second;
}

std::string address_of(const PipelineNode& node) {
  const std::string variant = node.folder.filename().string() + "/";
  return !node.folder.empty() && node.path.starts_with(variant) ? node.path.substr(variant.size()) : node.path;
}

}  // namespace atrium
