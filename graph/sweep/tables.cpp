// The tables of a sweep: one row per variant in full precision, and a short one for people.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "graph/api/fact_json.hpp"
#include "graph/api/suggest.hpp"
#include "graph/sweep/result.hpp"

namespace atrium {
namespace {

using Json = nlohmann::ordered_json;

/// A cell: a number, or a text.
struct Cell {
  std::optional<double> number;
  std::string text;
};

struct Conversion {
  std::string_view from, to;
  double factor;
};
constexpr std::array conversions{Conversion{"m", "cm", 100},       Conversion{"m", "mm", 1000},
                                 Conversion{"", "%", 100},         Conversion{"s", "ms", 1000},
                                 Conversion{"s", "min", 1.0 / 60}, Conversion{"B", "MB", 1e-6},
                                 Conversion{"B", "GB", 1e-9}};

/// The number in the wanted unit; as it is where there is no way to it.
std::pair<double, std::string> converted(double number, const std::string& from, const std::string& to) {
  for (const auto& c : conversions)
    if (c.from == from && c.to == to) return {number * c.factor, to};
  return {number, from};
}

struct Shown {
  Cell cell;
  std::string unit;
  bool found = false;
};

Shown fact_of(const SweepMetric& metric, const VariantResult& result) {
  for (const auto& output : result.outputs) {
    if (output.name != metric.output) continue;
    for (const auto& fact : output.facts) {
      if (fact.name != metric.fact) continue;
      if (const auto* text = std::get_if<std::string>(&fact.value)) return {{std::nullopt, *text}, "", true};
      const auto [shown, unit] = converted(number_of(fact).value_or(0), fact.unit, metric.unit);
      return {{shown, {}}, unit, true};
    }
  }
  return {};
}

Shown cost_of(const SweepMetric& metric, const VariantResult& result) {
  double seconds = 0;
  double memory = 0;
  for (const auto& node : result.nodes) {
    if (!metric.node.empty() && node.node != metric.node && !node.node.starts_with(metric.node + "/")) continue;
    seconds += node.wall;
    memory = std::max(memory, static_cast<double>(node.peak_memory));
  }
  const bool time = metric.kind == SweepMetric::Kind::time;
  const auto [shown, unit] = converted(time ? seconds : memory, time ? "s" : "B", metric.unit);
  return {{shown, {}}, unit, true};
}

/// The metrics that the file asks for; without them all that the variants' outputs show.
std::vector<SweepMetric> metrics_of(const SweepFile& sweep, const std::vector<VariantResult>& results) {
  if (!sweep.metrics.empty()) return sweep.metrics;
  std::vector<SweepMetric> metrics;
  std::map<std::string, bool> known;
  for (const auto& result : results)
    for (const auto& output : result.outputs)
      for (const auto& fact : output.facts) {
        SweepMetric metric;
        metric.name = fact.name.empty() ? output.name : output.name + "." + fact.name;
        metric.output = output.name;
        metric.fact = fact.name;
        if (known.try_emplace(metric.name, true).second) metrics.push_back(std::move(metric));
      }
  SweepMetric seconds;
  seconds.name = "seconds";
  seconds.kind = SweepMetric::Kind::time;
  metrics.push_back(std::move(seconds));
  return metrics;
}

/// All cells of the metrics: [variant][metric].
struct Numbers {
  std::vector<SweepMetric> metrics;
  std::vector<std::string> units;
  std::vector<std::vector<Shown>> cells;
};

Numbers numbers_of(const SweepFile& sweep, const std::vector<VariantResult>& results) {
  Numbers numbers{metrics_of(sweep, results), {}, {}};
  numbers.units.resize(numbers.metrics.size());
  for (const auto& result : results) {
    auto& row = numbers.cells.emplace_back();
    for (std::size_t m = 0; m < numbers.metrics.size(); ++m) {
      const SweepMetric& metric = numbers.metrics[m];
      row.push_back(metric.kind == SweepMetric::Kind::fact ? fact_of(metric, result) : cost_of(metric, result));
      if (row.back().found && !row.back().unit.empty()) numbers.units[m] = row.back().unit;
    }
  }
  return numbers;
}

std::vector<Table::Column> metric_columns(const Numbers& numbers) {
  std::vector<Table::Column> columns;
  for (std::size_t m = 0; m < numbers.metrics.size(); ++m)
    columns.push_back(
        {numbers.metrics[m].name + (numbers.units[m].empty() ? "" : fmt::format(" [{}]", numbers.units[m])),
         Table::Column::Kind::metric, numbers.metrics[m].name, numbers.units[m]});
  return columns;
}

/// Decimals that show four significant digits of a number; none of a whole one.
int decimals_of(double number) {
  if (number == 0 || !std::isfinite(number) || (std::abs(number) < 1e15 && number == std::trunc(number))) return 0;
  return std::clamp(3 - static_cast<int>(std::floor(std::log10(std::abs(number)))), 0, 9);
}

std::string rounded(double number, const std::optional<int>& digits) {
  if (!std::isfinite(number)) return std::isnan(number) ? "nan" : number > 0 ? "inf" : "-inf";
  return fmt::format("{:.{}f}", number, digits.value_or(decimals_of(number)));
}

std::string with_spread(const std::vector<double>& numbers, const std::optional<int>& digits) {
  double mean = 0;
  for (const double number : numbers) mean += number / static_cast<double>(numbers.size());
  if (numbers.size() == 1) return rounded(numbers.front(), digits);
  double square = 0;
  for (const double number : numbers) square += (number - mean) * (number - mean);
  const double deviation = std::sqrt(square / static_cast<double>(numbers.size() - 1));
  const int decimals = digits.value_or(decimals_of(mean));
  return rounded(mean, decimals) + " ± " + rounded(deviation, decimals);
}

std::string state_of(const VariantResult& result) {
  return result.message.empty() ? std::string(name_of(result.status))
                                : fmt::format("{}: {}", name_of(result.status), result.message);
}

bool varies(const SweepAxis& axis) { return axis.choices.size() > 1; }

/// What an axis sets: of a random sample the table shows the values too.
std::vector<std::string> drawn_by(const SweepAxis& axis) {
  std::vector<std::string> targets;
  if (axis.name == "sample" && !axis.choices.empty())
    for (const auto& setting : axis.choices.front().settings) targets.push_back(setting.target);
  return targets;
}

void add_columns(const SweepAxis& axis, Table& table) {
  table.columns.push_back({axis.name, Table::Column::Kind::axis});
  for (auto& target : drawn_by(axis)) table.columns.push_back({std::move(target), Table::Column::Kind::drawn});
}

void add_cells(const SweepAxis& axis, std::size_t choice, std::vector<std::string>& row) {
  row.push_back(axis.choices[choice].label);
  if (drawn_by(axis).empty()) return;
  for (const auto& setting : axis.choices[choice].settings) row.push_back(setting.value);
}

/// Variants that differ in their seed only, in the order of the first of each.
std::vector<std::vector<std::size_t>> groups_of(const SweepFile& sweep, const SweepPlan& plan) {
  std::map<std::vector<std::size_t>, std::size_t> known;
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t v = 0; v < plan.variants.size(); ++v) {
    std::vector<std::size_t> key = plan.variants[v].choices;
    for (std::size_t a = 0; a < key.size(); ++a)
      if (sweep.axes[a].name == "seed") key[a] = 0;
    const auto [group, fresh] = known.try_emplace(std::move(key), groups.size());
    if (fresh) groups.emplace_back();
    groups[group->second].push_back(v);
  }
  return groups;
}

/// "no variant has the metric 'faces' (faces.triangles); did you mean 'faces.faces.triangles'?"
std::string unknown_metric(const SweepMetric& metric, const std::vector<VariantResult>& results) {
  std::vector<std::string> names;
  for (const auto& result : results)
    for (const auto& output : result.outputs)
      for (const auto& fact : output.facts) {
        if (output.name == metric.output) names.push_back(fact.name);
      }
  const std::string near = nearest(metric.fact, names);
  const auto longer = std::find_if(names.begin(), names.end(),
                                   [&](const std::string& name) { return name.ends_with("." + metric.fact); });
  const std::string meant = longer != names.end() ? *longer : near;
  return fmt::format("no variant has the metric '{}' ({}.{}){}", metric.name, metric.output, metric.fact,
                     meant.empty() ? "" : fmt::format("; did you mean '{}.{}'?", metric.output, meant));
}

/// What a group's cell says: the mean over the variants that are done, and how many failed.
std::string group_cell(const std::vector<std::size_t>& group, std::size_t metric, const Numbers& numbers,
                       const std::vector<VariantResult>& results) {
  std::vector<double> values;
  for (const std::size_t v : group) {
    const Shown& shown = numbers.cells[v][metric];
    if (results[v].status != VariantStatus::ok || !shown.found) continue;
    if (!shown.cell.number) return shown.cell.text;
    values.push_back(*shown.cell.number);
  }
  return values.empty() ? "–" : with_spread(values, numbers.metrics[metric].digits);
}

/// A metric's cell: a number; null where there is none; the text of what is no number that JSON has ("nan", a word).
Json cell_json(const Shown& shown) {
  if (!shown.found) return nullptr;
  if (!shown.cell.number) return shown.cell.text;
  return std::isfinite(*shown.cell.number) ? Json(*shown.cell.number) : Json(fmt::format("{}", *shown.cell.number));
}

}  // namespace

