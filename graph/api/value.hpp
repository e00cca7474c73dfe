#pragma once
#include <array>
#include <concepts>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

struct XXH3_state_s;

namespace atrium {

/// What travels on an edge is a plain struct that says its stable name and its fields:
///
///   struct Transform {
///     static constexpr std::string_view port_type = "Transform";
///     static constexpr auto members() { return std::tuple{&Transform::rotation, &Transform::translation}; }
///     …
///   };
///
/// A type whose fields cannot be listed gives `static auto contents(const T&)`, a value that can be walked instead.
/// The fields give content hashes and sizes. A type with `static std::vector<Fact> facts(const T&)` is printed when it
/// is an output of a pipeline. Structs inside need only `members`. Numbers, strings, containers, shared pointers and
/// Eigen's fixed-size matrices are known.
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

/// 128-bit content hash (XXH3), as 32 hexadecimal digits.
class ContentHash {
 public:
  ContentHash();
  ~ContentHash();
  ContentHash(const ContentHash&) = delete;
  ContentHash& operator=(const ContentHash&) = delete;
  void bytes(const void* data, std::size_t size);
  std::string hex() const;

 private:
  XXH3_state_s* state_;
};

namespace detail {

template <class T>
concept HasMembers = requires {
  T::members();
};
template <class T>
concept EigenFixed = requires(const T& m) {
  T::SizeAtCompileTime;
  m.derived();
  m.data();
};
template <class T>
concept Range = requires(const T& r) {
  r.begin();
  r.end();
  r.size();
};
template <class T>
concept PointerLike = requires(const T& p) {
  static_cast<bool>(p);
  *p;
}
&&!std::is_arithmetic_v<T>;
/// May be hashed as one block of memory: no padding, no pointers.
template <class T>
constexpr bool is_flat() {
  return std::is_enum_v<T> || (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) || EigenFixed<T>;
}
template <class T>
struct IsFlatArray : std::false_type {};
template <class T, std::size_t N>
struct IsFlatArray<std::array<T, N>> : std::bool_constant<is_flat<T>()> {};

/// Walks every byte of a value that counts, in a fixed order. `sink(data, size, owned)` gets blocks; owned is false for
/// what other edges hold too (shared pointers), so that sizes are not counted twice.
template <class T, class Sink>
void walk(const T& value, Sink& sink) {
  if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
    sink(&value, sizeof(T));
  } else if constexpr (EigenFixed<T>) {
    sink(value.data(), sizeof(*value.data()) * static_cast<std::size_t>(value.size()));
  } else if constexpr (requires { T::contents(value); }) {
    walk(T::contents(value), sink);
  } else if constexpr (HasMembers<T>) {
    std::apply([&](auto... member) { (walk(value.*member, sink), ...); }, T::members());
  } else if constexpr (Range<T>) {
    const auto size = static_cast<std::uint64_t>(value.size());
    sink(&size, sizeof size);
    using Item = std::remove_cvref_t<decltype(*value.begin())>;
    if constexpr (requires { value.data(); } && (is_flat<Item>() || IsFlatArray<Item>::value)) {
      sink(value.data(), value.size() * sizeof(Item));
    } else {
      for (const auto& item : value) walk(static_cast<const Item&>(item), sink);
    }
  } else if constexpr (requires { std::tuple_size<T>::value; }) {
    std::apply([&](const auto&... item) { (walk(item, sink), ...); }, value);
  } else if constexpr (PointerLike<T>) {
    const std::uint8_t present = value ? 1 : 0;
    sink(&present, 1);
    if (value) sink.nested([&] { walk(*value, sink); });
  } else {
    static_assert(HasMembers<T>, "a port's value needs `static constexpr auto members()` that lists its fields");
  }
}

struct HashSink {
  ContentHash hash;
  void operator()(const void* data, std::size_t size) { hash.bytes(data, size); }
  template <class F>
  void nested(F f) {
    f();
  }
};
struct SizeSink {
  std::size_t size = 0;
  void operator()(const void* /*data*/, std::size_t n) { size += n; }
  template <class F>
  void nested(F /*f*/) {}
};

}  // namespace detail

/// The content hash of a value: equal for equal contents, whatever the run, thread count or machine (little-endian).
template <class T>
std::string content_hash(const T& value) {
  detail::HashSink sink;
  detail::walk(value, sink);
  return sink.hash.hex();
}
/// Bytes that the value itself holds (not what it shares with others).
template <class T>
std::size_t byte_size(const T& value) {
  detail::SizeSink sink;
  detail::walk(value, sink);
  return sink.size;
}

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
};

template <class T>
Value make_value(std::shared_ptr<const T> data) {
  return {std::move(data), [](const void* p) { return content_hash(*static_cast<const T*>(p)); },
          [](const void* p) { return byte_size(*static_cast<const T*>(p)); }, detail::facts_of<T>()};
}

}  // namespace atrium
