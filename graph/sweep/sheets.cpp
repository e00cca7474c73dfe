#include "graph/sweep/sheets.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace atrium {
namespace {

/// As many columns as the last axis that varies (but the seeds) has choices.
std::int64_t columns_of(const SweepFile& sweep, const SweepSheet& sheet) {
  if (sheet.columns > 0) return sheet.columns;
  for (auto axis = sweep.axes.rbegin(); axis != sweep.axes.rend(); ++axis)
    if (axis->choices.size() > 1 && axis->name != "seed")
      return std::min<std::int64_t>(static_cast<std::int64_t>(axis->choices.size()), 20);
  return 1;
}

/// Of variants that differ in their seed only the first one has a picture.
bool is_shown(const SweepFile& sweep, const SweepVariant& variant) {
  for (std::size_t a = 0; a < sweep.axes.size(); ++a)
    if (sweep.axes[a].name == "seed" && variant.choices[a] != 0) return false;
  return true;
}

void set(PipelineNode& node, std::string_view name, const ParamValue& value) {
  for (std::size_t i = 0; i < node.params.size(); ++i)
    if (node.type->params[i].name == name) node.params[i] = value;
}

PipelineNode make_node(const std::string& path, const NodeType& type) {
  PipelineNode node{path, &type};
  for (const auto& param : type.params) node.params.push_back(param.initial);
  return node;
}

}  // namespace

std::vector<std::string> write_sheets(const SweepFile& sweep, const SweepPlan& plan,
                                      const std::vector<VariantResult>& results, Registry& registry,
                                      const SweepOptions& options) {
  std::vector<std::string> problems;
  if (sweep.sheets.empty()) return problems;
  const NodeType* read = registry.find("render.read_pictures");
  const NodeType* sheet_type = registry.find("render.contact_sheet");
  if (read == nullptr || sheet_type == nullptr)
    return {"the sweep's pictures need the plugin 'render', which is not there"};
  for (const auto& sheet : sweep.sheets) {
    std::vector<std::string> files;
    std::vector<std::string> captions;
    for (std::size_t v = 0; v < results.size(); ++v) {
      if (!is_shown(sweep, plan.variants[v])) continue;
      files.push_back(
          (std::filesystem::absolute(options.out) / "variants" / plan.variants[v].id / sheet.picture).string());
      captions.push_back(caption_of(sweep, plan.variants[v]) + (results[v].status == VariantStatus::ok
                                                                    ? ""
                                                                    : ": " + std::string(name_of(results[v].status))));
    }
    Pipeline pipeline;
    PipelineNode reader = make_node("read", *read);
    set(reader, "files", files);
    set(reader, "captions", captions);
    PipelineNode writer = make_node("sheet", *sheet_type);
    set(writer, "path", sheet.file);
    set(writer, "columns", columns_of(sweep, sheet));
    set(writer, "cell_width", sheet.cell_width);
    writer.folder = std::filesystem::absolute(options.out);
    const std::size_t from = add_node(reader, pipeline);
    connect({from, 0}, add_node(writer, pipeline), 0, 0, pipeline);
    RunOptions run_options;
    run_options.threads = options.threads;
    ProgressSink silent;
    for (const auto& failure : run_pipeline(pipeline, run_options, silent).failures)
      problems.push_back(fmt::format("{}: {}", sheet.file, failure.message));
  }
  return problems;
}

}  // namespace atrium
