#include "graph/farm/submission.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "graph/api/json_fields.hpp"
#include "graph/api/json_text.hpp"
#include "graph/api/text.hpp"
#include "graph/run/run_folder.hpp"
#include "graph/sweep/isolated_run.hpp"
#include "graph/sweep/merge.hpp"
#include "graph/sweep/recorder.hpp"
#include "graph/sweep/shared_beginnings.hpp"
#include "graph/sweep/sweep_folder.hpp"

namespace atrium {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
constexpr std::size_t usual_shards = 100;
constexpr std::string_view record_name = "submission.json";
constexpr std::tuple fields{json_field("id", &Submission::id),
                            json_field("sweep", &Submission::sweep),
                            json_field("settings", &Submission::settings),
                            json_field("folder", &Submission::folder),
                            json_field("build", &Submission::build),
                            json_field("engine", &Submission::engine),
                            json_field("variants", &Submission::variants),
                            json_field("arguments", &Submission::arguments),
                            json_field("cache", &Submission::cache),
                            json_field("memory", &Submission::memory),
                            json_field("timeout", &Submission::timeout),
                            json_field("time", &Submission::time),
                            json_field("shared", &Submission::shared),
                            json_field("shards", &Submission::shards)};

/// Quoted for a shell, where it needs that.
std::string for_shell(const std::string& text) {
  constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,@%";
  if (!text.empty() && text.find_first_not_of(plain) == std::string::npos) return text;
  return "'" + replaced(text, "'", "'\\''") + "'";
}

std::string for_shell(const std::vector<std::string>& words) {
  std::string result;
  for (const auto& word : words) result += " " + for_shell(word);
  return result;
}

/// The tasks in so many, the parts of one variant together.
std::vector<WorkerTask> packed(const std::vector<WorkerTask>& tasks, std::size_t most) {
  std::vector<WorkerTask> result(std::min(tasks.size(), most));
  for (std::size_t t = 0; t < tasks.size(); ++t) {
    auto& parts = result[t % most].parts;
    for (const auto& part : tasks[t].parts) {
      const auto same = std::find_if(parts.begin(), parts.end(), [&](const auto& p) { return p.id == part.id; });
      if (same == parts.end())
        parts.push_back(part);
      else
        same->nodes.insert(same->nodes.end(), part.nodes.begin(), part.nodes.end());
    }
  }
  return result;
}

/// Deals variants round-robin, because neighbours tend to cost the same.
std::vector<WorkerTask> dealt(const SweepPlan& plan, const std::vector<bool>& wanted, std::size_t shards) {
  std::vector<WorkerTask> result(shards);
  std::size_t next = 0;
  for (std::size_t v = 0; v < wanted.size(); ++v)
    if (wanted[v]) result[next++ % shards].parts.push_back({plan.variants[v].id, {}});
  return result;
}

struct Call {
  const Submission& submission;
  const SubmitOptions& options;
  fs::path work;  ///< of this submission
};

std::string work_command(const Call& call, const std::string& task, const std::string& threads) {
  const char* plugins = std::getenv("ATRIUM_PLUGIN_PATH");  // NOLINT(concurrency-mt-unsafe)
  return fmt::format("cd {} && {}exec {} sweep work {} {} -j {}", for_shell(call.submission.folder.string()),
                     plugins == nullptr ? "" : fmt::format("export ATRIUM_PLUGIN_PATH={} && ", for_shell(plugins)),
                     for_shell(call.options.program), for_shell(call.options.out.string()), task, threads);
}

SubmitScripts slurm(const Call& call) {
  const Submission& submission = call.submission;
  const SubmitOptions& options = call.options;
  const fs::path& work = call.work;
  SubmitScripts scripts{work / "job.sh", work / "submit.sh", {}, {}};
  scripts.job =
      fmt::format("#!/bin/sh\n# One task of a job array: $1 is its kind.\n{}\n",
                  work_command(call, submission.id + "/\"$1-$SLURM_ARRAY_TASK_ID\"", "\"${SLURM_CPUS_PER_TASK:-1}\""));
  const std::string threads = options.threads > 0 ? fmt::format(" --cpus-per-task={}", options.threads) : "";
  const auto array = [&](std::string_view kind, std::size_t tasks) {
    // In the name of an output file Slurm replaces what follows a "%".
    return fmt::format("sbatch --parsable --job-name={} --array=1-{} --output={}{}",
                       for_shell(fmt::format("{}-{}", submission.sweep.stem().string(), kind)), tasks,
                       for_shell(replaced((work / kind).string(), "%", "%%") + "-%a.log"), threads);
  };
  const std::string job = " " + for_shell(scripts.job_file.string()) + " ";
  const std::string more = for_shell(options.engine_options);
  scripts.submit = "#!/bin/sh\nset -e\n";
  std::string after;
  if (submission.shared > 0) {
    scripts.submit += fmt::format("shared=$({}{}{}shared)\n", array("shared", submission.shared), more, job);
    after = " --dependency=\"afterany:${shared%%;*}\"";
  }
  scripts.submit += fmt::format("{}{}{}{}shard\n", array("shard", submission.shards), after, more, job);
  return scripts;
}

SubmitScripts parallel(const Call& call) {
  const Submission& submission = call.submission;
  const SubmitOptions& options = call.options;
  const fs::path& work = call.work;
  SubmitScripts scripts{work / "job.sh", work / "submit.sh", {}, {}};
  scripts.job =
      fmt::format("#!/bin/sh\n# One task: $1 is its kind, $2 its number.\nexec >>{}/\"$1-$2.log\" 2>&1\n{}\n",
                  for_shell(work.string()),
                  work_command(call, submission.id + "/\"$1-$2\"", std::to_string(std::max(options.threads, 1))));
  // Without a command parallel runs its input lines as they are: nothing in a path is replaced ({} in a command is).
  const auto stage = [&](std::string_view kind, std::size_t tasks) {
    return fmt::format("for task in $(seq {}); do printf '%s %s\\n' {} \"{} $task\"; done | parallel --joblog {}{}\n",
                       tasks, for_shell("sh " + for_shell(scripts.job_file.string())), kind,
                       for_shell((work / fmt::format("{}.joblog", kind)).string()), for_shell(options.engine_options));
  };
  // The number of jobs that failed is no failure of the submission: `gather` says what became of the variants.
  scripts.submit = "#!/bin/sh\n";
  if (submission.shared > 0) scripts.submit += stage("shared", submission.shared);
  scripts.submit += stage("shard", submission.shards);
  return scripts;
}

/// Without a cache there is nothing through which a beginning could be shared.
std::vector<WorkerTask> shared_tasks(const SweepPlan& plan, const std::vector<bool>& wanted, std::size_t most,
                                     Cache* cache) {
  if (cache == nullptr) return {};
  std::vector<bool> done = wanted;
  done.flip();
  return packed(shared_beginnings(plan, wanted, forecast(plan, done, cache).cached_nodes()),
                std::max<std::size_t>(1, most));
}

void begin_variants(const SweepFile& sweep, const SweepPlan& plan, const std::vector<bool>& wanted,
                    const fs::path& out) {
  for (std::size_t v = 0; v < wanted.size(); ++v) {
    if (!wanted[v]) continue;
    const SweepVariant& variant = plan.variants[v];
    begin_variant(out, plan, variant);
    write_note(variant_folder(out, variant), note_of(plan, variant, name_of(sweep, variant)));
  }
}

void write_tasks(const fs::path& work, std::string_view kind, const std::vector<WorkerTask>& tasks) {
  for (std::size_t t = 0; t < tasks.size(); ++t)
    write_file(work / fmt::format("{}-{}", kind, t + 1), task_text(tasks[t]));
}

}  // namespace

