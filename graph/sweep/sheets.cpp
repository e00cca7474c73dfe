#include "graph/sweep/sheets.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "graph/pipeline/find_pipeline.hpp"

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

YamlNode scalar(const std::string& text) {
  YamlNode node{YamlNode::Kind::scalar};
  node.text = text;
  node.quoted = true;
  return node;
}

YamlNode list(const std::vector<std::string>& texts) {
  YamlNode node{YamlNode::Kind::sequence};
  for (const auto& text : texts) node.items.push_back(scalar(text));
  return node;
}

}  // namespace

std::vector<std::string> write_sheets(const SweepFile& sweep, const SweepPlan& plan,
                                      const std::vector<VariantResult>& results, Registry& registry,
                                      const SweepOptions& options) {
  std::vector<std::string> problems;
  if (sweep.sheets.empty()) return problems;
  const std::filesystem::path out = std::filesystem::absolute(options.out);
  for (const auto& sheet : sweep.sheets) {
    std::vector<std::string> files;
    std::vector<std::string> captions;
    for (std::size_t v = 0; v < results.size(); ++v) {
      if (!is_shown(sweep, plan.variants[v])) continue;
      files.push_back((out / "variants" / plan.variants[v].id / sheet.picture).string());
      captions.push_back(caption_of(sweep, plan.variants[v]) + (results[v].status == VariantStatus::ok
                                                                    ? ""
                                                                    : ": " + std::string(name_of(results[v].status))));
    }
    const std::string columns = std::to_string(columns_of(sweep, sheet)), width = std::to_string(sheet.cell_width);
    LoadResult made = load_pipeline(installed_pipelines() / "sheet.yaml",
                                    {{"files=", {}, {}, list(files)},
                                     {"captions=", {}, {}, list(captions)},
                                     {"path=", {}, {}, scalar(sheet.file)},
                                     {"columns=" + columns, {}, {}},
                                     {"cell_width=" + width, {}, {}}},
                                    registry);
    for (const auto& error : made.errors) problems.push_back(fmt::format("{}: {}", sheet.file, to_string(error)));
    if (!made.errors.empty()) continue;
    for (const std::size_t n : all_nodes(made.pipeline)) made.pipeline[n].folder = out;
    RunOptions run_options;
    run_options.threads = options.threads;
    ProgressSink silent;
    for (const auto& failure : run_pipeline(made.pipeline, run_options, silent).failures)
      problems.push_back(fmt::format("{}: {}", sheet.file, failure.message));
  }
  return problems;
}

}  // namespace atrium
