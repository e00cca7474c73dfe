#pragma once
#include <optional>
#include <variant>

#include "graph/report/run_record.hpp"

namespace atrium::report {

/// What a report shows: the variants of a sweep, or one run alone.
struct SweepRecord {
  struct Choice {
    std::string label;
    std::vector<std::pair<std::string, std::string>> set;  ///< target, value
  };
  struct Axis {
    std::string name;
    std::vector<Choice> choices;
  };
  struct Metric {
    std::string name, unit;
    std::optional<int> digits;
  };
  using Cell = std::variant<std::monostate, double, std::string>;  ///< nothing: the variant has none
  struct Variant {
    RunRecord run;
    std::vector<Cell> cells;  ///< one per metric
  };

  std::string title, summary;
  bool sweep = true;  ///< false: one run alone
  std::vector<Axis> axes;
  std::vector<Metric> metrics;
  std::vector<Variant> variants;
  std::vector<std::string> notes;  ///< what a reader should know: what could not be read
};

/// Reads the folder of a sweep (sweep.json, table.json, variants) or of a run. A sweep that was killed before its table
/// was written gives the variants that are done, with all their metrics. Throws Error.
SweepRecord read_sweep_folder(const std::filesystem::path& folder);

}  // namespace atrium::report
