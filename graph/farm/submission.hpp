#pragma once
#include "graph/sweep/run.hpp"
#include "graph/sweep/worker.hpp"

namespace atrium {

/// A sweep that is run by shards on an engine that users have: what all of its processes must know, in
/// DIR/farm/submission.json. Beside it, in DIR/farm/ID: the tasks `shared-1` … and `shard-1` … (WorkerTask), job.sh and
/// submit.sh; then what the shards tell (Journal), and what they print.
struct Submission {
  std::string id;                     ///< of the time: tasks of an earlier submission are not those of this one
  std::filesystem::path sweep;        ///< the sweep file
  std::vector<std::string> settings;  ///< -s
  std::filesystem::path folder;       ///< the working folder, for them and for the shards
  std::string build, engine;
  std::vector<std::string> variants;   ///< ids of all of the sweep's variants, in its order
  std::vector<std::string> arguments;  ///< of every worker: the cache, --no-hashes
  std::string cache;                   ///< its folder; empty: none
  std::uint64_t memory = 0;            ///< bytes for a shard; 0: any
  double timeout = 0;                  ///< seconds for a variant; 0: any
  double time = 0;                     ///< since 1970
  std::size_t shared = 0, shards = 0;  ///< how many tasks
};
void write_submission(const std::filesystem::path& out, const Submission& submission);
/// Throws Error if the folder has none.
Submission read_submission(const std::filesystem::path& out);

struct SubmitOptions {
  std::filesystem::path out;  ///< absolute
  std::string program;
  int threads = 0;                          ///< of each shard; 0: as many as the engine gives it
  std::size_t shards = 0;                   ///< 0: one per variant, at most 100
  std::vector<std::string> engine_options;  ///< passed on
  bool dry = false;                         ///< nothing is written
  Cache* cache = nullptr;
};

/// What hands a sweep to its engine.
struct SubmitScripts {
  std::filesystem::path job_file, submit_file;
  std::string job, submit;   ///< shell scripts
  std::size_t variants = 0;  ///< that are to be run
};

/// Prepares the folders of the variants that are not done, the tasks and the scripts. `submission` has all but what
/// is decided here. Throws FolderError.
SubmitScripts prepare_submission(const SweepFile& sweep, const SweepPlan& plan, Submission submission,
                                 const SubmitOptions& options);

/// What a shard tells: its events, a line each, with "p" for whose they are; and that it is alive, by the file's time.
class Journal {
 public:
  explicit Journal(const std::filesystem::path& file);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;
  void write(const std::string& process, const nlohmann::ordered_json& event);
  void alive();

 private:
  int file_ = -1;
  double touched_ = 0;
};

/// Runs one task of a submission, each variant in a process of its own. Throws Error if there is no such task, or if it
/// is of another build.
void run_shard(const std::filesystem::path& out, const std::string& task, const std::string& program, int threads,
               const std::string& build, const std::atomic<bool>* cancel, Registry& registry, ProgressSink& progress);

/// Joins what the shards have left so far, as run_sweep() would have left it.
SweepResult gather(const std::filesystem::path& out, const Submission& submission, const SweepFile& sweep,
                   const SweepPlan& plan);

}  // namespace atrium
