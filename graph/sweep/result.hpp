#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "graph/run/runner.hpp"
#include "graph/sweep/plan.hpp"
#include "graph/sweep/table.hpp"

namespace atrium {

enum class VariantStatus {
  ok,
  failed,     ///< a node says what is wrong
  crashed,    ///< the process that ran it ended without a word: a signal, exit(), the memory or time limit
  cancelled,  ///< the sweep was ended before the variant was done
  missing,    ///< of a sweep on many machines: nobody has begun with it
  running,    ///< of a sweep on many machines: it is being run
  lost,       ///< of a sweep on many machines: it was begun, and there is no sign of life of who did
};
std::string_view name_of(VariantStatus status);

/// What became of one variant.
struct VariantResult {
  struct Output {
    std::string name;
    std::vector<Fact> facts;
  };
  VariantStatus status = VariantStatus::cancelled;
  std::string message;  ///< of the node that failed first, with its path; of one that crashed: how, and in which node
  std::vector<NodeRecord> nodes;  ///< by their addresses in the variant, with what it took to compute them
  std::vector<Output> outputs;
  std::vector<Artefact> artefacts;  ///< relative to the variant's folder
  bool reused = false;              ///< it was there already, from an earlier run of the sweep
};

/// The file `result.json` of a variant: what became of it, what it depended on (Atrium's build, the input files), and
/// the files in its folder with the hashes of their contents. `inputs`: state_of_inputs() when the variant was begun;
/// if it is another by now, nobody knows what the variant was made from, and it is run again next time.
void write_result(const std::filesystem::path& folder, const VariantName& name, const SweepPlan& plan,
                  const SweepVariant& variant, const VariantResult& result, const std::string& build,
                  const std::string& inputs);

/// What tells whether a file that the variant reads was changed (FileHashes::fingerprint), for all of them.
std::string state_of_inputs(const SweepPlan& plan, const SweepVariant& variant);

/// Reads it back as it stands; nothing if there is none, or it is of another build.
std::optional<VariantResult> read_result(const std::filesystem::path& folder, const std::string& build);

/// Reads it back; nothing unless the variant was done, by the same build, its input files are the same (inode, size,
/// times of change of contents and status; of a folder those of all files in it) and the files that it wrote are still
/// there as they were. Variants with nodes that run every time (`cached = false`) are reused as well: what such
/// a node reads besides its inputs, parameters and files is not checked.
std::optional<VariantResult> reusable_result(const std::filesystem::path& folder, const SweepPlan& plan,
                                             const SweepVariant& variant, const std::string& build);

/// One row per variant: what it differs in, the metrics, what it cost; in full precision. `unknown` gets what is
/// wrong with metrics that no variant has.
Table full_table(const SweepFile& sweep, const SweepPlan& plan, const std::vector<VariantResult>& results,
                 std::vector<std::string>* unknown = nullptr);

/// The same as JSON: {"columns": [{"title": …, "kind": "text" | "axis" | "drawn" | "metric", "name": …, "unit": …}],
/// "variants": [{TITLE: …}]}, with numbers as numbers.
nlohmann::ordered_json table_json(const SweepFile& sweep, const SweepPlan& plan,
                                  const std::vector<VariantResult>& results);

/// The same for people: rounded, and one row for all seeds ("mean ± standard deviation").
Table short_table(const SweepFile& sweep, const SweepPlan& plan, const std::vector<VariantResult>& results);

}  // namespace atrium
