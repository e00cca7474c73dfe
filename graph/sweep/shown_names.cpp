#include "graph/sweep/shown_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "graph/api/suggest.hpp"

namespace atrium {
namespace {

/// What a number or text is called by itself, as a port's type.
bool is_single(const std::string& type) {
  constexpr std::array single{"Boolean", "Integer", "Number", "Text"};
  return std::find(single.begin(), single.end(), type) != single.end();
}

std::vector<std::string> units_of(SweepMetric::Kind kind) {
  switch (kind) {
    case SweepMetric::Kind::time: return {"s", "ms", "min"};
    case SweepMetric::Kind::memory: return {"B", "MB", "GB"};
    default: return {"m", "cm", "mm", "m2", "m3", "deg", "s", "ms", "min", "B", "MB", "GB", "%"};
  }
}

/// Symbols are too short to guess at: the same in other letters, or none.
std::string unit_meant(const std::string& written, const std::vector<std::string>& known) {
  const auto same = [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
  };
  for (const auto& unit : known)
    if (std::equal(unit.begin(), unit.end(), written.begin(), written.end(), same))
      return fmt::format("did you mean '{}'?", unit);
  return "one of " + join_words(known, 20);
}

}  // namespace

void ShownNames::add(const Pipeline& pipeline) {
  for (const auto& metric : sweep_.metrics) {
    if (metric.kind == SweepMetric::Kind::fact)
      check_output(metric, pipeline);
    else if (!metric.node.empty())
      check_node(metric, pipeline);
  }
  for (const std::size_t n : all_nodes(pipeline)) {
    const PipelineNode& node = pipeline[n];
    for (std::size_t p = 0; p < node.params.size(); ++p)
      if (node.type->params[p].kind == ParamKind::output_path) files_.insert(std::get<std::string>(node.params[p]));
  }
}

void ShownNames::check_output(const SweepMetric& metric, const Pipeline& pipeline) {
  const Where where{&sweep_.source, metric.place};
  const auto& outputs = pipeline[whole].outputs;
  const auto found = std::find_if(outputs.begin(), outputs.end(),
                                  [&](const PipelineOutput& output) { return output.name == metric.output; });
  if (found == outputs.end()) {
    const auto names = words_of(outputs, [](const PipelineOutput& output) { return output.name; });
    const std::string hint = findings_.suggest(metric.output, names);
    findings_.error(where, fmt::format("{} has no output '{}'", sweep_.base_name, metric.output),
                    !hint.empty()   ? hint
                    : names.empty() ? "list what is to be shown under its `outputs:`"
                                    : "its outputs: " + join_words(names, 40));
    return;
  }
  const auto& type = pipeline[found->from.node].type->outputs[found->from.output].type;
  if (is_single(type) && !metric.fact.empty())
    findings_.error(where,
                    fmt::format("the output '{}' is a {}: it has no metric '{}'", metric.output,
                                type == "Text" ? "text" : "single value", metric.fact),
                    fmt::format("write `{}: {}`", metric.name, metric.output));
}

void ShownNames::check_node(const SweepMetric& metric, const Pipeline& pipeline) {
  std::vector<std::string> paths;
  for (const std::size_t n : all_nodes(pipeline)) {
    const std::string& path = pipeline[n].path;
    if (path == metric.node || path.starts_with(metric.node + "/")) return;
    paths.push_back(path);
  }
  const std::string hint = findings_.suggest(metric.node, paths);
  findings_.error({&sweep_.source, metric.place}, fmt::format("a variant has no node '{}'", metric.node),
                  hint.empty() ? "its nodes: " + join_words(paths, 40) : hint);
}

void ShownNames::check_pictures() {
  std::vector<std::string> pictures;
  for (const auto& file : files_)
    if (file.ends_with(".png")) pictures.push_back(file);
  for (const auto& sheet : sweep_.sheets) {
    const std::string picture = std::filesystem::path(sheet.picture).lexically_normal().string();
    if (picture.empty() || files_.contains(picture)) continue;
    const std::string hint = findings_.suggest(picture, pictures);
    findings_.error({&sweep_.source, sheet.place}, fmt::format("no variant writes the picture '{}'", sheet.picture),
                    !hint.empty()      ? hint
                    : pictures.empty() ? "no node of the variants writes pictures: render.snapshot does"
                                       : "their pictures: " + join_words(pictures, 40));
  }
}

void ShownNames::check_units() {
  for (const auto& metric : sweep_.metrics) {
    const auto known = units_of(metric.kind);
    if (metric.unit.empty() || std::find(known.begin(), known.end(), metric.unit) != known.end()) continue;
    findings_.error({&sweep_.source, metric.place},
                    fmt::format("'{}' cannot be shown in '{}'", metric.name, metric.unit),
                    unit_meant(metric.unit, known));
  }
}

}  // namespace atrium
