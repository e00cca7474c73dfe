#include "graph/sweep/worker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "graph/api/clocks.hpp"
#include "graph/api/json_text.hpp"
#include "graph/cache/build_ids.hpp"
#include "graph/run/run_folder.hpp"
#include "graph/run/scheduler.hpp"
#include "graph/sweep/merge.hpp"
#include "graph/sweep/recorder.hpp"

namespace atrium {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// The nodes that are to be run: what the task names and what that reads, without what is to be skipped and what
/// depends on it.
std::vector<std::size_t> wanted_nodes(const WorkerTask& task, const SweepPlan& plan,
                                      const std::vector<std::string>& skipped) {
  const Dataflow& graph = plan.merged;
  std::vector<bool> wanted(node_count(graph), false);
  for (std::size_t p = 0; p < task.parts.size(); ++p) {
    const auto& part = task.parts[p];
    for (const std::size_t n : plan.variants[p].nodes) {
      const std::string address = address_in_variant(graph[n]);
      if (part.nodes.empty() || std::find(part.nodes.begin(), part.nodes.end(), address) != part.nodes.end())
        wanted[n] = true;
    }
  }
  wanted = with_sources(wanted, graph);
  std::vector<bool> without(node_count(graph), false);
  for (const std::size_t n : all_nodes(graph))
    without[n] = std::find(skipped.begin(), skipped.end(), graph[n].path) != skipped.end();
  without = with_readers(without, graph);
  std::vector<std::size_t> nodes;
  for (const std::size_t n : all_nodes(graph))
    if (wanted[n] && !without[n]) nodes.push_back(n);
  return nodes;
}

/// Pictures that show other variants than the one that runs, read before anything runs.
class Stamps {
 public:
  Stamps(const std::vector<VariantNote>& notes, const SweepPlan& plan, const fs::path& sweep, Registry& registry) {
    for (std::size_t v = 0; v < notes.size(); ++v)
      for (const auto& [node, id] : notes[v].stamps) {
        const auto [known, fresh] = stamps_.try_emplace(id);
        if (fresh) known->second = stamp_of(load_variant(sweep, id, registry));
        of_node_.emplace(plan.variants[v].id + "/" + node, id);
      }
  }
  const PngStamp* of(const PipelineNode& node) const {
    const auto found = of_node_.find(node.path);
    return found == of_node_.end() ? nullptr : &stamps_.at(found->second);
  }

 private:
  std::map<std::string, PngStamp> stamps_;
  std::map<std::string, std::string> of_node_;
};

}  // namespace

VariantNote read_note(const fs::path& folder) {
  const fs::path file = folder / "variant.json";
  const Json json = read_json_file(file);
  try {
    VariantNote note{{json.at("variant").get<std::string>(), {}}, {}};
    for (const auto& [axis, choice] : json.at("choices").items())
      note.name.choices.emplace_back(axis, choice.get<std::string>());
    for (const auto& [node, id] : json.at("pictures_show").items())
      note.stamps.emplace_back(node, id.get<std::string>());
    return note;
  } catch (const Json::exception&) {
    throw Error(file.string() + " cannot be read",
                "it is written by `atrium sweep run --isolate` and `atrium sweep submit`");
  }
}

fs::path folder_of_sweep_file(const fs::path& sweep) {
  const Json json = read_json_file(sweep / sweep_mark);
  if (!json.is_object() || !json.contains("sweep") || !json.at("sweep").is_string())
    throw Error(sweep.string() + " is not the folder of a sweep");
  return fs::path(json.at("sweep").get<std::string>()).parent_path();
}

Pipeline load_variant(const fs::path& sweep, const std::string& id, Registry& registry) {
  const fs::path file = sweep / "variants" / id / "resolved.yaml";
  LoadResult loaded = load_pipeline(file, {}, registry);
  if (!loaded.errors.empty()) throw Error(to_string(loaded.errors.front()));
  if (id_of(loaded.pipeline, folder_of_sweep_file(sweep)) != id)
    throw Error(file.string() + " is not that of the variant any more",
                "begin the sweep again: what is done is not done again");
  return loaded.pipeline;
}

std::string task_text(const WorkerTask& task) {
  std::string text;
  for (const auto& part : task.parts) {
    text += part.id;
    for (const auto& node : part.nodes) text += " " + node;
    text += "\n";
  }
  return text;
}

WorkerTask read_task(const std::string& text, const std::string& name) {
  WorkerTask task;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    WorkerTask::Part part;
    if (!(words >> part.id)) continue;
    for (std::string node; words >> node;) part.nodes.push_back(std::move(node));
    task.parts.push_back(std::move(part));
  }
  if (task.parts.empty()) throw Error(name + " names no variant");
  return task;
}

void write_note(const fs::path& folder, const VariantNote& note) {
  Json json{{"variant", note.name.label}, {"choices", Json::object()}, {"pictures_show", Json::object()}};
  for (const auto& [axis, choice] : note.name.choices) json["choices"][axis] = choice;
  for (const auto& [node, id] : note.stamps) json["pictures_show"][node] = id;
  write_file(folder / "variant.json", json_text(json, 1) + "\n", false);
}

void run_worker(const WorkerTask& task, const WorkerOptions& options, Registry& registry, EventSink& events) {
  if (build_of_all(registry) != options.build)
    throw Error("the plugins, or the libraries that they use, were changed since the sweep was begun",
                "begin it again: results of two programs do not go into one table");
  SweepPlan plan;
  VariantMerger merger(plan, folder_of_sweep_file(options.sweep));
  std::vector<VariantNote> notes;
  std::map<std::string, VariantName> names;
  const bool entire = task.parts.front().nodes.empty();
  for (const auto& part : task.parts) {
    const Pipeline pipeline = load_variant(options.sweep, part.id, registry);
    plan.merged[whole].summary = pipeline[whole].summary;
    if (!merger.add(pipeline, {}).fresh) throw Error("the variant " + part.id + " is named twice");
    if (!entire) continue;
    notes.push_back(read_note(options.sweep / "variants" / part.id));
    names.emplace(part.id, notes.back().name);
  }
  const Stamps stamps(notes, plan, options.sweep, registry);
  Recorder recorder(plan, std::vector<bool>(plan.variants.size(), entire),
                    {options.sweep, options.build, ~std::size_t{0},
                     [&](const SweepVariant& variant) { return names.at(variant.id); }},
                    events);
  const Pipeline pipeline = part_of(plan.merged, wanted_nodes(task, plan, options.skipped));
  RunOptions run_options = options.run;
  run_options.out = entire ? options.sweep : options.scratch;
  run_options.stamp = [&](const PipelineNode& node) -> const PngStamp& {
    const PngStamp* stamp = stamps.of(node);
    return stamp != nullptr ? *stamp : recorder.stamp_of_variant(node);
  };
  events.begin();
  RunResult run = Scheduler(pipeline, run_options, entire ? static_cast<ProgressSink&>(recorder) : events).run();
  run.cpu = process_cpu_seconds();  // with what came before
  events.end(run);
}

}  // namespace atrium
