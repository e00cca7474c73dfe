#pragma once
#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "graph/api/context.hpp"
#include "graph/api/error.hpp"
#include "graph/api/parameter.hpp"
#include "graph/api/value.hpp"

namespace atrium {

/// A node type is a struct with tables and one pure function; its header is its manual.
///
// clang-format off
///   struct VertexTranslation {
///     static constexpr std::string_view type = "refine.vertex_translation";
///     static constexpr std::string_view summary = "Moves each wall's nearest edge onto its meeting lines.";
///     struct In { Input<PlaneMeshes> meshes; Input<Adjacency> adjacency; };
///     struct Out { PlaneMeshes meshes; };
///     struct Params { double max_separation = 0.5; };
///     static constexpr auto inputs = std::tuple{
///         port<&In::meshes>("Walls, floors and ceilings."),
///         port<&In::adjacency>("Their neighbourhood: vertex i is mesh i.")};
///     static constexpr auto outputs = std::tuple{port<&Out::meshes>("The same meshes, walls closed.")};
///     static constexpr auto params = std::tuple{
///         param<&Params::max_separation>(metres, within(0, 10), "No vertex moves further (the paper's th_sep).")};
///     static Out run(const In& in, const Params& params, Context& context);
///   };
// clang-format on
///
/// A port or parameter is called as its field. What does not compile: a field that no row lists or that two list, a
/// capital letter in its name, a default outside its bounds or in no choice. What is empty is left out: `In`, `Out`
/// and `Params` with their tables, and each argument of `run` that it does not use (their order stays); without `Out`
/// it returns nothing.
///
/// Optional: `static constexpr int version` (raise it when the results change), `static constexpr bool random = true`
/// (it draws randomness from its Context: another seed, another result), `static constexpr bool cached = false` (its
/// result depends on more than its inputs, parameters, seed and the files that its InputPath parameters name: it is
/// computed in every run), `static constexpr bool runs_programs = true` (it starts a program that its parameters name:
/// refused in a pipeline that a picture holds), `static constexpr bool sink = true` (runs although nothing reads its
/// outputs; nodes without outputs and nodes with an OutputPath are sinks anyway).

/// A required input: never null in run().
template <class T>
using Input = std::shared_ptr<const T>;
/// An input that may be left unwired: null then.
template <class T>
struct OptionalInput : std::shared_ptr<const T> {
  using std::shared_ptr<const T>::shared_ptr;
  OptionalInput() = default;
  OptionalInput(std::shared_ptr<const T> p)
      : std::shared_ptr<const T>(std::move(p)) {}  // NOLINT(google-explicit-constructor)
};
/// An input that run() does not use: it lets a node that needs less stand in for another one, wired as that one is.
/// Nodes of which only such inputs want something are left out of the run.
template <class T>
struct UnusedInput {};
/// A port that takes a list of edges (`in: {clouds: [a.cloud, b.cloud]}`), in the order of the file; at least one.
template <class T>
using Inputs = std::vector<std::shared_ptr<const T>>;
/// An output that is one of the inputs handed on (or shared otherwise), without a copy. Never null.
template <class T>
using SharedOutput = std::shared_ptr<const T>;

template <class T>
Input<T> input(T value) {
  return std::make_shared<const T>(std::move(value));
}

template <class S, class T>
struct PortRow {
  T S::*member;
  std::string_view name;
  std::string_view doc;
};
template <auto Member>
constexpr auto port(std::string_view doc) {
  return PortRow<detail::StructOf<Member>, detail::TypeOf<Member>>{Member, detail::member_name<Member>(), doc};
}

struct PortInfo {
  std::string name, type, doc;
  bool optional = false, repeated = false;
  bool unused = false;                                   ///< of an input: its node does not look at it
  Value (*wrap)(std::shared_ptr<const void>) = nullptr;  ///< of an output: the value of a port from its data
  const FlatType* flat = nullptr;  ///< how its values are laid out and stored; null: they are not stored
};

/// A node type, erased: what the checker, the runner and `atrium nodes` know of it.
struct NodeType {
  std::string type, summary;
  int version = 1;
  bool sink = false, random = false, cached = true;
  bool runs_programs = false;  ///< it starts what its parameters name
  std::string library;         ///< the plugin's file; empty for types of the program itself
  std::vector<PortInfo> inputs, outputs;
  std::vector<ParamInfo> params;
  /// inputs[i] belongs to port i and holds 0, 1 or many values; params[i] to parameter i. Returns one value per output.
  std::function<std::vector<Value>(const std::vector<std::vector<Value>>& inputs, const std::vector<ParamValue>& params,
                                   Context& context)>
      run;
};

namespace detail {

struct Any {
  template <class T>
  constexpr operator T() const;  // NOLINT(google-explicit-constructor)
};
template <class T, class... A>
constexpr std::size_t field_count() {
  if constexpr (requires { T{A{}..., Any{}}; })
    return field_count<T, A..., Any>();
  else
    return sizeof...(A);
}

template <class T>
struct InputKind;
template <class T>
struct InputKind<std::shared_ptr<const T>> {
  using Type = T;
  static constexpr bool optional = false, repeated = false, unused = false;
};
template <class T>
struct InputKind<OptionalInput<T>> {
  using Type = T;
  static constexpr bool optional = true, repeated = false, unused = false;
};
template <class T>
struct InputKind<UnusedInput<T>> {
  using Type = T;
  static constexpr bool optional = true, repeated = false, unused = true;
};
template <class T>
struct InputKind<std::vector<std::shared_ptr<const T>>> {
  using Type = T;
  static constexpr bool optional = false, repeated = true, unused = false;
};
template <class T>
struct OutputKind {
  using Type = T;
  static Value make(T&& v) { return make_value<T>(std::make_shared<const T>(std::move(v))); }
};
template <class T>
struct OutputKind<std::shared_ptr<const T>> {
  using Type = T;
  static Value make(std::shared_ptr<const T>&& v) { return make_value<T>(std::move(v)); }
};

template <class T>
std::shared_ptr<const T> get(const Value& value) {
  return std::static_pointer_cast<const T>(value.data);
}

template <class S, class T>
void bind(S& in, const PortRow<S, T>& row, const std::vector<Value>& values) {
  using Kind = InputKind<T>;
  if constexpr (Kind::repeated) {
    for (const auto& v : values) (in.*row.member).push_back(get<typename Kind::Type>(v));
  } else if constexpr (!Kind::unused) {
    if (!values.empty()) in.*row.member = get<typename Kind::Type>(values.front());
  }
}

/// What stands for a struct that a node leaves out.
struct Nothing {};
template <class N>
constexpr auto in_of() {
  if constexpr (requires { typename N::In; })
    return std::type_identity<typename N::In>{};
  else
    return std::type_identity<Nothing>{};
}
template <class N>
constexpr auto out_of() {
  if constexpr (requires { typename N::Out; })
    return std::type_identity<typename N::Out>{};
  else
    return std::type_identity<Nothing>{};
}
template <class N>
constexpr auto fields_of_params() {
  if constexpr (requires { typename N::Params; })
    return std::type_identity<typename N::Params>{};
  else
    return std::type_identity<Nothing>{};
}
template <class N>
using InOf = typename decltype(in_of<N>())::type;
template <class N>
using OutOf = typename decltype(out_of<N>())::type;
template <class N>
using ParamsOf = typename decltype(fields_of_params<N>())::type;

inline constexpr std::tuple<> no_rows{};
template <class N>
constexpr auto inputs_of() {
  if constexpr (requires { N::inputs; })
    return N::inputs;
  else
    return std::tuple{};
}
template <class N>
constexpr auto outputs_of() {
  if constexpr (requires { N::outputs; })
    return N::outputs;
  else
    return std::tuple{};
}
/// By reference: ParamInfo::row points into it.
template <class N>
constexpr const auto& params_of() {
  if constexpr (requires { N::params; }) {
    return N::params;
  } else {
    return no_rows;
  }
}

/// Calls `run` with those of its arguments that it takes.
template <class N, class In, class Params>
auto call(const In& in, const Params& params, Context& context) {
  if constexpr (requires { N::run(in, params, context); })
    return N::run(in, params, context);
  else if constexpr (requires { N::run(in, params); })
    return N::run(in, params);
  else if constexpr (requires { N::run(in, context); })
    return N::run(in, context);
  else if constexpr (requires { N::run(params, context); })
    return N::run(params, context);
  else if constexpr (requires { N::run(in); })
    return N::run(in);
  else if constexpr (requires { N::run(params); })
    return N::run(params);
  else if constexpr (requires { N::run(context); })
    return N::run(context);
  else
    return N::run();
}

constexpr bool is_name(std::string_view name) {
  const auto fits = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; };
  return !name.empty() && name.front() >= 'a' && name.front() <= 'z' && std::all_of(name.begin(), name.end(), fits);
}
template <class... Row>
constexpr bool names_are_right(const std::tuple<Row...>& table) {
  return std::apply(
      [](const auto&... row) {
        const std::array<std::string_view, sizeof...(Row)> names{row.name...};
        for (std::size_t i = 0; i < names.size(); ++i)
          if (!is_name(names[i]) || std::find(names.begin(), names.begin() + i, names[i]) != names.begin() + i)
            return false;
        return true;
      },
      table);
}

template <class P, int = (P{}, 0)>
constexpr bool are_constant(int /*preferred*/) {
  return true;
}
template <class P>
constexpr bool are_constant(...) {
  return false;
}
/// Defaults that the compiler cannot compute (large texts, what a function returns) pass.
template <class N>
constexpr bool defaults_fit() {
  using Params = ParamsOf<N>;
  if constexpr (are_constant<Params>(0)) {
    Params defaults{};  // not const: GCC 12 does not make constant texts at compile time
    return std::apply([&](const auto&... row) { return (fits(row, defaults) && ...); }, params_of<N>());
  } else {
    return true;
  }
}

template <class N>
std::vector<Value> run_node(const std::vector<std::vector<Value>>& inputs, const std::vector<ParamValue>& values,
                            const std::vector<ParamInfo>& infos, Context& context) {
  InOf<N> in{};
  ParamsOf<N> params{};
  [[maybe_unused]] std::size_t i = 0;
  std::apply([&](const auto&... row) { (bind(in, row, inputs[i++]), ...); }, inputs_of<N>());
  for (std::size_t k = 0; k < infos.size(); ++k) infos[k].assign(&params, values[k], infos[k].row);
  std::vector<Value> result;
  if constexpr (std::tuple_size_v<decltype(outputs_of<N>())> == 0) {
    call<N>(in, params, context);
  } else {
    auto out = call<N>(in, params, context);
    std::apply(
        [&](const auto&... row) {
          (result.push_back(
               OutputKind<std::remove_cvref_t<decltype(out.*row.member)>>::make(std::move(out.*row.member))),
           ...);
        },
        outputs_of<N>());
  }
  return result;
}

}  // namespace detail