Table full_table(const SweepFile& sweep, const SweepPlan& plan, const std::vector<VariantResult>& results,
                 std::vector<std::string>* unknown) {
  const Numbers numbers = numbers_of(sweep, results);
  Table table;
  table.columns.push_back({"id"});
  for (const auto& axis : sweep.axes) add_columns(axis, table);
  for (auto& column : metric_columns(numbers)) table.columns.push_back(std::move(column));
  table.columns.push_back({"status"});
  for (std::size_t v = 0; v < results.size(); ++v) {
    auto& row = table.rows.emplace_back();
    row.push_back(plan.variants[v].id);
    for (std::size_t a = 0; a < sweep.axes.size(); ++a) add_cells(sweep.axes[a], plan.variants[v].choices[a], row);
    for (const auto& shown : numbers.cells[v])
      row.push_back(!shown.found ? "" : shown.cell.number ? fmt::format("{}", *shown.cell.number) : shown.cell.text);
    row.push_back(state_of(results[v]));
  }
  for (std::size_t m = 0; unknown != nullptr && m < numbers.metrics.size(); ++m) {
    bool done = false;
    bool found = false;
    for (std::size_t v = 0; v < results.size(); ++v) {
      done = done || results[v].status == VariantStatus::ok;
      found = found || numbers.cells[v][m].found;
    }
    if (done && !found) unknown->push_back(unknown_metric(numbers.metrics[m], results));
  }
  return table;
}

