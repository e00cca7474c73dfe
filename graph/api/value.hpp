#pragma once
#include <concepts>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "graph/api/flat.hpp"
#include "graph/api/walk.hpp"

namespace atrium {

/// What travels on an edge is a plain struct that says its stable name and its fields:
///
///   struct Transform {
///     static constexpr std::string_view port_type = "Transform";
///     static constexpr auto members() { return std::tuple{&Transform::rotation, &Transform::translation}; }
///     …
///   };
///
/// A type whose fields cannot be listed gives `static auto contents(const T&)`, a value that can be walked instead, and
/// its inverse, `static T from_contents(contents)`. The fields give content hashes, sizes and the form in which the
/// cache stores it. A type with `static std::vector<Fact> facts(const T&)` is printed when it is an output of a
/// pipeline. Structs inside need only `members`. Numbers, strings, containers, shared pointers and Eigen's fixed-size
/// matrices are known.
template <class T>
struct PortType {
  static constexpr std::string_view name = T::port_type;
};
template <>
struct PortType<bool> {
  static constexpr std::string_view name = "Boolean";
};
template <>
struct PortType<std::int64_t> {
  static constexpr std::string_view name = "Integer";
};
template <>
struct PortType<double> {
  static constexpr std::string_view name = "Number";
};
template <>
struct PortType<std::string> {
  static constexpr std::string_view name = "Text";
};

/// One line of a value's printed form.
struct Fact {
  std::string name;  ///< empty for a value that is a single number or text
  std::variant<bool, std::int64_t, double, std::string> value;
  std::string unit;  ///< "m", "deg", …; empty for none
};

namespace detail {

/// A port type is printable if it is a number or a text, or has `static std::vector<Fact> facts(const T&)`.
template <class T>
concept HasFacts = requires(const T& v) {
  { T::facts(v) } -> std::same_as<std::vector<Fact>>;
};
template <class T>
constexpr auto facts_of() -> std::vector<Fact> (*)(const void*) {
  if constexpr (std::is_same_v<T, bool> || std::is_same_v<T, std::int64_t> || std::is_same_v<T, double> ||
                std::is_same_v<T, std::string>) {
    return [](const void* p) { return std::vector<Fact>{{"", *static_cast<const T*>(p), ""}}; };
  } else if constexpr (HasFacts<T>) {
    return [](const void* p) { return T::facts(*static_cast<const T*>(p)); };
  } else {
    return nullptr;
  }
}

}  // namespace detail

/// A value on an edge, type-erased.
struct Value {
  std::shared_ptr<const void> data;
  std::string (*hash)(const void*) = nullptr;
  std::size_t (*bytes)(const void*) = nullptr;
  std::vector<Fact> (*facts)(const void*) = nullptr;  ///< null: the type is not one that is printed
  const FlatType* flat = nullptr;                     ///< null: it cannot be stored
};

template <class T>
Value make_value(std::shared_ptr<const T> data) {
  return {std::move(data), [](const void* p) { return content_hash(*static_cast<const T*>(p)); },
          [](const void* p) { return byte_size(*static_cast<const T*>(p)); }, detail::facts_of<T>(), flat_type<T>()};
}

}  // namespace atrium
