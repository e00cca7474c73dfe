#include "modules/building/corrections_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "graph/api/error.hpp"
#include "graph/api/parameter.hpp"
#include "graph/api/suggest.hpp"
#include "graph/pipeline/yaml_tree.hpp"

namespace atrium::building {
namespace {

using Kind = CorrectionKeyKind;
using Words = std::vector<std::string>;

constexpr const char* format_help = "share/doc/corrections.md shows the format";

Words as_words(const std::vector<std::string_view>& names) { return {names.begin(), names.end()}; }

std::string suggestion(std::string_view word, const Words& words, const std::string& of) {
  const std::string hint = did_you_mean(word, words);
  return hint.empty() ? of + ": " + join_words(words, 20) : hint;
}

const CorrectionKey& key_called(std::string_view name) {
  const auto& all = correction_keys();
  return *std::find_if(all.begin(), all.end(), [&](const CorrectionKey& key) { return key.name == name; });
}

/// Reads one file's tree.
class CorrectionsReader {
 public:
  explicit CorrectionsReader(const std::string& file) : file_(file) {}

  std::vector<Correction> run() {
    const YamlTree tree = read_yaml(file_);
    if (!tree.problems.empty()) {
      // The parser's help speaks of pipelines.
      const YamlProblem& first = tree.problems.front();
      const bool of_pipelines =
          first.help.find("pipeline") != std::string::npos || first.help.find("variable") != std::string::npos;
      refuse(at(first.place), first.message, of_pipelines || first.help.empty() ? format_help : first.help);
    }
    const YamlNode& root = *tree.root;
    if (!root.is_mapping()) refuse(at(root.place), "a file of corrections is a mapping of keys to values", format_help);
    for (const auto& entry : root.entries)
      if (entry.key != "atrium_corrections" && entry.key != "corrections")
        refuse(at(entry.place), fmt::format("unknown key '{}'", entry.key),
               suggestion(entry.key, {"atrium_corrections", "corrections"}, "keys of the file"));
    const auto* version = root.find("atrium_corrections");
    if (version == nullptr)
      refuse(at({}), "the format's version is missing", "begin the file with `atrium_corrections: 1`");
    if (!version->value.is_scalar() || version->value.text != "1")
      refuse(at(version->value.place), fmt::format("unknown version '{}'", version->value.text), "known: 1");
    const auto* list = root.find("corrections");
    std::vector<Correction> result;
    if (list == nullptr || list->value.is_null()) return result;
    if (!list->value.is_sequence())
      refuse(at(list->value.place), "'corrections' is no list", "each begins with '- ', as in `- rename_room: {…}`");
    for (const auto& item : list->value.items) result.push_back(correction(item));
    return result;
  }

 private:
  CorrectionPlace at(Place place) const { return {file_, place.line, place.column}; }

  Correction correction(const YamlNode& item) const {
    if (!item.is_mapping() || item.entries.size() != 1)
      refuse(at(item.place), "a correction is one word with its keys",
             "as in `- rename_room: {room: room 1, name: Kitchen}`");
    const auto& entry = item.entries.front();
    const auto& rules = correction_rules();
    const auto rule =
        std::find_if(rules.begin(), rules.end(), [&](const CorrectionRule& r) { return r.name == entry.key; });
    if (rule == rules.end())
      refuse(at(entry.place), fmt::format("unknown correction '{}'", entry.key),
             suggestion(entry.key, words_of(rules, [](const auto& r) { return std::string(r.name); }), "corrections"));
    if (!entry.value.is_mapping())
      refuse(at(entry.value.place), fmt::format("'{}' needs its keys", entry.key),
             fmt::format("as in `- {}: {{{}: …}}`", entry.key,
                         rule->named_by.empty() ? rule->required.front() : rule->named_by.front()));
    Correction result;
    result.name = entry.key;
    result.place = at(entry.place);
    for (const auto& key : entry.value.entries) result.values.emplace(key.key, value(*rule, key));
    check_presence(*rule, result);
    return result;
  }

