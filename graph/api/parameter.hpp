#pragma once
#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace atrium {

/// The unit in which a parameter is stored; pipeline files may write any unit of the same dimension ("2 cm", "20 deg").
struct Unit {
  std::string_view symbol;     ///< as printed: "m", "deg", "" for plain numbers
  std::string_view dimension;  ///< "length", "angle", "area", "time", "ratio", "count", "number"
};
inline constexpr Unit metres{"m", "length"};
inline constexpr Unit square_metres{"m2", "area"};
inline constexpr Unit degrees{"deg", "angle"};
inline constexpr Unit seconds{"s", "time"};
inline constexpr Unit ratio{"", "ratio"};  ///< a share; "10 %" may be written
inline constexpr Unit count{"", "count"};  ///< how many of something: points, planes, iterations
inline constexpr Unit unitless{"", "number"};

/// A file or folder that must exist before the run starts. Relative paths are relative to the file that sets them (on
/// the command line: to the working folder); a node sees an absolute path.
struct InputPath {
  std::string path;
};
/// A file that the node writes, relative to the run's folder. Get its absolute path from Context::output.
struct OutputPath {
  std::string path;
};

/// A parameter's value in its declared unit.
using ParamValue = std::variant<bool, std::int64_t, double, std::string, std::vector<double>, std::vector<std::string>>;

enum class ParamKind { boolean, integer, number, text, choice, input_path, output_path, numbers, texts, input_paths };

/// One row of a node's parameter table, type-erased.
struct ParamInfo {
  std::string name;
  ParamKind kind{};
  Unit unit{};
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  std::size_t length = 0;  ///< exact number of values of a list; 0: any number
  std::vector<std::string> choices;
  std::string doc;
  ParamValue initial;  ///< the default, read from the node's Params initialiser
  void (*assign)(void* params, const ParamValue& value, const void* row) = nullptr;
  const void* row = nullptr;  ///< the constexpr table row that `assign` needs
};

/// A value as written in a file or on the command line, before it is known what it must be.
struct RawValue {
  std::vector<std::string> items;  ///< one item for a scalar
  bool is_list = false;
  bool quoted = false;  ///< a quoted scalar is text, never a number
};

/// Reads a raw value as `info` wants it: decimal numbers, units of the right dimension, true/false, one of the choices,
/// within the bounds. Throws Error whose message says what is wrong and whose help says what would be right.
ParamValue parse_param(const ParamInfo& info, const RawValue& raw);

/// The value in the canonical form that, as YAML, parse_param reads back to the same value ("0.02 m", "[1, 2]", "wall";
/// text that would be something else in YAML stands in double quotes).
std::string format_param(const ParamInfo& info, const ParamValue& value);

/// "length, 0 m to 10 m, default 0.5 m": what a parameter accepts, for help texts.
std::string describe_param(const ParamInfo& info);

/// What may be written behind a number of that unit's dimension: "km", "m", "cm", …
std::vector<std::string> units_of(const Unit& unit);

/// A path whose default is empty must be set.
bool is_required(const ParamInfo& info);

// --- The table's rows ------------------------------------------------------------------------------------------------

struct Bounds {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};
constexpr Bounds within(double low, double high) { return {low, high}; }
constexpr Bounds at_least(double low) { return {low, std::numeric_limits<double>::infinity()}; }
inline constexpr Bounds unbounded{};

template <class E>
struct Choice {
  std::string_view name;
  E value;
};

template <class P, class T>
struct ParamRow {
  T P::*member;
  std::string_view name;
  Unit unit;
  Bounds bounds;
  std::string_view doc;
};
template <class P, class E, std::size_t N>
struct ChoiceRow {
  E P::*member;
  std::string_view name;
  Choice<E> choices[N];
  std::string_view doc;
};

namespace detail {

/// "x" for &Params::x, as the compiler spells it.
template <auto Member>
consteval std::string_view member_name() {
  std::string_view name = __PRETTY_FUNCTION__;
  name.remove_prefix(name.find("Member = ") + std::string_view("Member = ").size());
  name = name.substr(0, name.find_first_of(";]"));
  return name.substr(name.rfind("::") + 2);
}

template <class T>
struct Member;
template <class S, class T>
struct Member<T S::*> {
  using Struct = S;
  using Type = T;
};
template <auto M>
using StructOf = typename Member<decltype(M)>::Struct;
template <auto M>
using TypeOf = typename Member<decltype(M)>::Type;

}  // namespace detail

/// A number, an integer or a list of numbers (std::vector<double>, Eigen fixed vectors are not parameters) with unit
/// and bounds (bounds hold for each item): param<&Params::x>(metres, within(0, 10), "…"). Its name is the member's.
template <auto Member>
constexpr auto param(Unit unit, Bounds bounds, std::string_view doc) {
  using T = detail::TypeOf<Member>;
  static_assert(std::is_arithmetic_v<T> || std::is_same_v<T, std::vector<double>>,
                "a parameter with a unit is a double, an integer or a std::vector<double>");
  return ParamRow<detail::StructOf<Member>, T>{Member, detail::member_name<Member>(), unit, bounds, doc};
}
/// A bool, std::string, InputPath, OutputPath, std::vector<std::string> or std::vector<InputPath>.
template <auto Member>
constexpr auto param(std::string_view doc) {
  using T = detail::TypeOf<Member>;
  static_assert(!std::is_floating_point_v<T>, "a number needs its unit and bounds: param<&Params::x>(metres, …)");
  return ParamRow<detail::StructOf<Member>, T>{Member, detail::member_name<Member>(), unitless, unbounded, doc};
}
/// One of several named values: param<&Params::method>({{"knn", Method::knn}, …}, "…").
template <auto Member, std::size_t N>
constexpr auto param(const Choice<detail::TypeOf<Member>> (&choices)[N], std::string_view doc) {
  ChoiceRow<detail::StructOf<Member>, detail::TypeOf<Member>, N> row{Member, detail::member_name<Member>(), {}, doc};
  for (std::size_t i = 0; i < N; ++i) row.choices[i] = choices[i];
  return row;
}