/// Reads a node struct's tables: all of a node type but its function.
template <class N>
NodeType describe_tables() {
  constexpr auto inputs = detail::inputs_of<N>();
  constexpr auto outputs = detail::outputs_of<N>();
  constexpr const auto& params = detail::params_of<N>();
  using Params = detail::ParamsOf<N>;
  static_assert(detail::field_count<detail::InOf<N>>() == std::tuple_size_v<decltype(inputs)>,
                "a field of In has no row in the table `inputs` (or a row too many)");
  static_assert(detail::field_count<detail::OutOf<N>>() == std::tuple_size_v<decltype(outputs)>,
                "a field of Out has no row in the table `outputs` (or a row too many)");
  static_assert(detail::field_count<Params>() == std::tuple_size_v<std::remove_cvref_t<decltype(params)>>,
                "a field of Params has no row in the table `params` (or a row too many)");
  static_assert(detail::names_are_right(inputs) && detail::names_are_right(outputs) && detail::names_are_right(params),
                "a field is listed twice, or its name is not of lower-case letters, digits and '_'");
  static_assert(detail::defaults_fit<N>(), "a default is outside its own bounds, or is none of its choices");
  NodeType node;
  node.type = N::type;
  node.summary = N::summary;
  if constexpr (requires { N::version; }) node.version = N::version;
  const auto add_input = [&]<class S, class T>(const PortRow<S, T>& row) {
    using Kind = detail::InputKind<T>;
    node.inputs.push_back({std::string(row.name), std::string(PortType<typename Kind::Type>::name),
                           std::string(row.doc), Kind::optional, Kind::repeated, Kind::unused, nullptr,
                           flat_type<typename Kind::Type>()});
  };
  const auto add_output = [&]<class S, class T>(const PortRow<S, T>& row) {
    using Type = typename detail::OutputKind<T>::Type;
    const auto wrap = [](std::shared_ptr<const void> data) {
      return make_value<Type>(std::static_pointer_cast<const Type>(std::move(data)));
    };
    node.outputs.push_back({std::string(row.name), std::string(PortType<Type>::name), std::string(row.doc), false,
                            false, false, wrap, flat_type<Type>()});
  };
  std::apply([&](const auto&... row) { (add_input(row), ...); }, inputs);
  std::apply([&](const auto&... row) { (add_output(row), ...); }, outputs);
  const Params defaults{};
  std::apply([&](const auto&... row) { (node.params.push_back(detail::erase(row, defaults)), ...); }, params);
  if constexpr (requires { N::random; }) node.random = N::random;
  if constexpr (requires { N::cached; }) node.cached = N::cached;
  if constexpr (requires { N::runs_programs; }) node.runs_programs = N::runs_programs;
  node.sink = node.outputs.empty();
  if constexpr (requires { N::sink; }) node.sink = node.sink || N::sink;
  for (const auto& p : node.params) node.sink = node.sink || p.kind == ParamKind::output_path;
  return node;
}

/// Reads a node struct's tables and takes its function.
template <class N>
NodeType describe_node() {
  NodeType node = describe_tables<N>();
  node.run = [infos = node.params](const std::vector<std::vector<Value>>& inputs, const std::vector<ParamValue>& values,
                                   Context& context) { return detail::run_node<N>(inputs, values, infos, context); };
  return node;
}

}  // namespace atrium
