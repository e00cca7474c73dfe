#include "graph/api/parameter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>

#include "graph/api/error.hpp"
#include "graph/api/suggest.hpp"

namespace atrium {
namespace {

/// A unit that files may write: value · numerator / denominator is the value in the dimension's base unit. Two factors,
/// because 35 / 100 is the double nearest to 0.35 and 35 · 0.01 is not.
struct WrittenUnit {
  std::string_view symbol, dimension;
  double numerator, denominator;
};
constexpr std::array<WrittenUnit, 17> written_units{{
    {"km", "length", 1000, 1},
    {"m", "length", 1, 1},
    {"cm", "length", 1, 100},
    {"mm", "length", 1, 1000},
    {"um", "length", 1, 1000000},
    {"in", "length", 254, 10000},
    {"ft", "length", 3048, 10000},
    {"m2", "area", 1, 1},
    {"cm2", "area", 1, 10000},
    {"mm2", "area", 1, 1000000},
    {"deg", "angle", 1, 1},
    {"rad", "angle", 180, std::numbers::pi},
    {"s", "time", 1, 1},
    {"ms", "time", 1, 1000},
    {"min", "time", 60, 1},
    {"h", "time", 3600, 1},
    {"%", "ratio", 1, 100},
}};

const WrittenUnit* find_unit(std::string_view symbol) {
  for (const auto& unit : written_units)
    if (unit.symbol == symbol) return &unit;
  return nullptr;
}

/// "length", "share", "plain number": a dimension as a user calls it.
std::string_view noun(std::string_view dimension) {
  if (dimension == "ratio") return "share";
  if (dimension == "number") return "plain number";
  return dimension;
}
std::string with_article(std::string_view word) {
  const bool vowel = !word.empty() && std::string_view("aeiou").find(word.front()) != std::string_view::npos;
  return fmt::format("{} {}", vowel ? "an" : "a", word);
}

std::string_view example(const Unit& unit) {
  if (unit.dimension == "length") return "2 cm";
  if (unit.dimension == "angle") return "20 deg";
  if (unit.dimension == "area") return "0.5 m2";
  if (unit.dimension == "time") return "30 s";
  if (unit.dimension == "ratio") return "10 %";
  if (unit.dimension == "count") return "50";
  return "0.5";
}

std::string quantity(double value, const Unit& unit) {
  return unit.symbol.empty() ? fmt::format("{}", value) : fmt::format("{} {}", value, unit.symbol);
}

std::string help_for(const ParamInfo& info) {
  const bool numeric =
      info.kind == ParamKind::number || info.kind == ParamKind::integer || info.kind == ParamKind::numbers;
  if (!numeric || info.unit.dimension == "number") return describe_param(info);
  return fmt::format("e.g. {} ({})", example(info.unit), describe_param(info));
}

[[noreturn]] void fail(const ParamInfo& info, const std::string& message) { throw Error(message, help_for(info)); }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

struct Split {
  double value;
  std::string_view digits, unit;
};

/// The number at the beginning of the text and what follows it.
Split split_quantity(const ParamInfo& info, std::string_view text) {
  std::string_view rest = trimmed(text);
  if (rest.size() > 1 && rest.front() == '+' && rest[1] != '-') rest.remove_prefix(1);
  const std::string_view unsigned_part = rest.substr(rest.starts_with('-') ? 1 : 0);
  const bool digit = !unsigned_part.empty() &&
                     ((unsigned_part.front() >= '0' && unsigned_part.front() <= '9') || unsigned_part.front() == '.');
  double value = 0;
  const auto [end, problem] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
  // from_chars also reads "inf" and "nan", which no parameter can be.
  if (!digit || problem == std::errc::invalid_argument)
    fail(info,
         fmt::format("'{}' is not a number, and '{}' is {}", text, info.name, with_article(noun(info.unit.dimension))));
  if (problem == std::errc::result_out_of_range) fail(info, fmt::format("the number '{}' cannot be represented", text));
  const auto used = static_cast<std::size_t>(end - rest.data());
  return {value, rest.substr(0, used), trimmed(rest.substr(used))};
}

/// A unit that was written in other letters, or as a word. Symbols are too short to guess at what is like them: 'kg' is
/// no misspelt 'km'.
std::string unit_meant(std::string_view written, const std::vector<std::string>& fitting) {
  const auto lower = [](std::string_view text) {
    std::string result(text);
    for (auto& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return result;
  };
  constexpr std::size_t word = 4;  // letters
  for (const auto& symbol : fitting)
    if (lower(symbol) == lower(written)) return fmt::format("did you mean '{}'?", symbol);
  return written.size() < word ? std::string() : did_you_mean(written, fitting);
}

double to_declared_unit(const ParamInfo& info, std::string_view text, const Split& split) {
  if (split.unit.empty() || split.unit == info.unit.symbol) return split.value;
  const WrittenUnit* unit = find_unit(split.unit);
  const std::vector<std::string> fitting = units_of(info.unit);
  if (unit == nullptr) {
    const std::string hint = unit_meant(split.unit, fitting);
    throw Error(fmt::format("unknown unit '{}' in '{}'", split.unit, text),
                fitting.empty() ? fmt::format("'{}' has no unit ({})", info.name, describe_param(info))
                                : fmt::format("{}{}units of {}: {}", hint, hint.empty() ? "" : " ",
                                              with_article(noun(info.unit.dimension)), join_words(fitting)));
  }
  if (unit->dimension != info.unit.dimension)
    fail(info, fmt::format("'{}' is {}, but '{}' is {}", text, with_article(noun(unit->dimension)), info.name,
                           with_article(noun(info.unit.dimension))));
  const double base = split.value * unit->numerator / unit->denominator;
  const WrittenUnit* declared = find_unit(info.unit.symbol);
  return declared == nullptr ? base : base * declared->denominator / declared->numerator;
}

void check_bounds(const ParamInfo& info, double value, std::string_view text) {
  if (!std::isfinite(value)) fail(info, fmt::format("the number '{}' cannot be represented", text));
  if (value < info.min)
    fail(info, fmt::format("'{}' is {}, below its least value {}", info.name, quantity(value, info.unit),
                           quantity(info.min, info.unit)));
  if (value > info.max)
    fail(info, fmt::format("'{}' is {}, above its greatest value {}", info.name, quantity(value, info.unit),
                           quantity(info.max, info.unit)));
}

double parse_number(const ParamInfo& info, std::string_view text) {
  const double value = to_declared_unit(info, text, split_quantity(info, text));
  check_bounds(info, value, text);
  return value;
}

std::int64_t parse_integer(const ParamInfo& info, std::string_view text) {
  const Split split = split_quantity(info, text);
  std::int64_t whole = 0;
  const auto [end, problem] = std::from_chars(split.digits.data(), split.digits.data() + split.digits.size(), whole);
  const bool plain = problem == std::errc{} && end == split.digits.data() + split.digits.size();
  if (plain && (split.unit.empty() || split.unit == info.unit.symbol)) {
    check_bounds(info, static_cast<double>(whole), text);
    return whole;
  }
  const double value = to_declared_unit(info, text, split);  // "1e6", "2 min"
  if (value != std::trunc(value))
    fail(info, fmt::format("'{}' is not a whole number, and '{}' counts whole ones", text, info.name));
  check_bounds(info, value, text);
  constexpr double exact_limit = 9007199254740992.0;  // 2^53: above it doubles skip integers
  if (std::abs(value) > exact_limit) fail(info, fmt::format("the number '{}' cannot be represented", text));
  return static_cast<std::int64_t>(value);
}

bool parse_boolean(const ParamInfo& info, const std::string& text) {
  if (text == "true") return true;
  if (text == "false") return false;
  fail(info, fmt::format("'{}' is neither true nor false", text));
}

std::string parse_choice(const ParamInfo& info, const std::string& text) {
  if (std::find(info.choices.begin(), info.choices.end(), text) != info.choices.end()) return text;
  const std::string hint = did_you_mean(text, info.choices);
  throw Error(fmt::format("'{}' cannot be '{}'", info.name, text),
              fmt::format("{}{}{}", hint, hint.empty() ? "" : " ", describe_param(info)));
}

bool is_list(ParamKind kind) {
  return kind == ParamKind::numbers || kind == ParamKind::texts || kind == ParamKind::input_paths;
}
bool is_textual(ParamKind kind) {
  switch (kind) {
    case ParamKind::boolean:
    case ParamKind::integer:
    case ParamKind::number:
    case ParamKind::numbers: return false;
    default: return true;
  }
}

/// "1 m": a number and a unit. In quotes, too, it can be nothing else; JSON can write it in no other way.
bool is_written_quantity(const std::string& text) {
  double number = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
  const std::string_view unit =
      trimmed(std::string_view(end, static_cast<std::size_t>(text.data() + text.size() - end)));
  return problem == std::errc{} && end != text.data() && find_unit(unit) != nullptr;
}

void check_shape(const ParamInfo& info, const RawValue& raw) {
  if (raw.is_list && !is_list(info.kind)) fail(info, fmt::format("'{}' is one value, not a list", info.name));
  if (!raw.is_list && raw.items.size() != 1) fail(info, fmt::format("'{}' has no value", info.name));
  const bool quantity_in_quotes = std::any_of(raw.items.begin(), raw.items.end(), is_written_quantity);
  if (raw.quoted && !is_textual(info.kind) && !quantity_in_quotes) {
    const std::string_view text = raw.items.empty() ? std::string_view{} : std::string_view(raw.items.front());
    fail(info, fmt::format("'{}' is {}, and \"{}\" in quotes is text; write it without quotes", info.name,
                           info.kind == ParamKind::boolean ? "true or false" : with_article(noun(info.unit.dimension)),
                           text));
  }
  if (info.kind == ParamKind::input_paths && static_cast<double>(raw.items.size()) < info.min)
    fail(info, fmt::format("'{}' has no file", info.name));
  if (info.length > 0 && raw.items.size() != info.length)
    fail(info, fmt::format("'{}' is a list of {}, not of {}", info.name, info.length, raw.items.size()));
}

/// YAML's form of a text: plain where that is safe, else in double quotes.
std::string yaml_text(const std::string& text) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '/' ||
           c == '.' || c == '-' || c == '+';
  };
  const bool null_word = text == "null" || text == "Null" || text == "NULL";
  if (!text.empty() && std::all_of(text.begin(), text.end(), plain) && text.front() != '-' && !null_word) return text;
  std::string result = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      result += fmt::format("\\{}", c);
    else if (byte < 0x20 || byte == 0x7f)
      result += fmt::format("\\x{:02x}", byte);
    else
      result += c;
  }
  return result + "\"";
}

