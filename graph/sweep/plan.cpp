#include "graph/sweep/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "graph/api/suggest.hpp"
#include "graph/pipeline/document.hpp"
#include "graph/sweep/merge.hpp"
#include "graph/sweep/shown_names.hpp"

namespace atrium {
namespace {

constexpr std::size_t most_variants = 100'000;
constexpr std::size_t uncounted = 1'000'000'000'000'000'000;  ///< more combinations than this are not counted
constexpr std::size_t most_errors = 100;

/// Whether the chosen values fulfil all conditions of one `exclude`.
bool matches(const std::vector<SweepSetting>& conditions, const SweepFile& sweep,
             const std::vector<std::size_t>& choices) {
  return std::all_of(conditions.begin(), conditions.end(), [&](const SweepSetting& condition) {
    for (std::size_t a = 0; a < sweep.axes.size(); ++a) {
      const SweepChoice& choice = sweep.axes[a].choices[choices[a]];
      if (sweep.axes[a].name == condition.target && choice.label == condition.value) return true;
      for (const auto& setting : choice.settings)
        if (setting.target == condition.target && setting.value == condition.value) return true;
    }
    return false;
  });
}

/// Axes whose choices have names of their own.
bool is_named(const SweepAxis& axis) {
  return axis.name == "scene" || axis.name == "variant" || axis.name == "ablation";
}

/// What the variant chose of the axes that have several choices; `called(name)` stands before a value.
template <class Called>
std::string joined_choices(const SweepFile& sweep, const SweepVariant& variant, Called called) {
  std::string text;
  for (std::size_t a = 0; a < sweep.axes.size(); ++a) {
    const SweepAxis& axis = sweep.axes[a];
    if (axis.choices.size() < 2) continue;
    if (!text.empty()) text += ", ";
    if (!is_named(axis)) text += called(axis.name);
    text += axis.choices[variant.choices[a]].label;
  }
  return text.empty() ? "the only variant" : text;
}

class Planner {
 public:
  Planner(const SweepFile& sweep, const std::vector<Override>& given, Registry& registry)
      : sweep_(sweep), given_(given), registry_(registry) {}

  SweepLoad plan() {
    check_settings();
    check_exclude();
    shown_.check_units();
    if (const std::size_t combinations = count(); combinations > most_variants)
      findings_.error({&sweep_.source, {}},
                      fmt::format("the sweep has {}{} combinations, more than {}",
                                  combinations == uncounted ? "over " : "", combinations, most_variants));
    std::vector<std::size_t> choices(sweep_.axes.size(), 0);
    bool more = findings_.error_count() == 0;
    while (more && findings_.error_count() + errors_.size() < most_errors) {
      add(choices);
      more = next(choices);
    }
    finish();
    return std::move(result_);
  }

 private:
  std::size_t count() const {
    std::size_t total = 1;
    for (const auto& axis : sweep_.axes) {
      if (axis.choices.empty()) return 0;
      total = total > uncounted / axis.choices.size() ? uncounted : total * axis.choices.size();
    }
    return total;
  }

  /// The last axis runs fastest.
  bool next(std::vector<std::size_t>& choices) const {
    for (std::size_t a = choices.size(); a-- > 0;) {
      if (++choices[a] < sweep_.axes[a].choices.size()) return true;
      choices[a] = 0;
    }
    return false;
  }

  /// What the table names by its value must be what ran.
  void check_settings() {
    for (const auto& axis : sweep_.axes) {
      if (is_named(axis)) continue;
      for (const auto& override_ : given_) {
        const auto sets = [&](const SweepSetting& s) { return override_.text.starts_with(s.target + "="); };
        const auto& choices = axis.choices;
        if (std::any_of(choices.begin(), choices.end(), [&](const SweepChoice& choice) {
              return std::any_of(choice.settings.begin(), choice.settings.end(), sets);
            }))
          findings_.error({&sweep_.source, choices.front().place},
                          fmt::format("'{}' is varied by the sweep and cannot be set", axis.name),
                          "change the sweep file, or leave the setting out", {"set by " + override_.origin});
      }
    }
  }

  void check_exclude() {
    excludes_.assign(sweep_.exclude.size(), 0);
    std::vector<std::string> names;
    for (const auto& axis : sweep_.axes) {
      names.push_back(axis.name);
      for (const auto& choice : axis.choices)
        for (const auto& setting : choice.settings) names.push_back(setting.target);
    }
    for (const auto& conditions : sweep_.exclude)
      for (const auto& condition : conditions)
        if (std::find(names.begin(), names.end(), condition.target) == names.end())
          findings_.error({&sweep_.source, condition.place},
                          fmt::format("'exclude' names '{}', which the sweep does not vary", condition.target),
                          findings_.suggest(condition.target, names));
  }