namespace detail {

template <class T>
ParamValue to_value(const T& v) {
  if constexpr (std::is_same_v<T, bool> || std::is_same_v<T, std::string> || std::is_same_v<T, std::vector<double>> ||
                std::is_same_v<T, std::vector<std::string>>) {
    return v;
  } else if constexpr (std::is_integral_v<T>) {
    return static_cast<std::int64_t>(v);
  } else if constexpr (std::is_floating_point_v<T>) {
    return static_cast<double>(v);
  } else if constexpr (std::is_same_v<T, std::vector<InputPath>>) {
    std::vector<std::string> paths;
    paths.reserve(v.size());
    for (const auto& p : v) paths.push_back(p.path);
    return paths;
  } else {
    return v.path;
  }
}

template <class T>
T from_value(const ParamValue& value) {
  if constexpr (std::is_same_v<T, bool> || std::is_same_v<T, std::string> || std::is_same_v<T, std::vector<double>> ||
                std::is_same_v<T, std::vector<std::string>>) {
    return std::get<T>(value);
  } else if constexpr (std::is_integral_v<T>) {
    return static_cast<T>(std::get<std::int64_t>(value));
  } else if constexpr (std::is_floating_point_v<T>) {
    return static_cast<T>(std::get<double>(value));
  } else if constexpr (std::is_same_v<T, std::vector<InputPath>>) {
    std::vector<InputPath> paths;
    for (const auto& p : std::get<std::vector<std::string>>(value)) paths.push_back({p});
    return paths;
  } else {
    return T{std::get<std::string>(value)};
  }
}

template <class T>
constexpr ParamKind kind_of() {
  if constexpr (std::is_same_v<T, bool>)
    return ParamKind::boolean;
  else if constexpr (std::is_integral_v<T>)
    return ParamKind::integer;
  else if constexpr (std::is_floating_point_v<T>)
    return ParamKind::number;
  else if constexpr (std::is_same_v<T, std::string>)
    return ParamKind::text;
  else if constexpr (std::is_same_v<T, InputPath>)
    return ParamKind::input_path;
  else if constexpr (std::is_same_v<T, OutputPath>)
    return ParamKind::output_path;
  else if constexpr (std::is_same_v<T, std::vector<double>>)
    return ParamKind::numbers;
  else if constexpr (std::is_same_v<T, std::vector<std::string>>)
    return ParamKind::texts;
  else if constexpr (std::is_same_v<T, std::vector<InputPath>>)
    return ParamKind::input_paths;
}

/// Whether a default is what its own row allows.
template <class P, class T>
constexpr bool fits(const ParamRow<P, T>& row, const P& defaults) {
  const auto inside = [&](double v) { return v >= row.bounds.min && v <= row.bounds.max; };
  if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) {
    return inside(static_cast<double>(defaults.*row.member));
  } else if constexpr (std::is_same_v<T, std::vector<double>>) {
    return std::all_of((defaults.*row.member).begin(), (defaults.*row.member).end(), inside);
  } else {
    return true;
  }
}
template <class P, class E, std::size_t N>
constexpr bool fits(const ChoiceRow<P, E, N>& row, const P& defaults) {
  return std::any_of(std::begin(row.choices), std::end(row.choices),
                     [&](const Choice<E>& choice) { return choice.value == defaults.*row.member; });
}

template <class P, class T>
ParamInfo erase(const ParamRow<P, T>& row, const P& defaults) {
  ParamInfo info;
  info.name = row.name;
  info.kind = kind_of<T>();
  info.unit = row.unit;
  info.min = row.bounds.min;
  info.max = row.bounds.max;
  info.doc = row.doc;
  info.initial = to_value(defaults.*row.member);
  if constexpr (std::is_integral_v<T> && !std::is_same_v<T, bool>) {
    info.min = std::max(info.min, static_cast<double>(std::numeric_limits<T>::min()));
    info.max = std::min(info.max, static_cast<double>(std::numeric_limits<T>::max()));
  }
  if constexpr (std::is_same_v<T, std::vector<double>>) info.length = (defaults.*row.member).size();
  info.row = &row;
  info.assign = [](void* params, const ParamValue& value, const void* r) {
    static_cast<P*>(params)->*static_cast<const ParamRow<P, T>*>(r)->member = from_value<T>(value);
  };
  return info;
}

template <class P, class E, std::size_t N>
ParamInfo erase(const ChoiceRow<P, E, N>& row, const P& defaults) {
  ParamInfo info;
  info.name = row.name;
  info.kind = ParamKind::choice;
  info.doc = row.doc;
  for (const auto& choice : row.choices) {
    info.choices.emplace_back(choice.name);
    if (choice.value == defaults.*row.member) info.initial = std::string(choice.name);
  }
  info.row = &row;
  info.assign = [](void* params, const ParamValue& value, const void* r) {
    const auto* table = static_cast<const ChoiceRow<P, E, N>*>(r);
    for (const auto& choice : table->choices)
      if (choice.name == std::get<std::string>(value)) static_cast<P*>(params)->*table->member = choice.value;
  };
  return info;
}

}  // namespace detail
}  // namespace atrium
