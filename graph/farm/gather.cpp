// What the shards of a sweep that was submitted have left, joined.
#include <fmt/format.h>

#include <ctime>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "graph/api/files.hpp"
#include "graph/api/json_text.hpp"
#include "graph/api/text.hpp"
#include "graph/farm/submission.hpp"
#include "graph/run/run_folder.hpp"
#include "graph/sweep/isolated_run.hpp"
#include "graph/sweep/recorder.hpp"

namespace atrium {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
constexpr double silence = 60;  // seconds without a sign of life after which a shard counts as lost

/// What is known of one task's process.
struct Shard {
  std::string name, host;
  std::int64_t process = 0;
  bool begun = false, over = false;
  double silent = 0;                       ///< seconds
  std::map<std::string, double> variants;  ///< that it has begun with, and when
  bool alive() const { return begun && !over && silent < silence; }
};

/// Now, by the clock of the file system: that of this machine may be another.
fs::file_time_type now_in(const fs::path& folder) {
  const fs::path probe = folder / ".now";
  AtomicFile(probe).publish();
  std::error_code error;
  const auto time = fs::last_write_time(probe, error);
  fs::remove(probe, error);
  return error ? fs::file_time_type::clock::now() : time;
}

/// None if the file is not there. Throws Error if it cannot be read.
std::vector<std::string> lines_of(const fs::path& file) {
  std::vector<std::string> lines;
  if (!fs::exists(file)) return lines;
  std::istringstream text(read_text(file));
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

class Gatherer {
 public:
  Gatherer(const fs::path& out, const Submission& submission, const SweepPlan& plan)
      : out_(out),
        work_(out / farm_folder / submission.id),
        submission_(submission),
        plan_(plan),
        now_(now_in(work_)) {}

  std::vector<VariantResult> run(JoinedRun& joined) {
    for (std::size_t t = 1; t <= submission_.shared; ++t) read(fmt::format("shared-{}", t), t, joined);
    for (std::size_t t = 1; t <= submission_.shards; ++t) {
      const Shard shard = read(fmt::format("shard-{}", t), t, joined);
      for (const auto& line : lines_of(work_ / shard.name)) shard_of_[line] = shard;
    }
    std::vector<VariantResult> results;
    for (const auto& variant : plan_.variants) {
      const bool submitted = shard_of_.contains(variant.id);
      const fs::path folder = variant_folder(out_, variant);
      auto result = submitted ? read_result(folder, submission_.build)
                              : reusable_result(folder, plan_, variant, submission_.build);
      results.push_back(result ? std::move(*result) : without_result(variant.id));
    }
    return results;
  }

  /// Which variants the submission was to run.
  std::vector<bool> submitted() const {
    std::map<std::string, bool> names;
    for (std::size_t t = 1; t <= submission_.shards; ++t)
      for (const auto& line : lines_of(work_ / fmt::format("shard-{}", t))) names[line] = true;
    std::vector<bool> result;
    for (const auto& variant : plan_.variants) result.push_back(names.contains(variant.id));
    return result;
  }

 private:
  Shard read(const std::string& name, std::size_t lane, JoinedRun& joined) const {
    Shard shard;
    shard.name = name;
    const fs::path file = work_ / (name + ".events");
    for (const auto& line : lines_of(file)) {
      const Json event = read_json(line);
      if (!event.is_object()) continue;  // cut off
      const std::string kind = event.value("e", "");
      const std::string process = event.value("p", "");
      if (kind == "shard") {
        shard.begun = true;
        shard.over = false;
        shard.host = event.value("host", "");
        shard.process = event.value("process", std::int64_t{0});
      }
      if (kind == "over") shard.over = true;
      if (kind == "begin") shard.variants[process] = event.value("time", 0.0);
      joined.hear(fmt::format("{}/{}", name, process), lane, event);
    }
    std::error_code error;
    const auto last = fs::last_write_time(file, error);
    if (!error) shard.silent = std::chrono::duration<double>(now_ - last).count();
    return shard;
  }

  /// Why a shard ended before it began, from what it printed.
  std::string error_of(const std::string& name) const {
    constexpr std::string_view mark = "atrium: error: ";
    std::string error;
    for (const auto& line : lines_of(work_ / (name + ".log")))
      if (line.starts_with(mark)) error = ": " + line.substr(mark.size());
    return error;
  }

  VariantResult without_result(const std::string& id) const {
    const auto found = shard_of_.find(id);
    VariantResult result;
    result.status = VariantStatus::missing;
    if (found == shard_of_.end()) {
      result.message =
          "what it has left is not there any more, or its input files have changed: submit the sweep again";
      return result;
    }
    const Shard& shard = found->second;
    const std::string where = fmt::format("{} (process {} on {})", shard.name, shard.process, shard.host);
    if (!shard.begun) {
      result.message = fmt::format("{} has not begun{}", shard.name, error_of(shard.name));
    } else if (shard.over) {
      result.status = VariantStatus::cancelled;
      result.message = fmt::format("{} was ended", shard.name);
    } else if (!shard.alive()) {
      result.status = VariantStatus::lost;
      result.message = fmt::format("no sign of life of {} for {:.0f} s", where, shard.silent);
    } else if (shard.variants.contains(id)) {
      result.status = VariantStatus::running;
      result.message = fmt::format("in {}", where);
    } else {
      result.message = fmt::format("waits in {}", where);
    }
    return result;
  }

  const fs::path out_, work_;
  const Submission& submission_;
  const SweepPlan& plan_;
  fs::file_time_type now_;
  std::map<std::string, Shard> shard_of_;
};

}  // namespace

SweepResult gather(const fs::path& out, const Submission& submission, const SweepFile& sweep, const SweepPlan& plan) {
  std::vector<std::string> ids;
  for (const auto& variant : plan.variants) ids.push_back(variant.id);
  if (ids != submission.variants)
    throw Error(
        fmt::format("{} or its base does not describe the variants any more that were submitted", sweep.path.string()),
        "submit it again: what is done is not done again");
  Gatherer gatherer(out, submission, plan);
  ProgressSink silent;
  JoinedRun joined(plan, gatherer.submitted(), submission.time, silent);
  SweepResult result;
  result.variants = gatherer.run(joined);
  RunResult run = joined.run();
  for (const auto& node : run.nodes) run.wall = std::max(run.wall, node.start + node.wall);
  run.cache_folder = submission.cache;
  run.threads = static_cast<int>(submission.shards);
  write_run(out, joined.pipeline(), run, utc_text(static_cast<std::time_t>(submission.time)), result);
  write_tables(out, sweep, plan, result.variants);
  return result;
}

}  // namespace atrium
