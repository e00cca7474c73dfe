#include "graph/sweep/sweep_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>

#include "graph/api/suggest.hpp"
#include "graph/api/text.hpp"
#include "graph/pipeline/document.hpp"
#include "graph/pipeline/file_reader.hpp"
#include "graph/pipeline/files_of.hpp"
#include "graph/pipeline/find_pipeline.hpp"
#include "graph/sweep/samples.hpp"

namespace atrium {
namespace {

YamlNode scalar_node(std::string text) {
  YamlNode node;
  node.kind = YamlNode::Kind::scalar;
  node.text = std::move(text);
  return node;
}

class SweepReader : FileReader {
 public:
  SweepReader(SweepFile& sweep, Findings& findings) : FileReader(sweep.source, findings), sweep_(sweep) {}

  void read(const YamlNode& root) {
    if (const auto* nodes = root.find("nodes"); nodes != nullptr && root.find("sweep") == nullptr) {
      error(nodes->place, "this is a pipeline, not a sweep file",
            "atrium run FILE; a sweep file names the pipeline that it varies: `sweep: FILE`");
      return;
    }
    check_keys(root,
               {"atrium", "sweep", "summary", "set", "scenes", "seeds", "grid", "zip", "list", "ablate", "random",
                "exclude", "metrics", "pictures"},
               "a sweep file");
    check_format(root);
    read_base(root);
    if (const auto* entry = root.find("summary")) sweep_.summary = scalar(*entry).text;
    if (const auto* entry = root.find("set")) sweep_.settings = settings(*entry);
    read_scenes(root.find("scenes"));
    named_choices(root.find("list"), "variant", {});
    named_choices(root.find("ablate"), "ablation", "everything");
    read_zip(root.find("zip"));
    read_grid(root.find("grid"));
    read_random(root.find("random"));
    read_seeds(root.find("seeds"));
    read_exclude(root.find("exclude"));
    read_metrics(root.find("metrics"));
    read_sheets(root.find("pictures"));
    check_targets();
  }

 private:
  std::optional<std::string> value_text(const YamlNode& node, std::string_view target) {
    if (node.is_scalar()) return node.text;
    const auto is_scalar = [](const YamlNode& item) { return item.is_scalar(); };
    if (node.is_sequence() && std::all_of(node.items.begin(), node.items.end(), is_scalar)) {
      std::string list;
      for (const auto& item : node.items) list += (list.empty() ? "" : ", ") + item.text;
      return "[" + list + "]";
    }
    error(node.place, fmt::format("'{}' must be a value or a list of values", target));
    return std::nullopt;
  }

  std::vector<SweepSetting> settings(const YamlNode::Entry& entry) {
    std::vector<SweepSetting> result;
    for (const auto& item : mapping(&entry, "write `NODE.PARAMETER: value` lines below it"))
      if (auto value = value_text(item.value, item.key))
        result.push_back({item.key, std::move(*value), item.value, item.place});
    return result;
  }

  void read_base(const YamlNode& root) {
    const auto* entry = root.find("sweep");
    if (entry == nullptr) {
      error({}, "this is no sweep file: the key 'sweep' is missing", "`sweep: FILE` names the pipeline that is varied");
      return;
    }
    sweep_.base_place = entry->value.place;
    const std::string text = scalar(*entry).text;
    if (text.empty()) return;
    const NamedPipeline found = find_pipeline(sweep_.source.folder, text);
    sweep_.base = found.path;
    sweep_.base_name =
        found.is_installed
            ? found.path.string()
            : (std::filesystem::path(sweep_.source.name).parent_path() / text).lexically_normal().string();
    std::error_code missing;
    if (!std::filesystem::is_regular_file(sweep_.base, missing))
      error(sweep_.base_place, fmt::format("no such pipeline file: {}", sweep_.base_name),
            help_for_missing_pipeline(sweep_.source.folder, text, findings_) +
                "; a path is relative to the file that it stands in");
  }

