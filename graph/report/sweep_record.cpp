#include "graph/report/sweep_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "graph/api/files.hpp"
#include "graph/api/json_text.hpp"
#include "graph/report/csv.hpp"
#include "graph/run/run_folder.hpp"

namespace atrium::report {
namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;
using Cell = SweepRecord::Cell;

Cell cell_of(const std::string& text) {
  if (text.empty()) return {};
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc() && end == text.data() + text.size() && number - number == 0) return number;
  return text;
}

Cell cell_of(const Fact& fact) {
  if (const auto* text = std::get_if<std::string>(&fact.value)) return *text;
  double number = 0;
  std::visit(
      [&](const auto& value) {
        if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(value)>>) number = static_cast<double>(value);
      },
      fact.value);
  if (number - number != 0) return fmt::format("{}", number);
  return number;
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

/// "time [s]": the name and its unit.
SweepRecord::Metric split_title(const std::string& title) {
  const auto open = title.rfind(" [");
  if (open == std::string::npos || !title.ends_with(']')) return {title, "", {}};
  return {title.substr(0, open), title.substr(open + 2, title.size() - open - 3), {}};
}

/// The columns of a sweep's table before its metrics: id, axes, and of random samples what was drawn.
std::vector<std::string> leading_columns(const SweepRecord& record) {
  std::vector<std::string> columns{"id"};
  for (const auto& axis : record.axes) {
    columns.push_back(axis.name);
    if (axis.name != "sample" || axis.choices.empty()) continue;
    for (const auto& [target, value] : axis.choices.front().set) columns.push_back(target);
  }
  return columns;
}

bool has_choice(const SweepRecord::Axis& axis, const std::string& label) {
  return std::any_of(axis.choices.begin(), axis.choices.end(),
                     [&](const auto& choice) { return choice.label == label; });
}

using Rows = std::vector<std::vector<std::string>>;

/// Whether the table is one of these axes: it is not if the sweep was changed, begun again and killed.
bool is_table_of(const SweepRecord& record, const Rows& rows) {
  const auto columns = leading_columns(record);
  if (rows.empty() || rows.front().size() <= columns.size() ||
      !std::equal(columns.begin(), columns.end(), rows.front().begin()))
    return false;
  return std::all_of(rows.begin() + 1, rows.end(), [&](const auto& row) {
    std::size_t column = 0;
    return row.size() == rows.front().size() &&
           std::all_of(record.axes.begin(), record.axes.end(), [&](const auto& axis) {
             while (columns[++column] != axis.name) {  // what was drawn
             }
             return has_choice(axis, row[column]);
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

void read_table(const fs::path& folder, const Rows& rows, SweepRecord& record) {
  const std::size_t first = leading_columns(record).size();
  std::vector<SweepRecord::Metric> metrics;
  for (std::size_t c = first; c + 1 < rows.front().size(); ++c) {
    metrics.push_back(split_title(rows.front()[c]));
    for (const auto& known : record.metrics)
      if (known.name == metrics.back().name) metrics.back().digits = known.digits;
  }
  record.metrics = std::move(metrics);
  for (std::size_t r = 1; r < rows.size(); ++r) {
    const auto& row = rows[r];
    auto& variant = record.variants.emplace_back();
    variant.run.id = row.front();
    std::size_t column = 1;
    std::vector<std::pair<std::string, std::string>> choices;
    for (const auto& axis : record.axes) {
      choices.emplace_back(axis.name, row[column]);
      column += 1 + (axis.name == "sample" && !axis.choices.empty() ? axis.choices.front().set.size() : 0);
    }
    read_variant(folder / "variants" / row.front(), row.back(), record, variant);
    variant.run.choices = std::move(choices);
    for (std::size_t c = first; c + 1 < row.size(); ++c) variant.cells.push_back(cell_of(row[c]));
  }
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
    if (fs::exists(entry.path() / "result.json")) folders.push_back(entry.path());
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
    const fs::path table = folder / "table.csv";
    const Rows rows = fs::exists(table) ? read_csv(read_text(table)) : Rows{};
    if (is_table_of(record, rows))
      read_table(folder, rows, record);
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
