#include "graph/report/sweep_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "graph/api/fact_json.hpp"
#include "graph/api/files.hpp"
#include "graph/api/json_text.hpp"
#include "graph/run/run_folder.hpp"

namespace atrium::report {
namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;
using Cell = SweepRecord::Cell;

Cell cell_of(const ordered_json& json) {
  if (json.is_number()) return json.get<double>();
  return json.is_string() ? Cell(json.get<std::string>()) : Cell();
}

Cell cell_of(const Fact& fact) {
  const auto number = number_of(fact);
  return number && std::isfinite(*number) ? Cell(*number) : Cell(fact_text(fact));
}

void read_axes(const fs::path& file, SweepRecord& record) {
  const auto json = read_json_file(file);
  if (!json.is_object() || !json.contains("axes"))
    throw Error(file.string() + " does not say what was varied",
                "it was written by an older version: run `atrium sweep run` again with the same --out");
  try {
    record.title = fs::path(json.at("sweep").get<std::string>()).filename().string();
    record.summary = json.value("summary", "");
    for (const auto& axis : json.at("axes")) {
      auto& choices = record.axes.emplace_back(SweepRecord::Axis{axis.at("name").get<std::string>(), {}}).choices;
      for (const auto& choice : axis.at("choices")) {
        auto& set = choices.emplace_back(SweepRecord::Choice{choice.at("label").get<std::string>(), {}}).set;
        for (const auto& [target, value] : choice.at("set").items()) set.emplace_back(target, value.get<std::string>());
      }
    }
    for (const auto& metric : json.at("metrics")) {
      auto& entry = record.metrics.emplace_back();
      entry.name = metric.at("name").get<std::string>();
      if (metric.contains("digits")) entry.digits = metric.at("digits").get<int>();
    }
  } catch (const ordered_json::exception& error) {
    throw Error(file.string() + " cannot be understood: " + error.what());
  }
}

bool has_choice(const SweepRecord::Axis& axis, const std::string& label) {
  return std::any_of(axis.choices.begin(), axis.choices.end(),
                     [&](const auto& choice) { return choice.label == label; });
}

/// The titles of a table's columns of one kind.
std::vector<std::string> titles_of(const ordered_json& table, std::string_view kind) {
  std::vector<std::string> titles;
  for (const auto& column : table.at("columns"))
    if (column.at("kind") == kind) titles.push_back(column.at("title").get<std::string>());
  return titles;
}

/// Whether the table is one of these axes: it is not if the sweep was changed, begun again and killed.
bool is_table_of(const SweepRecord& record, const ordered_json& table) {
  const auto axes = titles_of(table, "axis");
  const auto is_named = [](const SweepRecord::Axis& axis, const std::string& title) { return axis.name == title; };
  if (!std::equal(record.axes.begin(), record.axes.end(), axes.begin(), axes.end(), is_named)) return false;
  const auto& variants = table.at("variants");
  return std::all_of(variants.begin(), variants.end(), [&](const auto& variant) {
    return std::all_of(record.axes.begin(), record.axes.end(), [&](const auto& axis) {
      return has_choice(axis, variant.at(axis.name).template get<std::string>());
    });
  });
}

void read_variant(const fs::path& folder, const std::string& status, SweepRecord& record,
                  SweepRecord::Variant& variant) {
  try {
    const std::string id = variant.run.id;
    variant.run = read_run(folder);
    if (variant.run.id.empty()) variant.run.id = id;
  } catch (const Error& error) {
    const auto colon = status.find(": ");
    variant.run.status = status.substr(0, colon);
    if (colon != std::string::npos) variant.run.message = status.substr(colon + 2);
    if (variant.run.status != "cancelled") record.notes.push_back(error.what());
  }
}

void read_table(const fs::path& folder, const ordered_json& table, SweepRecord& record) {
  std::vector<SweepRecord::Metric> metrics;
  for (const auto& column : table.at("columns")) {
    if (column.at("kind") != "metric") continue;
    metrics.push_back({column.at("name").get<std::string>(), column.at("unit").get<std::string>(), {}});
    for (const auto& known : record.metrics)
      if (known.name == metrics.back().name) metrics.back().digits = known.digits;
  }
  record.metrics = std::move(metrics);
  const auto titles = titles_of(table, "metric");
  for (const auto& row : table.at("variants")) {
    auto& variant = record.variants.emplace_back();
    variant.run.id = row.at("id").get<std::string>();
    if (const auto own = place_inside(folder / "variants", variant.run.id))
      read_variant(*own, row.at("status").get<std::string>(), record, variant);
    else
      record.notes.push_back(fmt::format("Left out: '{}', which is no folder of this sweep.", variant.run.id));
    variant.run.choices.clear();
    for (const auto& axis : record.axes)
      variant.run.choices.emplace_back(axis.name, row.at(axis.name).get<std::string>());
    for (const auto& title : titles) variant.cells.push_back(cell_of(row.at(title)));
  }
}

/// The table that the sweep has left, if it is one of its present axes.
ordered_json table_of(const fs::path& folder, const SweepRecord& record) {
  try {
    auto table = read_json_file(folder / "table.json");
    if (!table.is_discarded() && is_table_of(record, table)) return table;
  } catch (const ordered_json::exception&) {  // somebody else's
  }
  return nullptr;
}

/// Cells from what the variants' outputs show.
void collect_metrics(SweepRecord& record) {
  std::map<std::string, std::size_t> known;
  record.metrics.clear();
  for (const auto& variant : record.variants)
    for (const auto& metric : variant.run.metrics)
      if (known.try_emplace(name_of(metric), record.metrics.size()).second)
        record.metrics.push_back({name_of(metric), metric.fact.unit, {}});
  for (auto& variant : record.variants) {
    variant.cells.assign(record.metrics.size(), {});
    for (const auto& metric : variant.run.metrics) variant.cells[known.at(name_of(metric))] = cell_of(metric.fact);
  }
}

/// Whether the variant is one of the sweep as it is now.
bool is_variant_of(const SweepRecord& record, const RunRecord& run) {
  const auto is_of = [&](const SweepRecord::Axis& axis) {
    return std::any_of(run.choices.begin(), run.choices.end(), [&](const auto& choice) {
      return choice.first == axis.name && has_choice(axis, choice.second);
    });
  };
  return run.choices.size() == record.axes.size() && std::all_of(record.axes.begin(), record.axes.end(), is_of);
}

/// Without a table: the variants that are done.
void read_variants(const fs::path& folder, SweepRecord& record) {
  std::vector<fs::path> folders;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder / "variants", none))
    if (!entry.is_symlink(none) && fs::exists(entry.path() / "result.json", none)) folders.push_back(entry.path());
  std::sort(folders.begin(), folders.end());
  std::size_t others = 0;
  for (const auto& path : folders) {
    RunRecord run = read_run(path);
    if (is_variant_of(record, run))
      record.variants.push_back({std::move(run), {}});
    else
      ++others;
  }
  record.notes.emplace_back("The sweep has not ended yet or was killed: only the variants that are done are shown.");
  if (others > 0)
    record.notes.push_back(
        fmt::format("Left out: {} of what the sweep was before, with other axes or choices.", others));
  collect_metrics(record);
}

}  // namespace

SweepRecord read_sweep_folder(const fs::path& folder) {
  SweepRecord record;
  if (!fs::exists(folder)) throw Error("there is no folder " + folder.string());
  if (fs::exists(folder / sweep_mark)) {
    read_axes(folder / sweep_mark, record);
    if (const auto table = table_of(folder, record); !table.is_null())
      read_table(folder, table, record);
    else
      read_variants(folder, record);
    if (record.variants.empty()) throw Error("no variant of the sweep in " + folder.string() + " is done yet");
    return record;
  }
  if (!fs::exists(folder / "manifest.json") && !fs::exists(folder / "result.json"))
    throw Error(folder.string() + " is the folder of neither a sweep nor a run",
                "`atrium sweep run FILE --out FOLDER` and `atrium run FILE --out FOLDER` make one");
  record.sweep = false;
  auto& variant = record.variants.emplace_back();
  variant.run = read_run(folder);
  if (variant.run.id.empty()) variant.run.id = fs::absolute(folder).lexically_normal().filename().string();
  record.title = variant.run.id;
  collect_metrics(record);
  return record;
}

}  // namespace atrium::report
