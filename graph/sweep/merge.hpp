#pragma once
#include <string>
#include <unordered_map>
#include <vector>

#include "graph/sweep/plan.hpp"

namespace atrium {

/// A variant's id: from what its resolved file says.
std::string id_of(const Pipeline& pipeline);

/// Puts pipelines together into one graph, SweepPlan::merged.
class VariantMerger {
 public:
  explicit VariantMerger(SweepPlan& plan) : plan_(plan) {}
  struct Added {
    std::size_t variant;  ///< in SweepPlan::variants
    bool fresh;           ///< false: the same pipeline was there already
  };
  Added add(const Pipeline& pipeline, std::vector<std::size_t> choices);

 private:
  std::size_t place(const PipelineNode& node, const SweepVariant& variant);

  SweepPlan& plan_;
  std::unordered_map<std::string, std::size_t> ids_, nodes_;
  std::vector<std::string> keys_;
};

/// The variant's own pipeline again, as it was before merging.
Pipeline variant_pipeline(const SweepPlan& plan, const SweepVariant& variant);

/// A node's address in its variant: "ID/planes" is "planes".
std::string address_in_variant(const PipelineNode& node);

/// The graph with the wanted nodes only; of each wanted one, what it reads must be wanted too.
Pipeline part_of(const Pipeline& merged, const std::vector<bool>& wanted);

}  // namespace atrium