  static void check_presence(const CorrectionRule& rule, const Correction& correction) {
    for (const auto key : rule.required)
      if (!correction.has(key))
        correction.fail({}, fmt::format("'{}' of '{}' is missing", key, rule.name), format_help);
    if (!rule.named_by.empty() &&
        std::none_of(rule.named_by.begin(), rule.named_by.end(), [&](auto key) { return correction.has(key); }))
      correction.fail({}, fmt::format("'{}' does not say what is meant", rule.name),
                      "give one of " + join_words(as_words(rule.named_by)));
    const auto given = [&](const std::vector<std::string_view>& keys) {
      return std::count_if(keys.begin(), keys.end(), [&](std::string_view key) { return correction.has(key); });
    };
    if (!rule.one_of.empty() && given(rule.one_of) != 1)
      correction.fail({}, fmt::format("'{}' needs exactly one of {}", rule.name, join_words(as_words(rule.one_of))),
                      fmt::format("{} of them are given", given(rule.one_of)));
    if (!rule.at_least_one.empty() && given(rule.at_least_one) == 0)
      correction.fail({}, fmt::format("'{}' changes nothing", rule.name),
                      "give one of " + join_words(as_words(rule.at_least_one)));
    if (correction.has("near") && correction.has("at"))
      correction.fail("near", "'near' and 'at' both say where the wall is",
                      "'at' stands alone; 'near' stands beside 'wall' or 'face', and checks it");
  }

  CorrectionValue value(const CorrectionRule& rule, const YamlNode::Entry& entry) const {
    Words known = as_words(rule.required);
    for (const auto* more : {&rule.one_of, &rule.at_least_one, &rule.optional})
      known.insert(known.end(), more->begin(), more->end());
    if (std::find(known.begin(), known.end(), entry.key) == known.end())
      refuse(at(entry.place), fmt::format("unknown key '{}' of '{}'", entry.key, rule.name),
             suggestion(entry.key, known, fmt::format("keys of {}", rule.name)));
    CorrectionValue result;
    result.place = at(entry.value.place);
    const CorrectionKey& key = key_called(entry.key);
    if (key.kind == Kind::near)
      result.places = places(key, entry.value, rule.things);
    else
      read(key, entry.value, result);
    return result;
  }

  static bool is_plain_list(const YamlNode& node) {
    return node.is_sequence() &&
           std::all_of(node.items.begin(), node.items.end(), [](const auto& item) { return item.is_scalar(); });
  }

  [[noreturn]] void refuse_kind(const CorrectionKey& key, const YamlNode& node, const std::string& right) const {
    refuse(at(node.place),
           fmt::format("'{}' {}", key.name, node.is_null() ? "has no value" : "has a value of the wrong kind"), right);
  }

  std::vector<double> place(const CorrectionKey& key, const YamlNode& node) const {
    if (!is_plain_list(node) || node.items.size() < 2 || node.items.size() > 3)
      refuse_kind(key, node, "a place of the scan, in its unit: [x, y], or [x, y, z]");
    std::vector<double> numbers;
    numbers.reserve(node.items.size());
    for (const auto& item : node.items) numbers.push_back(number(key, item, unitless));
    return numbers;
  }

  std::vector<std::vector<double>> places(const CorrectionKey& key, const YamlNode& node, std::size_t count) const {
    if (count == 1) return {place(key, node)};
    if (!node.is_sequence() || node.items.size() != count || is_plain_list(node))
      refuse_kind(key, node, fmt::format("{} places, one of each room: [[x, y], [x, y]]", count));
    std::vector<std::vector<double>> result;
    result.reserve(count);
    for (const auto& item : node.items) result.push_back(place(key, item));
    return result;
  }

  void read(const CorrectionKey& key, const YamlNode& node, CorrectionValue& result) const {
    const auto wrong = [&](const std::string& right) { refuse_kind(key, node, right); };
    const auto list = [&] { return words_of(node.items, [](const YamlNode& item) { return item.text; }); };
    switch (key.kind) {
      case Kind::texts:
        if (!is_plain_list(node) || node.items.size() != 2) wrong("two names, as in [room 1, room 2]");
        result.texts = list();
        for (const auto& text : result.texts)
          if (text.empty()) wrong("two names, none of them empty");
        return;
      case Kind::plan_place: result.numbers = place(key, node); return;
      default: break;
    }
    if (!node.is_scalar() || node.text.empty()) wrong(key.kind == Kind::length ? "a length, as in 12 cm" : "one value");
    result.text = node.text;
    const auto one_of = [&](const Words& words) {
      if (std::find(words.begin(), words.end(), node.text) == words.end())
        refuse(at(node.place), fmt::format("'{}' cannot be '{}'", key.name, node.text),
               suggestion(node.text, words, "one of"));
    };
    switch (key.kind) {
      case Kind::length: result.number = number(key, node, metres); return;
      case Kind::whole:
        result.number = number(key, node, unitless);
        if (result.number != std::floor(result.number)) wrong("a whole number");
        return;
      case Kind::yes_or_no:
        one_of({"true", "false"});
        result.yes = node.text == "true";
        return;
      case Kind::opening_kind: one_of({"door", "window", "passage"}); return;
      case Kind::corner: one_of({"left", "right"}); return;
      default: return;
    }
  }

