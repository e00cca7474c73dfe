// One task of a sweep that was submitted.
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <map>
#include <nlohmann/json.hpp>
#include <system_error>

#include "graph/api/files.hpp"
#include "graph/api/json_text.hpp"
#include "graph/api/text.hpp"
#include "graph/farm/submission.hpp"
#include "graph/sweep/isolated_run.hpp"
#include "graph/sweep/merge.hpp"
#include "graph/sweep/recorder.hpp"
#include "graph/sweep/sweep_folder.hpp"

namespace atrium {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
constexpr double sign_of_life = 5;  // seconds

WorkerTask read_task_file(const fs::path& file) {
  if (!fs::exists(file))
    throw Error("there is no task " + file.string(), "the sweep was submitted again, or run here, since");
  return read_task(read_text(file), file.string());
}

/// What is worth joining later: not how far a node is.
bool is_kept(const Json& event) {
  const std::string kind = event.value("e", "");
  if (kind == "finished") return event.at("record").value("status", "") != "ok";
  return kind != "started" && kind != "share" && kind != "said";
}

}  // namespace

Journal::Journal(const fs::path& file) : file_(::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666)) {
  if (file_ < 0) throw Error("cannot write " + file.string() + ": " + std::generic_category().message(errno));
}

Journal::~Journal() { ::close(file_); }

void Journal::write(const std::string& process, const Json& event) {
  Json line{{"p", process}};
  line.update(event);
  const std::string text = json_text(line) + "\n";
  // At once: a line that is cut off because the machine died is left out by who reads it.
  if (::write(file_, text.data(), text.size()) != static_cast<ssize_t>(text.size()))
    throw Error("cannot write the journal of a shard: " + std::generic_category().message(errno));
}

void Journal::alive() {
  const double now = epoch_seconds();
  if (now - touched_ < sign_of_life) return;
  touched_ = now;
  ::futimens(file_, nullptr);
}

void run_shard(const fs::path& out, const std::string& name, const std::string& program, int threads,
               const std::string& build, const std::atomic<bool>* cancel, Registry& registry, ProgressSink& progress) {
  const Submission submission = read_submission(out);
  const WorkerTask task = read_task_file(out / farm_folder / name);
  if (build != submission.build)
    throw Error(
        "the plugins of this machine, or the libraries that they use, are not those that the sweep was submitted "
        "with",
        "if they were changed since, submit it again (what is done is not done again); else install the same "
        "packages on all machines");
  const SweepFolder folder(out);
  SweepPlan plan;
  VariantMerger merger(plan, folder_of_sweep_file(out));
  std::map<std::string, VariantName> names;
  const bool shared = !task.parts.front().nodes.empty();
  for (const auto& part : task.parts) {
    const Pipeline pipeline = load_variant(out, part.id, registry);
    plan.merged[whole].summary = pipeline[whole].summary;
    merger.add(pipeline, {});
    if (!shared) names.emplace(part.id, read_note(out / "variants" / part.id).name);
  }
  std::vector<bool> wanted;  // a shard that is started a second time goes on where it was
  for (const auto& done : done_variants(out, plan, submission.build)) wanted.push_back(shared || !done);
  Journal journal(out / farm_folder / (name + ".events"));
  journal.write("", {{"e", "shard"}, {"time", epoch_seconds()}, {"host", host_name()}, {"process", ::getpid()}});
  std::unique_ptr<Cache> cache;
  if (!submission.cache.empty()) cache = std::make_unique<Cache>(CacheOptions{submission.cache});
  JoinedRun joined(plan, wanted, epoch_seconds(), progress);
  IsolateOptions options;
  options.out = out;
  options.build = submission.build;
  options.threads = threads;
  options.memory = submission.memory;
  options.isolation = {program, submission.arguments, submission.timeout};
  options.cancel = cancel;
  options.cache = cache.get();
  options.name = [&](const SweepVariant& variant) { return names.at(variant.id); };
  options.journal = [&](const std::string& process, const Json& event) {
    if (is_kept(event)) journal.write(process, event);
  };
  options.on_tick = [&] { journal.alive(); };
  IsolatedRun run(plan, wanted, options, joined);
  if (shared)
    run.run_shared({{name, task}});
  else
    run.run_variants();
  journal.write("", {{"e", "over"}, {"time", epoch_seconds()}});
}

}  // namespace atrium