void write_submission(const fs::path& out, const Submission& s) {
  write_file(out / farm_folder / record_name, json_text(fields_json(s, fields), 1) + "\n");
}

Submission read_submission(const fs::path& out) {
  const fs::path file = out / farm_folder / record_name;
  const Json json = read_json_file(file);
  try {
    Submission submission;
    read_fields(json, submission, fields);
    return submission;
  } catch (const Json::exception&) {
    throw Error(out.string() + " is not the folder of a sweep that was submitted",
                "`atrium sweep submit FILE --out DIR` makes one");
  }
}

SubmitScripts prepare_submission(const SweepFile& sweep, const SweepPlan& plan, Submission submission,
                                 const SubmitOptions& options) {
  if (const auto& text = options.out.native(); text.find('\n') != std::string::npos)
    throw FolderError("the folder's name has a line break: " + text, "choose another folder with --out");
  submission.time = epoch_seconds();
  submission.id = fmt::format("{:%Y%m%dT%H%M%S}-{}", fmt::gmtime(std::time(nullptr)), ::getpid());
  std::vector<bool> wanted;
  for (const auto& done : done_variants(options.out, plan, submission.build)) wanted.push_back(!done);
  const auto count = static_cast<std::size_t>(std::count(wanted.begin(), wanted.end(), true));
  for (const auto& variant : plan.variants) submission.variants.push_back(variant.id);
  submission.shards = std::min(count, options.shards > 0 ? options.shards : usual_shards);
  const auto shared = shared_tasks(plan, wanted, submission.shards, options.cache);
  submission.shared = shared.size();
  const Call call{submission, options, options.out / farm_folder / submission.id};
  SubmitScripts scripts = submission.engine == "slurm" ? slurm(call) : parallel(call);
  scripts.variants = count;
  if (options.dry || count == 0) return scripts;
  const SweepFolder folder(options.out, sweep);
  std::error_code ignored;
  fs::remove_all(options.out / farm_folder, ignored);
  fs::create_directories(call.work, ignored);
  begin_variants(sweep, plan, wanted, options.out);
  write_tasks(call.work, "shared", shared);
  write_tasks(call.work, "shard", dealt(plan, wanted, submission.shards));
  write_submission(options.out, submission);
  write_file(scripts.job_file, scripts.job);
  write_file(scripts.submit_file, scripts.submit);
  return scripts;
}

}  // namespace atrium
