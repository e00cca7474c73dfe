#pragma once
#include "graph/cache/costs.hpp"
#include "graph/sweep/forecast.hpp"
#include "graph/sweep/joined_run.hpp"
#include "graph/sweep/run.hpp"
#include "graph/sweep/worker.hpp"
#include "graph/sweep/worker_pool.hpp"

namespace atrium {

/// How a sweep runs its variants in processes of their own. It has an `isolation`; the cache is asked what is cached,
/// the workers write into it.
struct IsolateOptions : SweepOptions {
  std::string build;
  std::function<VariantName(const SweepVariant&)> name;
  /// Hears all that the workers tell, for who joins it later: process, event.
  std::function<void(const std::string&, const nlohmann::ordered_json&)> journal = {};
  std::function<void()> on_tick = {};  ///< called now and then
};

/// In the sweep's folder: what the workers are told, and what they leave.
inline constexpr std::string_view farm_folder = "farm";
/// What a worker printed, in its variant's folder.
inline constexpr std::string_view worker_log = "worker.log";

/// Runs variants in processes of their own, whose folders are prepared (begin_variant, write_note). What several of
/// them share is run first, also in a process of its own, and taken from the cache. A process that crashes costs its
/// variant only; what it printed is kept in the variant's folder.
class IsolatedRun {
 public:
  IsolatedRun(const SweepPlan& plan, std::vector<bool> wanted, IsolateOptions options, JoinedRun& joined);
  /// Runs beginnings; each task is a file of this name in the work folder. One that crashes is tried again without the
  /// node that crashed.
  void run_shared(const std::vector<std::pair<std::string, WorkerTask>>& tasks);
  /// Runs the wanted variants.
  void run_variants();
  std::vector<VariantResult>& results() { return results_; }
  /// What the cache had before.
  const SweepForecast& forecast() const { return forecast_; }

 private:
  PoolOptions pool_options() const;
  std::vector<std::string> command(const std::vector<std::string>& names, int threads) const;
  void hear(const std::string& process, std::size_t lane, const nlohmann::ordered_json& event);
  std::optional<std::uint64_t> memory_of(const std::vector<std::size_t>& nodes);
  void add_variants(WorkerPool& pool, std::vector<std::size_t> variants);
  void ended(WorkerPool& pool, const std::vector<std::size_t>& variants, const PoolEnd& end);
  void settle(std::size_t v, const PoolEnd& end);

  const SweepPlan& plan_;
  std::vector<bool> wanted_;
  IsolateOptions options_;
  JoinedRun& joined_;
  SweepForecast forecast_;
  Costs costs_;
  std::uint64_t learned_ = 0;  ///< the most that a worker needed, bytes
  std::vector<VariantResult> results_;
  std::vector<std::vector<std::size_t>> groups_;  ///< by task: variants
  std::size_t failures_ = 0;
  std::atomic<bool> stop_ = false;
};

/// What the notes of variants say of pictures that show earlier variants.
VariantNote note_of(const SweepPlan& plan, const SweepVariant& variant, VariantName name);

}  // namespace atrium
