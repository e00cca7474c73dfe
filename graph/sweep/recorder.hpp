#pragma once
#include <map>
#include <mutex>
#include <unordered_map>

#include "graph/pipeline/png_stamp.hpp"
#include "graph/sweep/result.hpp"

namespace atrium {

/// OUT/variants/ID.
std::filesystem::path variant_folder(const std::filesystem::path& out, const SweepVariant& variant);

/// What is done already in a sweep's folder, and nothing for the other variants.
std::vector<std::optional<VariantResult>> done_variants(const std::filesystem::path& out, const SweepPlan& plan,
                                                        const std::string& build);

/// Empties the folder of a variant that is to be run, and writes its resolved.yaml.
void begin_variant(const std::filesystem::path& out, const SweepPlan& plan, const SweepVariant& variant);

/// The nodes of the variants that are to be run, in the order of the merged graph.
std::vector<std::size_t> nodes_of(const SweepPlan& plan, const std::vector<bool>& variants);

/// Gathers what the nodes of the merged graph report, and records each variant (result.json) when its last node is
/// done.
class Recorder final : public ProgressSink {
 public:
  struct Options {
    std::filesystem::path out;
    std::string build;
    std::size_t max_failures = ~std::size_t{0};
    std::function<VariantName(const SweepVariant&)> name;
  };
  /// `wanted[v]`: variant v is run.
  Recorder(const SweepPlan& plan, const std::vector<bool>& wanted, Options options, ProgressSink& progress);

  void planned(std::size_t nodes) override { progress_.planned(nodes); }
  void started(const std::string& node) override { progress_.started(node); }
  void progress(const std::string& node, double share) override { progress_.progress(node, share); }
  void message(const std::string& node, std::string_view text, bool warning) override {
    progress_.message(node, text, warning);
  }
  void finished(const NodeRecord& record) override;
  void reopened(const std::string& node) override;
  void described(const NodeRecord& record) override;

  /// A picture shows a variant: the first that has the node which drew it.
  const PngStamp& stamp_of_variant(const PipelineNode& node);
  /// Set when so many variants have failed that the sweep is to end.
  const std::atomic<bool>* stop() const { return &stop_; }
  /// Of the variants that were run.
  std::vector<VariantResult>& results() { return variants_; }

 private:
  void settle(const NodeRecord& record);
  void record_variant(std::size_t v);
  void add_artefact(const SweepVariant& variant, std::size_t n, const Artefact& artefact, VariantResult& result);

  const SweepPlan& plan_;
  Options options_;
  ProgressSink& progress_;
  std::mutex mutex_;  ///< of stamps_, records_ and left_; a variant whose nodes are done is one thread's alone
  std::unordered_map<std::string, std::size_t> index_;
  std::vector<std::vector<std::size_t>> variants_of_;
  std::vector<std::size_t> left_;
  std::vector<std::string> inputs_;  ///< state_of_inputs() of the variants that are run, when they were begun
  std::vector<NodeRecord> records_;
  std::vector<VariantResult> variants_;
  std::map<std::string, PngStamp> stamps_;  ///< by variant
  std::atomic<std::size_t> failures_ = 0;
  std::atomic<bool> stop_ = false;
};

/// A variant's result from the records of its nodes (by index into the merged graph).
VariantResult result_of(const SweepPlan& plan, const SweepVariant& variant,
                        const std::function<const NodeRecord&(std::size_t node)>& record);

}  // namespace atrium