Json table_json(const SweepFile& sweep, const SweepPlan& plan, const std::vector<VariantResult>& results) {
  constexpr std::array kinds{"text", "axis", "drawn", "metric"};
  const Table table = full_table(sweep, plan, results);
  const Numbers numbers = numbers_of(sweep, results);
  Json columns = Json::array();
  Json variants = Json::array();
  for (const auto& column : table.columns) {
    columns.push_back({{"title", column.title}, {"kind", kinds.at(static_cast<std::size_t>(column.kind))}});
    if (column.is_number()) columns.back().update({{"name", column.name}, {"unit", column.unit}});
  }
  for (std::size_t v = 0; v < table.rows.size(); ++v) {
    Json& entry = variants.emplace_back(Json::object());
    std::size_t metric = 0;
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      const auto& column = table.columns[c];
      entry[column.title] = column.is_number() ? cell_json(numbers.cells[v][metric++]) : Json(table.rows[v][c]);
      if (c == 0) entry["label"] = label_of(sweep, plan.variants[v]);
    }
  }
  return {{"columns", std::move(columns)}, {"variants", std::move(variants)}};
}

Table short_table(const SweepFile& sweep, const SweepPlan& plan, const std::vector<VariantResult>& results) {
  const Numbers numbers = numbers_of(sweep, results);
  Table table;
  for (const auto& axis : sweep.axes)
    if (varies(axis) && axis.name != "seed") add_columns(axis, table);
  for (auto& column : metric_columns(numbers)) table.columns.push_back(std::move(column));
  table.columns.push_back({"status"});
  for (const auto& group : groups_of(sweep, plan)) {
    auto& row = table.rows.emplace_back();
    for (std::size_t a = 0; a < sweep.axes.size(); ++a)
      if (varies(sweep.axes[a]) && sweep.axes[a].name != "seed")
        add_cells(sweep.axes[a], plan.variants[group.front()].choices[a], row);
    for (std::size_t m = 0; m < numbers.metrics.size(); ++m) row.push_back(group_cell(group, m, numbers, results));
    const auto not_ok = [&](std::size_t v) { return results[v].status != VariantStatus::ok; };
    const auto first = std::find_if(group.begin(), group.end(), not_ok);
    if (first == group.end()) {
      row.emplace_back("ok");
    } else {
      const auto bad = std::count_if(group.begin(), group.end(), not_ok);
      row.push_back(group.size() == 1 ? state_of(results[*first])
                                      : fmt::format("{} of {} {}", bad, group.size(), state_of(results[*first])));
    }
  }
  return table;
}

}  // namespace atrium