  void named_choices(const YamlNode::Entry* section, std::string name, std::string_view first) {
    if (section == nullptr) return;
    SweepAxis axis{std::move(name), {}};
    if (!first.empty()) axis.choices.push_back({std::string(first), {}, section->place});
    for (const auto& entry : mapping(section, "write `NAME: {TARGET: value, …}` lines below it")) {
      const bool nothing = entry.value.is_null() || (entry.value.is_mapping() && entry.value.entries.empty());
      axis.choices.push_back({entry.key, nothing ? std::vector<SweepSetting>{} : settings(entry), entry.place});
    }
    sweep_.axes.push_back(std::move(axis));
  }

  /// Named settings; or `TARGET: FILES`, a folder or a pattern, each file of which is a scene.
  void read_scenes(const YamlNode::Entry* section) {
    const bool files = section != nullptr && section->value.is_mapping() && section->value.entries.size() == 1 &&
                       section->value.entries.front().value.is_scalar();
    if (!files) {
      named_choices(section, "scene", {});
      return;
    }
    const auto& [target, place, value] = section->value.entries.front();
    const auto found = files_of(sweep_.source.folder, value.text);
    if (found.empty())
      error(value.place, fmt::format("no file fits '{}'", value.text),
            "a folder, or a pattern such as scans/*.ply; it is relative to the file that it stands in");
    SweepAxis axis{"scene", {}};
    std::set<std::string> stems, names;
    for (const auto& file : found) {
      stems.insert(file.stem().string());
      names.insert(file.filename().string());
      if (first_not_text(file.string()) != std::string::npos)
        error(value.place, fmt::format("the name of a file is not UTF-8: {}", with_escapes(file.string())),
              "files name everything in UTF-8: rename the file (convmv does it for many)");
    }
    for (const auto& file : found) {
      const std::string label = stems.size() == found.size()   ? file.stem().string()
                                : names.size() == found.size() ? file.filename().string()
                                                               : file.lexically_relative(sweep_.source.folder).string();
      axis.choices.push_back(
          {label, {{target, file.string(), scalar_node(with_escapes(file.string())), place}}, place});
    }
    sweep_.axes.push_back(std::move(axis));
  }

  /// `TARGET: [value, …]`. A value may itself be a list.
  std::vector<SweepChoice> values(const YamlNode::Entry& entry) {
    std::vector<SweepChoice> choices;
    if (!entry.value.is_sequence() || entry.value.items.empty()) {
      error(entry.value.place, fmt::format("'{}' must be a list of values", entry.key));
      return choices;
    }
    for (const auto& item : entry.value.items)
      if (auto value = value_text(item, entry.key))
        choices.push_back({item.is_scalar() ? item.text : *value, {{entry.key, *value, item, item.place}}, item.place});
    return choices;
  }

  void read_grid(const YamlNode::Entry* section) {
    for (const auto& entry : mapping(section, "write `TARGET: [value, …]` lines below it"))
      sweep_.axes.push_back({entry.key, values(entry)});
  }

  void read_zip(const YamlNode::Entry* section) {
    SweepAxis axis;
    for (const auto& entry : mapping(section, "write `TARGET: [value, …]` lines below it")) {
      auto column = values(entry);
      axis.name += (axis.name.empty() ? "" : ", ") + entry.key;
      if (axis.choices.empty()) {
        axis.choices = std::move(column);
        continue;
      }
      if (column.size() != axis.choices.size()) {
        error(entry.place, fmt::format("'{}' has {} values, but the first of the zip has {}", entry.key, column.size(),
                                       axis.choices.size()));
        continue;
      }
      for (std::size_t i = 0; i < column.size(); ++i) {
        axis.choices[i].label += ", " + column[i].label;
        axis.choices[i].settings.push_back(std::move(column[i].settings.front()));
      }
    }
    if (!axis.choices.empty()) sweep_.axes.push_back(std::move(axis));
  }

