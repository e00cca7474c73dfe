#include "graph/sweep/recorder.hpp"

#include <set>

#include "graph/api/error.hpp"
#include "graph/cache/read_file.hpp"
#include "graph/run/run_folder.hpp"
#include "graph/sweep/merge.hpp"

namespace atrium {
namespace {

namespace fs = std::filesystem;

void add_node_result(const PipelineNode& node, const NodeRecord& record, VariantResult& result) {
  const std::string path = address_in_variant(node);
  NodeRecord& shown = result.nodes.emplace_back(record);
  shown.node = path;
  shown.wall = record.computing_wall();
  shown.cpu = record.computing_cpu();
  shown.peak_memory = record.computing_memory();
  shown.because.erase(0, shown.because.find('/') + 1);
  shown.artefacts.clear();  // the variant's record lists them
  if (record.status == NodeStatus::failed && result.message.empty()) result.message = path + ": " + record.message;
  if (record.status == NodeStatus::failed) result.status = VariantStatus::failed;
  if (record.status == NodeStatus::skipped && result.status == VariantStatus::ok) {
    // Its own nodes are all right: one of them was to be run again for a value, and that failed.
    result.status = VariantStatus::failed;
    result.message = path + ": " + record.because + " failed";
  }
  if (record.status == NodeStatus::cancelled && result.status == VariantStatus::ok)
    result.status = VariantStatus::cancelled;
}

}  // namespace

fs::path variant_folder(const fs::path& out, const SweepVariant& variant) { return out / "variants" / variant.id; }

std::vector<std::optional<VariantResult>> done_variants(const fs::path& out, const SweepPlan& plan,
                                                        const std::string& build) {
  std::vector<std::optional<VariantResult>> done;
  for (const auto& variant : plan.variants)
    done.push_back(reusable_result(variant_folder(out, variant), plan, variant, build));
  return done;
}

void begin_variant(const fs::path& out, const SweepPlan& plan, const SweepVariant& variant) {
  const fs::path folder = variant_folder(out, variant);
  std::error_code ignored;
  fs::remove_all(folder, ignored);
  fs::create_directories(folder, ignored);
  write_file(folder / "resolved.yaml", resolved_yaml(variant_pipeline(plan, variant)), false);
}

std::vector<std::size_t> nodes_of(const SweepPlan& plan, const std::vector<bool>& variants) {
  std::set<std::size_t> nodes;
  for (std::size_t v = 0; v < plan.variants.size(); ++v)
    if (variants[v]) nodes.insert(plan.variants[v].nodes.begin(), plan.variants[v].nodes.end());
  return {nodes.begin(), nodes.end()};
}

VariantResult result_of(const SweepPlan& plan, const SweepVariant& variant,
                        const std::function<const NodeRecord&(std::size_t node)>& record) {
  VariantResult result;
  result.status = VariantStatus::ok;
  for (const std::size_t n : variant.nodes) add_node_result(plan.merged[n], record(n), result);
  for (const auto& output : variant.outputs) {
    const NodeRecord& from = record(output.from.node);
    if (from.status == NodeStatus::ok && !from.outputs[output.from.output].facts.empty())
      result.outputs.push_back({output.name, from.outputs[output.from.output].facts});
  }
  return result;
}

Recorder::Recorder(const SweepPlan& plan, const std::vector<bool>& wanted, Options options, ProgressSink& progress)
    : plan_(plan),
      options_(std::move(options)),
      progress_(progress),
      variants_of_(node_count(plan.merged)),
      left_(plan.variants.size(), 0),
      inputs_(plan.variants.size()),
      records_(node_count(plan.merged)),
      variants_(plan.variants.size()) {
  for (const std::size_t n : all_nodes(plan.merged)) index_.emplace(plan.merged[n].path, n);
  for (std::size_t v = 0; v < plan.variants.size(); ++v) {
    if (!wanted[v]) continue;
    left_[v] = plan.variants[v].nodes.size();
    inputs_[v] = state_of_inputs(plan, plan.variants[v]);
    for (const std::size_t n : plan.variants[v].nodes) variants_of_[n].push_back(v);
  }
}

void Recorder::finished(const NodeRecord& record) {
  progress_.finished(record);
  if (record.status != NodeStatus::ok) settle(record);
}

void Recorder::described(const NodeRecord& record) {
  progress_.described(record);
  settle(record);
}

/// Variants that were recorded with the node are not done any more.
void Recorder::reopened(const std::string& node) {
  progress_.reopened(node);
  const std::lock_guard lock(mutex_);
  for (const std::size_t v : variants_of_[index_.at(node)]) {
    if (left_[v]++ > 0) continue;
    std::error_code ignored;
    fs::remove(variant_folder(options_.out, plan_.variants[v]) / "result.json", ignored);
  }
}

const PngStamp& Recorder::stamp_of_variant(const PipelineNode& node) {
  const std::lock_guard lock(mutex_);
  const auto [known, fresh] = stamps_.try_emplace(node.folder.filename().string());
  if (fresh)
    for (const auto& variant : plan_.variants)
      if (variant.id == known->first) known->second = stamp_of(variant_pipeline(plan_, variant));
  return known->second;
}

void Recorder::settle(const NodeRecord& record) {
  const std::size_t n = index_.at(record.node);
  std::vector<std::size_t> done;
  {
    const std::lock_guard lock(mutex_);
    records_[n] = record;
    for (const std::size_t v : variants_of_[n])
      if (--left_[v] == 0) done.push_back(v);
  }
  for (const std::size_t v : done) record_variant(v);  // hashes all of its files: others need not wait for that
}

void Recorder::record_variant(std::size_t v) {
  const SweepVariant& variant = plan_.variants[v];
  VariantResult& result = variants_[v];
  result = result_of(plan_, variant, [this](std::size_t n) -> const NodeRecord& { return records_[n]; });
  for (const std::size_t n : variant.nodes)
    for (const auto& artefact : records_[n].artefacts) add_artefact(variant, n, artefact, result);
  if (result.status == VariantStatus::failed && ++failures_ >= options_.max_failures) stop_ = true;
  if (result.status == VariantStatus::cancelled) return;  // it is done anew next time
  if (state_of_inputs(plan_, variant) != inputs_[v])
    progress_.message(variant.id, "a file that it reads was changed meanwhile: it is run again next time", true);
  write_result(variant_folder(options_.out, variant), options_.name(variant), plan_, variant, result, options_.build,
               inputs_[v]);
}

/// A file that another variant's node wrote for both is linked, so that each variant's folder is complete.
void Recorder::add_artefact(const SweepVariant& variant, std::size_t n, const Artefact& artefact,
                            VariantResult& result) {
  const fs::path folder = plan_.merged[n].folder;
  const fs::path relative = fs::path(artefact.path).lexically_relative(folder);
  if (relative.empty() || *relative.begin() == "..")
    return;  // a node that writes elsewhere: it is in no variant's folder
  result.artefacts.push_back({relative.generic_string(), artefact.bytes});
  const fs::path target = variant_folder(options_.out, variant) / relative;
  const fs::path source = options_.out / artefact.path;
  std::error_code error;
  if (source == target || fs::equivalent(source, target, error)) return;
  fs::remove(target, error);  // of a node that was run again since
  fs::create_directories(target.parent_path(), error);
  fs::create_hard_link(source, target, error);
  if (!error) return;
  try {
    copy_hashed(ReadFile(source), target);
  } catch (const Error& problem) {
    result.status = VariantStatus::failed;
    if (result.message.empty()) result.message = problem.what();
  }
}

}  // namespace atrium
