#pragma once
#include <string>
#include <unordered_map>
#include <vector>

#include "graph/sweep/plan.hpp"

namespace atrium {

/// A variant's id: from what its resolved file says, with files as seen from the sweep file's folder: the same wherever
/// a checkout stands.
std::string id_of(const Pipeline& pipeline, const std::filesystem::path& folder);

/// Puts pipelines together into one graph, SweepPlan::merged.
class VariantMerger {
 public:
  /// `folder`: of the sweep file.
  VariantMerger(SweepPlan& plan, std::filesystem::path folder) : plan_(plan), folder_(std::move(folder)) {}
  struct Added {
    std::size_t variant;  ///< in SweepPlan::variants
    bool fresh;           ///< false: the same pipeline was there already
  };
  Added add(const Pipeline& pipeline, std::vector<std::size_t> choices);

 private:
  std::size_t place(std::size_t n, const Pipeline& pipeline, const SweepVariant& variant);

  SweepPlan& plan_;
  std::filesystem::path folder_;
  std::unordered_map<std::string, std::size_t> ids_, nodes_;
  std::vector<std::string> keys_;
};

/// The variant's own pipeline again, as it was before merging.
Pipeline variant_pipeline(const SweepPlan& plan, const SweepVariant& variant);

/// A node's address in its variant: "ID/planes" is "planes".
std::string address_in_variant(const PipelineNode& node);

}  // namespace atrium