  void read_random(const YamlNode::Entry* section) {
    if (section == nullptr) return;
    if (!section->value.is_mapping()) {
      error(section->value.place, "'random' must be a mapping",
            "{samples: 20, seed: 1, of: {TARGET: {uniform: [a, b]}}}");
      return;
    }
    check_keys(section->value, {"samples", "seed", "of"}, "'random'");
    const auto* samples = section->value.find("samples");
    const auto* of = section->value.find("of");
    const auto* seed = section->value.find("seed");
    if (samples == nullptr || of == nullptr) {
      error(section->place, fmt::format("'random' lacks '{}'", samples == nullptr ? "samples" : "of"),
            "{samples: 20, seed: 1, of: {TARGET: {uniform: [a, b]}}}");
      return;
    }
    const auto count = whole(*samples, 1, 100'000);
    const auto start = seed == nullptr ? std::optional<std::int64_t>(1) : whole(*seed, 0, INT64_MAX);
    if (!count || !start) return;
    SweepAxis axis{"sample", {}};
    for (std::int64_t i = 0; i < *count; ++i) axis.choices.push_back({std::to_string(i + 1), {}, section->place});
    for (const auto& entry : mapping(of, "write `TARGET: {uniform: [low, high]}` lines below it")) {
      try {
        const Distribution distribution = read_distribution(entry.value);
        for (std::size_t i = 0; i < axis.choices.size(); ++i) {
          std::string drawn = sample(distribution, static_cast<std::uint64_t>(*start), entry.key, i);
          axis.choices[i].settings.push_back({entry.key, drawn, scalar_node(drawn), entry.place});
        }
      } catch (const Error& problem) {
        error(entry.value.place, fmt::format("'{}' {}", entry.key, problem.what()), problem.help());
      }
    }
    sweep_.axes.push_back(std::move(axis));
  }

  void read_seeds(const YamlNode::Entry* section) {
    if (section == nullptr) return;
    SweepAxis axis{"seed", values(*section)};
    for (auto& choice : axis.choices)
      for (auto& setting : choice.settings) setting.target = "seed";
    sweep_.axes.push_back(std::move(axis));
  }

  void read_exclude(const YamlNode::Entry* section) {
    if (section == nullptr) return;
    if (!section->value.is_sequence()) {
      error(section->value.place, "'exclude' must be a list", "as in `- {scene: office, planes.distance: 1 cm}`");
      return;
    }
    for (const auto& item : section->value.items) {
      YamlNode::Entry entry{"exclude", item.place, item};
      auto conditions = settings(entry);
      for (auto& condition : conditions)
        if (const auto* value = item.find(condition.target); value != nullptr && value->value.is_scalar())
          condition.value = value->value.text;
      sweep_.exclude.push_back(std::move(conditions));
    }
  }

  void read_metrics(const YamlNode::Entry* section) {
    for (const auto& entry : mapping(section, "write `NAME: OUTPUT.METRIC` lines below it")) {
      SweepMetric metric;
      metric.name = entry.key;
      metric.place = entry.place;
      if (entry.value.is_mapping())
        read_metric(entry.value, metric);
      else
        set_fact(metric, scalar(entry).text);
      sweep_.metrics.push_back(std::move(metric));
    }
  }

  static void set_fact(SweepMetric& metric, const std::string& text) {
    const std::size_t dot = text.find('.');
    metric.output = text.substr(0, dot);
    if (dot != std::string::npos) metric.fact = text.substr(dot + 1);
  }

  void read_metric(const YamlNode& node, SweepMetric& metric) {
    check_keys(node, {"of", "seconds", "memory", "unit", "digits"}, "a metric");
    const auto* of = node.find("of");
    const auto* seconds = node.find("seconds");
    const auto* memory = node.find("memory");
    if ((of != nullptr) + (seconds != nullptr) + (memory != nullptr) != 1) {
      error(metric.place, fmt::format("the metric '{}' needs one of 'of', 'seconds' and 'memory'", metric.name),
            "{of: OUTPUT.METRIC}, {seconds: NODE} or {memory: NODE}");
      return;
    }
    if (of != nullptr) {
      set_fact(metric, scalar(*of).text);
    } else {
      metric.kind = seconds != nullptr ? SweepMetric::Kind::time : SweepMetric::Kind::memory;
      const auto* cost = seconds != nullptr ? seconds : memory;
      if (!cost->value.is_null()) metric.node = scalar(*cost).text;
      if (metric.node == "all") metric.node.clear();
    }
    if (const auto* unit = node.find("unit")) metric.unit = scalar(*unit).text;
    if (const auto* digits = node.find("digits"))
      if (const auto value = whole(*digits, 0, 12)) metric.digits = static_cast<int>(*value);
  }

  void read_sheets(const YamlNode::Entry* section) {
    for (const auto& entry : mapping(section, "write `SHEET.png: PICTURE.png` lines below it")) {
      SweepSheet sheet{entry.key, {}};
      sheet.place = entry.place;
      if (entry.key.find('/') != std::string::npos || !entry.key.ends_with(".png") || entry.key.size() < 5)
        error(entry.place, fmt::format("'{}' cannot be the file of a sheet", entry.key),
              "a name that ends with .png; it is written into the sweep's folder");
      if (!entry.value.is_mapping()) {
        sheet.picture = scalar(entry).text;
      } else {
        check_keys(entry.value, {"picture", "columns", "cell_width"}, "a sheet");
        if (const auto* picture = entry.value.find("picture"))
          sheet.picture = scalar(*picture).text;
        else
          error(entry.place, fmt::format("the sheet '{}' names no picture", entry.key), "{picture: FILE.png}");
        if (const auto* columns = entry.value.find("columns")) sheet.columns = whole(*columns, 1, 20).value_or(1);
        if (const auto* width = entry.value.find("cell_width")) sheet.cell_width = whole(*width, 64, 4096).value_or(64);
      }
      sweep_.sheets.push_back(std::move(sheet));
    }
  }

  /// Two axes that set the same thing would overrule each other.
  void check_targets() {
    struct Setter {
      std::string target, by;
    };
    std::vector<Setter> setters;
    const auto claim = [&](const SweepSetting& setting, const std::string& by) {
      for (const auto& other : setters) {
        if (other.target != setting.target || other.by == by) continue;
        error(setting.place, fmt::format("'{}' is set by '{}' and by '{}'", setting.target, other.by, by),
              "each thing is varied in one place");
        return;
      }
      setters.push_back({setting.target, by});
    };
    for (const auto& setting : sweep_.settings) claim(setting, "set");
    for (const auto& axis : sweep_.axes)
      for (const auto& choice : axis.choices)
        for (const auto& setting : choice.settings) {
          const auto known = [&](const Setter& s) { return s.target == setting.target && s.by == axis.name; };
          if (std::none_of(setters.begin(), setters.end(), known)) claim(setting, axis.name);
        }
  }

  SweepFile& sweep_;
};

}  // namespace

std::unique_ptr<SweepFile> read_sweep(const std::filesystem::path& path, const std::string& name, Findings& findings) {
  auto sweep = std::make_unique<SweepFile>();
  sweep->path = path;
  sweep->source = {name, path.parent_path(), 0};
  const YamlTree tree = read_yaml(path.string());
  for (const auto& problem : tree.problems)
    findings.error({&sweep->source, problem.place}, problem.message, problem.help);
  if (!tree.root) return sweep;
  if (tree.root->is_mapping())
    SweepReader(*sweep, findings).read(*tree.root);
  else
    findings.error({&sweep->source, tree.root->place}, "a sweep file is a mapping of keys to values",
                   "it begins with `atrium: 1`");
  return sweep;
}

}  // namespace atrium