template <class T, class F>
std::string bracketed(const std::vector<T>& items, F form) {
  std::string text = "[";
  for (const auto& item : items) text += (text.size() > 1 ? ", " : "") + form(item);
  return text + "]";
}

std::string kind_name(const ParamInfo& info) {
  switch (info.kind) {
    case ParamKind::boolean: return "true or false";
    case ParamKind::integer: return info.unit.dimension == "number" ? "whole number" : std::string(info.unit.dimension);
    case ParamKind::number: return info.unit.dimension == "number" ? "number" : std::string(noun(info.unit.dimension));
    case ParamKind::text: return "text";
    case ParamKind::choice: return "one of " + join_words(info.choices, 40);
    case ParamKind::input_path: return "file that exists";
    case ParamKind::output_path: return "file to write, relative to the run's folder";
    case ParamKind::numbers:
      return fmt::format("list of {}{}", info.length > 0 ? fmt::format("{} ", info.length) : "",
                         info.unit.dimension == "number" ? "numbers" : fmt::format("{}s", noun(info.unit.dimension)));
    case ParamKind::texts: return "list of texts";
    case ParamKind::input_paths: return info.min >= 1 ? "file that exists, or a list" : "list of files that exist";
  }
  return {};
}

std::string bounds_text(const ParamInfo& info) {
  // The limits of the C++ type are no news to a user.
  if (info.kind == ParamKind::input_paths) return {};
  const bool integer = info.kind == ParamKind::integer;
  const bool low = std::isfinite(info.min) && !(integer && info.min <= -2147483648.0);
  const bool high = std::isfinite(info.max) && !(integer && info.max >= 2147483647.0);
  if (low && high) return fmt::format(", {} to {}", quantity(info.min, info.unit), quantity(info.max, info.unit));
  if (low) return fmt::format(", at least {}", quantity(info.min, info.unit));
  if (high) return fmt::format(", at most {}", quantity(info.max, info.unit));
  return {};
}

}  // namespace

