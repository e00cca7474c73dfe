#pragma once
#include <string>
#include <vector>

#include "graph/pipeline/registry.hpp"
#include "graph/sweep/sweep_file.hpp"

namespace atrium {

/// One variant of a sweep.
struct SweepVariant {
  std::string id;                    ///< from what its resolved file says: growing a sweep renames nothing
  std::vector<std::size_t> choices;  ///< per axis
  std::uint64_t seed = 1;
  std::vector<std::size_t> nodes;       ///< of its pipeline, in its order: nodes of SweepPlan::merged
  std::vector<PipelineOutput> outputs;  ///< of its pipeline, from nodes of SweepPlan::merged
};

/// All variants of a sweep, as one graph in which a node with the same key stands once. A node's key: its type with its
/// version, its parameters, its address, the keys of the nodes that it reads, and its seed if it draws randomness.
struct SweepPlan {
  std::vector<SweepVariant> variants;
  Dataflow merged;             ///< a node's path is "ID/path" and its folder "variants/ID", of the first that has it
  std::size_t nodes = 0;       ///< of all variants, before merging
  std::size_t excluded = 0;    ///< combinations that `exclude` left out
  std::size_t duplicates = 0;  ///< combinations that are the same pipeline as an earlier one
  std::vector<std::string> notes;
};

struct SweepLoad {
  SweepPlan plan;  ///< valid only when errors is empty
  std::vector<Diagnostic> errors, warnings;
};

/// Loads and checks every variant; merges them.
SweepLoad plan_sweep(const SweepFile& sweep, const std::vector<Override>& settings, Registry& registry);

/// "flat, translated.max_separation = 10 cm, seed = 2": of the axes that have several choices.
std::string label_of(const SweepFile& sweep, const SweepVariant& variant);

/// The same, as short as it can be: values without names of nodes where these are not needed to tell the axes apart.
std::string caption_of(const SweepFile& sweep, const SweepVariant& variant);

/// What a variant is called.
struct VariantName {
  std::string label;                                         ///< as label_of() says it
  std::vector<std::pair<std::string, std::string>> choices;  ///< axis, label of its choice
};
VariantName name_of(const SweepFile& sweep, const SweepVariant& variant);

}  // namespace atrium
