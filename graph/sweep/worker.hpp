#pragma once
#include "graph/sweep/events.hpp"
#include "graph/sweep/result.hpp"

namespace atrium {

/// What one process does of a sweep: whole variants, each recorded in its folder; or some nodes of some variants, which
/// are left in the cache only (the beginnings that others share). As text, one variant in a line: "ID", or "ID NODE
/// NODE …".
struct WorkerTask {
  struct Part {
    std::string id;
    std::vector<std::string> nodes;  ///< empty: the whole variant
  };
  std::vector<Part> parts;
};
std::string task_text(const WorkerTask& task);
/// Throws Error.
WorkerTask read_task(const std::string& text, const std::string& name);

/// variants/ID/variant.json: what a worker must know of its variant besides resolved.yaml.
struct VariantNote {
  VariantName name;
  /// Pictures that are drawn by a node which an earlier variant has too show that variant: node, id.
  std::vector<std::pair<std::string, std::string>> stamps;
};
void write_note(const std::filesystem::path& folder, const VariantNote& note);
/// Throws Error.
VariantNote read_note(const std::filesystem::path& folder);

/// The folder of the sweep file, from which the ids of variants see files. Throws Error.
std::filesystem::path folder_of_sweep_file(const std::filesystem::path& sweep);

/// A variant's pipeline from its folder. Throws Error if it is not that of the variant.
Pipeline load_variant(const std::filesystem::path& sweep, const std::string& id, Registry& registry);

struct WorkerOptions {
  std::filesystem::path sweep;       ///< the sweep's folder
  std::string build;                 ///< what the sweep was begun with: another one is refused
  std::vector<std::string> skipped;  ///< "ID/NODE": not run, nor what depends on it
  std::filesystem::path scratch;     ///< where shared beginnings write their files; of no use afterwards
  RunOptions run;
};

/// Runs a task in this process. Throws Error if a variant's folder is not what the sweep has made it.
void run_worker(const WorkerTask& task, const WorkerOptions& options, Registry& registry, EventSink& events);

}  // namespace atrium
