#include "modules/metric/region_overlap.hpp"

#include <algorithm>
#include <map>

namespace atrium::metric {
namespace {

enum class Kind { correct, oversegmented, undersegmented };

// One way to explain regions by each other.
struct Instance {
  double mean_share = 0;
  Kind kind = Kind::correct;
  std::vector<Overlap> parts;
};

double share(std::size_t part, std::size_t whole) { return static_cast<double>(part) / static_cast<double>(whole); }

// Groups with two or more parts that lie in `whole` by the threshold and cover it by the threshold.
void add_groups(std::vector<Instance>& instances, const Regions& regions, double threshold, Kind kind) {
  const bool over = kind == Kind::oversegmented;
  std::map<std::uint32_t, std::vector<Overlap>> groups;
  for (const auto& o : regions.overlaps)
    if (share(o.points, over ? regions.found[o.found] : regions.expected[o.expected]) >= threshold)
      groups[over ? o.expected : o.found].push_back(o);
  for (auto& [whole, parts] : groups) {
    if (parts.size() < 2) continue;
    std::size_t shared = 0, sizes = 0;
    for (const auto& o : parts) {
      shared += o.points;
      sizes += over ? regions.found[o.found] : regions.expected[o.expected];
    }
    const double covered = share(shared, over ? regions.expected[whole] : regions.found[whole]);
    if (covered >= threshold) instances.push_back({(covered + share(shared, sizes)) / 2, kind, std::move(parts)});
  }
}

}  // namespace

Segmentation compare_regions(const Regions& regions, double threshold) {
  std::vector<Instance> instances;
  for (const auto& o : regions.overlaps) {
    const double of_expected = share(o.points, regions.expected[o.expected]),
                 of_found = share(o.points, regions.found[o.found]);
    if (of_expected >= threshold && of_found >= threshold)
      instances.push_back({(of_expected + of_found) / 2, Kind::correct, {o}});
  }
  add_groups(instances, regions, threshold, Kind::oversegmented);
  add_groups(instances, regions, threshold, Kind::undersegmented);
  std::stable_sort(instances.begin(), instances.end(),
                   [](const Instance& a, const Instance& b) { return a.mean_share > b.mean_share; });
  std::vector<bool> expected_used(regions.expected.size(), false), found_used(regions.found.size(), false);
  Segmentation result;
  for (auto& instance : instances) {
    if (std::any_of(instance.parts.begin(), instance.parts.end(),
                    [&](const Overlap& o) { return expected_used[o.expected] || found_used[o.found]; }))
      continue;
    for (const auto& o : instance.parts) expected_used[o.expected] = found_used[o.found] = true;
    if (instance.kind == Kind::correct) result.correct.push_back(instance.parts.front());
    if (instance.kind == Kind::oversegmented) ++result.oversegmented;
    if (instance.kind == Kind::undersegmented) ++result.undersegmented;
  }
  for (std::size_t i = 0; i < expected_used.size(); ++i)
    if (regions.expected[i] > 0 && !expected_used[i]) ++result.missed;
  for (std::size_t i = 0; i < found_used.size(); ++i)
    if (regions.found[i] > 0 && !found_used[i]) ++result.noise;
  return result;
}

}  // namespace atrium::metric