  double number(const CorrectionKey& key, const YamlNode& node, const Unit& unit) const {
    ParamInfo info;
    info.name = key.name;
    info.kind = ParamKind::number;
    info.unit = unit;
    info.initial = 0.0;
    if (key.least < key.most) {
      info.min = key.least;
      info.max = key.most;
    }
    try {
      return std::get<double>(parse_param(info, {{node.text}, false, node.quoted}));
    } catch (const Error& error) {
      // The parameter's default, which there is none of, is left out.
      const std::string& help = error.help();
      const std::size_t end = help.find(", default");
      refuse(at(node.place), error.what(),
             end == std::string::npos ? help : help.substr(0, end) + (help.ends_with(')') ? ")" : ""));
    }
  }

  std::string file_;
};

}  // namespace

void refuse(const CorrectionPlace& place, const std::string& problem, const std::string& help) {
  const std::string where = place.line > 0 ? fmt::format("{}:{}:{}", place.file, place.line, place.column) : place.file;
  throw Error(where + ": " + problem, help);
}

const CorrectionValue& Correction::at(std::string_view key) const { return values.find(key)->second; }

void Correction::fail(std::string_view key, const std::string& problem, const std::string& help) const {
  refuse(has(key) ? at(key).place : place, problem, help);
}

const std::vector<CorrectionKey>& correction_keys() {
  constexpr double far = 100;  // metres
  static const std::vector<CorrectionKey> keys{{"room", Kind::text},
                                               {"rooms", Kind::texts},
                                               {"name", Kind::text},
                                               {"names", Kind::texts},
                                               {"from", Kind::plan_place},
                                               {"to", Kind::plan_place},
                                               {"at", Kind::plan_place},
                                               {"near", Kind::near},
                                               {"wall", Kind::text},
                                               {"face", Kind::whole, 0, 1e9},
                                               {"opening", Kind::text},
                                               {"kind", Kind::opening_kind},
                                               {"corner", Kind::corner},
                                               {"distance", Kind::length, 0, far},
                                               {"width", Kind::length, 0.05, far},
                                               {"height", Kind::length, 0.05, far},
                                               {"sill", Kind::length, 0, far},
                                               {"by", Kind::length, -far, far},
                                               {"both", Kind::yes_or_no},
                                               {"level", Kind::length, -far, far},
                                               {"thickness", Kind::length, 0, 2}};
  return keys;
}

const std::vector<CorrectionRule>& correction_rules() {
  static const std::vector<CorrectionRule> rules{
      {"rename_room", {"name"}, {"room", "near"}, {}, {}, {"room", "near"}},
      {"merge_rooms", {}, {"rooms", "near", "name"}, {}, {}, {"rooms", "near"}, 2},
      {"split_room", {"from", "to", "names"}, {"room", "near", "thickness"}, {}, {}, {"room", "near"}},
      {"add_opening",
       {"room", "kind", "distance", "width", "height"},
       {"near", "corner", "sill"},
       {"wall", "face", "at"},
       {},
       {}},
      {"change_opening",
       {},
       {"opening", "near", "room", "corner"},
       {},
       {"kind", "distance", "by", "width", "height", "sill"},
       {"opening", "near"}},
      {"drop_opening", {}, {"opening", "near"}, {}, {}, {"opening", "near"}},
      {"move_wall", {"room", "by"}, {"near", "both"}, {"wall", "face", "at"}, {}, {}},
      {"set_thickness", {"room", "thickness"}, {"near"}, {"wall", "face", "at"}, {}, {}},
      {"drop_face", {"room"}, {"near"}, {"wall", "face", "at"}, {}, {}},
      {"set_ceiling", {}, {"room", "near", "face"}, {"height", "by"}, {}, {"room", "near"}},
      {"set_floor", {}, {"room", "near", "face"}, {"level", "by"}, {}, {"room", "near"}}};
  return rules;
}

std::vector<Correction> read_corrections(const std::string& file) { return CorrectionsReader(file).run(); }

}  // namespace atrium::building
