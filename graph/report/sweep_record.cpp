#include "graph/report/sweep_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "graph/report/csv.hpp"
#include "graph/run/run_folder.hpp"

namespace atrium::report {
namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;
using Cell = SweepRecord::Cell;

std::string read_text(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

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
  const auto json = ordered_json::parse(std::ifstream(file, std::ios::binary), nullptr, false);
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
std::size_t leading_columns(const SweepRecord& record) {
  std::size_t columns = 1;
  for (const auto& axis : record.axes)
    columns += 1 + (axis.name == "sample" && !axis.choices.empty() ? axis.choices.front().set.size() : 0);
  return columns;
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

void read_table(const fs::path& folder, SweepRecord& record) {
  const auto rows = read_csv(read_text(folder / "table.csv"));
  const std::size_t first = leading_columns(record);
  if (rows.empty() || rows.front().size() < first + 1)
    throw Error((folder / "table.csv").string() + " is not the table of " + (folder / "sweep.json").string(),
                "run `atrium sweep run` again with the same --out");
  std::vector<SweepRecord::Metric> metrics;
  for (std::size_t c = first; c + 1 < rows.front().size(); ++c) {
    metrics.push_back(split_title(rows.front()[c]));
    for (const auto& known : record.metrics)
      if (known.name == metrics.back().name) metrics.back().digits = known.digits;
  }
  record.metrics = std::move(metrics);
  for (std::size_t r = 1; r < rows.size(); ++r) {
    const auto& row = rows[r];
    if (row.size() != rows.front().size()) continue;
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

/// Without a table: the variants that are done.
void read_variants(const fs::path& folder, SweepRecord& record) {
  std::vector<fs::path> folders;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder / "variants", none))
    if (fs::exists(entry.path() / "result.json")) folders.push_back(entry.path());
  std::sort(folders.begin(), folders.end());
  for (const auto& path : folders) record.variants.push_back({read_run(path), {}});
  record.notes.emplace_back("The sweep has not ended yet or was killed: only the variants that are done are shown.");
  collect_metrics(record);
}

}  // namespace

SweepRecord read_sweep_folder(const fs::path& folder) {
  SweepRecord record;
  if (!fs::exists(folder)) throw Error("there is no folder " + folder.string());
  if (fs::exists(folder / sweep_mark)) {
    read_axes(folder / sweep_mark, record);
    if (fs::exists(folder / "table.csv"))
      read_table(folder, record);
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
