#pragma once
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

/// A node type is a struct with five tables and one pure function; its header is its manual.
///
///   struct VertexTranslation {
///     static constexpr std::string_view type = "refine.vertex_translation";
///     static constexpr std::string_view summary = "Moves each wall's nearest edge onto its meeting lines.";
///     struct In { Input<PlaneMeshes> meshes; Input<Adjacency> adjacency; };
///     struct Out { PlaneMeshes meshes; };
///     struct Params { double max_separation = 0.5; };
///     static constexpr auto inputs = std::tuple{port(&In::meshes, "meshes", "…"), port(&In::adjacency, "adjacency",
///     "…")}; static constexpr auto outputs = std::tuple{port(&Out::meshes, "meshes", "…")}; static constexpr auto
///     params = std::tuple{
///         param(&Params::max_separation, "max_separation", metres, within(0, 10), "… (the paper's th_sep).")};
///     static Out run(const In& in, const Params& params, Context& context);
///   };
///
/// A field that no table lists does not compile. Optional: `static constexpr int version` (raise it when the results
/// change), `static constexpr bool random = true` (it draws randomness from its Context: another seed, another result),
/// `static constexpr bool cached = false` (its result depends on more than its inputs, parameters, seed and the files
/// that its InputPath parameters name: it is computed in every run),
/// `static constexpr bool sink = true` (runs although nothing reads its outputs; nodes without outputs and
/// nodes with an OutputPath are sinks anyway).

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
template <class S, class T>
constexpr PortRow<S, T> port(T S::*member, std::string_view name, std::string_view doc) {
  return {member, name, doc};
}

struct PortInfo {
  std::string name, type, doc;
  bool optional = false, repeated = false;
  Value (*wrap)(std::shared_ptr<const void>) = nullptr;  ///< of an output: the value of a port from its data
  const FlatType* flat = nullptr;  ///< of an output: how its values are stored; null: they are not
};

/// A node type, erased: what the checker, the runner and `atrium nodes` know of it.
struct NodeType {
  std::string type, summary;
  int version = 1;
  bool sink = false, random = false, cached = true;
  std::string library;  ///< the plugin's file; empty for types of the program itself
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
  static constexpr bool optional = false, repeated = false;
};
template <class T>
struct InputKind<OptionalInput<T>> {
  using Type = T;
  static constexpr bool optional = true, repeated = false;
};
template <class T>
struct InputKind<std::vector<std::shared_ptr<const T>>> {
  using Type = T;
  static constexpr bool optional = false, repeated = true;
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
  } else if (!values.empty()) {
    in.*row.member = get<typename Kind::Type>(values.front());
  }
}

template <class N>
std::vector<Value> run_node(const std::vector<std::vector<Value>>& inputs, const std::vector<ParamValue>& values,
                            const std::vector<ParamInfo>& infos, Context& context) {
  typename N::In in{};
  typename N::Params params{};
  std::size_t i = 0;
  std::apply([&](const auto&... row) { (bind(in, row, inputs[i++]), ...); }, N::inputs);
  for (std::size_t k = 0; k < infos.size(); ++k) infos[k].assign(&params, values[k], infos[k].row);
  typename N::Out out = N::run(in, params, context);
  std::vector<Value> result;
  std::apply(
      [&](const auto&... row) {
        (result.push_back(OutputKind<std::remove_cvref_t<decltype(out.*row.member)>>::make(std::move(out.*row.member))),
         ...);
      },
      N::outputs);
  return result;
}

}  // namespace detail

/// Reads a node struct's tables: all of a node type but its function.
template <class N>
NodeType describe_tables() {
  static_assert(detail::field_count<typename N::In>() == std::tuple_size_v<decltype(N::inputs)>,
                "a field of In has no row in the table `inputs` (or a row too many)");
  static_assert(detail::field_count<typename N::Out>() == std::tuple_size_v<decltype(N::outputs)>,
                "a field of Out has no row in the table `outputs` (or a row too many)");
  static_assert(detail::field_count<typename N::Params>() == std::tuple_size_v<decltype(N::params)>,
                "a field of Params has no row in the table `params` (or a row too many)");
  NodeType node;
  node.type = N::type;
  node.summary = N::summary;
  if constexpr (requires { N::version; }) node.version = N::version;
  const auto add_input = [&]<class S, class T>(const PortRow<S, T>& row) {
    using Kind = detail::InputKind<T>;
    node.inputs.push_back({std::string(row.name), std::string(PortType<typename Kind::Type>::name),
                           std::string(row.doc), Kind::optional, Kind::repeated});
  };
  const auto add_output = [&]<class S, class T>(const PortRow<S, T>& row) {
    using Type = typename detail::OutputKind<T>::Type;
    const auto wrap = [](std::shared_ptr<const void> data) {
      return make_value<Type>(std::static_pointer_cast<const Type>(std::move(data)));
    };
    node.outputs.push_back({std::string(row.name), std::string(PortType<Type>::name), std::string(row.doc), false,
                            false, wrap, flat_type<Type>()});
  };
  std::apply([&](const auto&... row) { (add_input(row), ...); }, N::inputs);
  std::apply([&](const auto&... row) { (add_output(row), ...); }, N::outputs);
  const typename N::Params defaults{};
  std::apply([&](const auto&... row) { (node.params.push_back(detail::erase(row, defaults)), ...); }, N::params);
  if constexpr (requires { N::random; }) node.random = N::random;
  if constexpr (requires { N::cached; }) node.cached = N::cached;
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