std::vector<std::string> units_of(const Unit& unit) {
  std::vector<std::string> symbols;
  for (const auto& written : written_units)
    if (written.dimension == unit.dimension) symbols.emplace_back(written.symbol);
  if (symbols.empty() && !unit.symbol.empty()) symbols.emplace_back(unit.symbol);
  return symbols;
}

ParamValue parse_param(const ParamInfo& info, const RawValue& raw) {
  check_shape(info, raw);
  switch (info.kind) {
    case ParamKind::boolean: return parse_boolean(info, raw.items.front());
    case ParamKind::integer: return parse_integer(info, raw.items.front());
    case ParamKind::number: return parse_number(info, raw.items.front());
    case ParamKind::choice: return parse_choice(info, raw.items.front());
    case ParamKind::numbers: {
      std::vector<double> values;
      for (const auto& item : raw.items) values.push_back(parse_number(info, item));
      return values;
    }
    case ParamKind::texts:
    case ParamKind::input_paths: return raw.items;
    default: return raw.items.front();
  }
}

std::string format_param(const ParamInfo& info, const ParamValue& value) {
  const auto number = [&](double v) { return quantity(v, info.unit); };
  switch (info.kind) {
    case ParamKind::boolean: return std::get<bool>(value) ? "true" : "false";
    case ParamKind::integer: {
      const auto whole = std::get<std::int64_t>(value);
      return info.unit.symbol.empty() ? fmt::format("{}", whole) : fmt::format("{} {}", whole, info.unit.symbol);
    }
    case ParamKind::number: return number(std::get<double>(value));
    case ParamKind::numbers: return bracketed(std::get<std::vector<double>>(value), number);
    case ParamKind::texts:
    case ParamKind::input_paths: return bracketed(std::get<std::vector<std::string>>(value), yaml_text);
    default: return yaml_text(std::get<std::string>(value));
  }
}

bool is_required(const ParamInfo& info) {
  if (info.kind == ParamKind::input_paths) return info.min >= 1;  // the least number of files
  return (info.kind == ParamKind::input_path || info.kind == ParamKind::output_path) &&
         std::get<std::string>(info.initial).empty();
}

std::string describe_param(const ParamInfo& info) {
  const std::string start = is_required(info) ? "no default" : "default " + format_param(info, info.initial);
  return kind_name(info) + bounds_text(info) + (info.kind == ParamKind::choice ? "; " : ", ") + start;
}

}  // namespace atrium