  std::vector<Override> overrides(const std::vector<std::size_t>& choices) const {
    std::vector<Override> result = given_;
    const auto add = [&](const SweepSetting& setting) {
      const auto same = [&](const Override& o) { return o.text.starts_with(setting.target + "="); };
      if (std::any_of(given_.begin(), given_.end(), same)) return;  // the command line wins
      result.push_back({setting.target + "=" + setting.value, to_string(Where{&sweep_.source, setting.place}),
                        sweep_.source.folder, setting.node});
    };
    for (const auto& setting : sweep_.settings) add(setting);
    for (std::size_t a = 0; a < choices.size(); ++a)
      for (const auto& setting : sweep_.axes[a].choices[choices[a]].settings) add(setting);
    return result;
  }

  void add(const std::vector<std::size_t>& choices) {
    for (std::size_t e = 0; e < sweep_.exclude.size(); ++e) {
      if (!matches(sweep_.exclude[e], sweep_, choices)) continue;
      ++excludes_[e];
      ++result_.plan.excluded;
      return;
    }
    LoadResult loaded = load_pipeline(sweep_.base, overrides(choices), registry_, {false, &documents_});
    keep(loaded.errors, errors_, result_.errors);
    keep(loaded.warnings, warnings_, result_.warnings);
    if (!loaded.errors.empty()) return;
    shown_.add(loaded.pipeline);
    any_ = true;
    result_.plan.merged[whole].summary = loaded.pipeline[whole].summary;
    merge(loaded.pipeline, choices);
  }

  static void keep(std::vector<Diagnostic>& found, std::set<std::string>& known, std::vector<Diagnostic>& list) {
    for (auto& finding : found)
      if (known.insert(to_string(finding)).second) list.push_back(std::move(finding));
  }

  void merge(const Pipeline& pipeline, const std::vector<std::size_t>& choices) {
    SweepPlan& plan = result_.plan;
    const auto [variant, fresh] = merger_.add(pipeline, choices);
    if (fresh) return;
    ++plan.duplicates;
    SweepVariant same;
    same.choices = choices;
    plan.notes.push_back(
        fmt::format("{} is the same as {}", label_of(sweep_, same), label_of(sweep_, plan.variants[variant])));
  }

  void finish() {
    if (any_ && errors_.empty()) shown_.check_pictures();
    SweepPlan& plan = result_.plan;
    plan.merged[whole].file = sweep_.path;
    for (std::size_t e = 0; e < excludes_.size(); ++e)
      if (excludes_[e] == 0 && result_.errors.empty() && findings_.error_count() == 0)
        findings_.error({&sweep_.source, sweep_.exclude[e].empty() ? Place{} : sweep_.exclude[e].front().place},
                        "this exclusion excludes nothing",
                        "its values are written as in the lists that they are taken from");
    if (plan.variants.empty() && result_.errors.empty() && findings_.error_count() == 0)
      findings_.error({&sweep_.source, {}}, "no variant is left");
    auto own = findings_.errors();
    result_.errors.insert(result_.errors.begin(), own.begin(), own.end());
  }

  const SweepFile& sweep_;
  const std::vector<Override>& given_;
  Registry& registry_;
  ReadDocuments documents_;
  Findings findings_;
  ShownNames shown_{sweep_, findings_};
  bool any_ = false;  ///< variant could be loaded
  SweepLoad result_;
  std::set<std::string> errors_, warnings_;
  std::vector<std::size_t> excludes_;
  VariantMerger merger_{result_.plan, sweep_.source.folder};
};

}  // namespace

SweepLoad plan_sweep(const SweepFile& sweep, const std::vector<Override>& settings, Registry& registry) {
  return Planner(sweep, settings, registry).plan();
}

std::string label_of(const SweepFile& sweep, const SweepVariant& variant) {
  const auto full = [](const std::string& name) { return name + " = "; };
  return joined_choices(sweep, variant, full);
}

std::string caption_of(const SweepFile& sweep, const SweepVariant& variant) {
  const auto last = [](const std::string& name) { return name.substr(name.find_last_of("./") + 1); };
  std::map<std::string, int> uses;
  for (const auto& axis : sweep.axes)
    if (axis.choices.size() > 1) ++uses[last(axis.name)];
  const auto brief = [&](const std::string& name) { return (uses[last(name)] > 1 ? name : last(name)) + " "; };
  return joined_choices(sweep, variant, brief);
}

VariantName name_of(const SweepFile& sweep, const SweepVariant& variant) {
  VariantName name{label_of(sweep, variant), {}};
  for (std::size_t a = 0; a < sweep.axes.size(); ++a)
    name.choices.emplace_back(sweep.axes[a].name, sweep.axes[a].choices[variant.choices[a]].label);
  return name;
}

}  // namespace atrium
