#pragma once
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "graph/api/error.hpp"
#include "graph/api/walk.hpp"

namespace atrium {

/// The flat form of a value: its bytes in the order in which they are hashed, little-endian. Arrays of 64 bytes and
/// more begin at a multiple of 64, so that a mapped file is read by one copy per array. What a value shares with others
/// (a std::shared_ptr in it) stands in it as its content hash and is stored on its own.
struct FlatType {
  std::string_view name;     ///< of the port type; empty for a type that is only inside others
  std::uint64_t layout = 0;  ///< from the kinds and sizes of all fields, in their order: another layout, another number
  std::string (*hash)(const void* value) = nullptr;
  void (*write)(const void* value, class FlatWriter& out) = nullptr;
  /// Throws Error if the bytes are not those of such a value.
  std::shared_ptr<const void> (*read)(class FlatReader& in) = nullptr;
};

/// A value that another one shares.
struct FlatReference {
  std::shared_ptr<const void> data;
  const FlatType* type = nullptr;
  std::string hash;  ///< of its contents
};

class FlatWriter {
 public:
  /// `sink` gets the bytes in blocks.
  explicit FlatWriter(std::function<void(const void* data, std::size_t size)> sink) : sink_(std::move(sink)) {}
  void bytes(const void* data, std::size_t size);
  void array(const void* data, std::size_t size);
  void reference(FlatReference reference);
  void finish();  ///< hands over the rest
  const std::vector<FlatReference>& references() const { return references_; }

 private:
  std::function<void(const void*, std::size_t)> sink_;
  std::vector<std::byte> buffer_;
  std::uint64_t position_ = 0;
  std::vector<FlatReference> references_;
};

/// Reads what FlatWriter wrote; nothing is believed: each method throws Error when the bytes do not suffice.
class FlatReader {
 public:
  /// Gives the shared value of that content hash; throws Error if it is not to be had.
  using Resolve = std::function<std::shared_ptr<const void>(const FlatType& type, const std::string& hash)>;
  FlatReader(const std::byte* data, std::size_t size, Resolve resolve);
  /// `read` copies `size` bytes from the place `at` of the value.
  using Read = std::function<void(void* to, std::uint64_t at, std::size_t size)>;
  FlatReader(Read read, std::size_t size, Resolve resolve)
      : read_(std::move(read)), size_(size), resolve_(std::move(resolve)) {}
  void bytes(void* to, std::size_t size);
  void array(void* to, std::size_t size);
  /// The number of items of a container, each of at least `item` bytes.
  std::size_t count(std::size_t item);
  std::shared_ptr<const void> reference(const FlatType& type);
  bool at_end() const { return position_ == size_; }

 private:
  Read read_;
  std::size_t size_, position_ = 0;
  std::vector<std::byte> window_;  ///< the bytes from window_at_ on, so that small reads are few
  std::size_t window_at_ = 0;
  Resolve resolve_;
};

template <class T>
const FlatType* flat_type();

namespace detail {

template <class T>
struct IsSharedConst : std::false_type {};
template <class T>
struct IsSharedConst<std::shared_ptr<const T>> : std::true_type {
  using Type = T;
};
/// The items of a container as they can be read (the keys of a map are not const).
template <class T>
struct Mutable {
  using Type = T;
};
template <class A, class B>
struct Mutable<std::pair<const A, B>> {
  using Type = std::pair<A, B>;
};
template <class T>
using ItemOf = typename Mutable<std::remove_cvref_t<decltype(*std::declval<const T&>().begin())>>::Type;
template <class T>
using ContentsOf = std::remove_cvref_t<decltype(T::contents(std::declval<const T&>()))>;
template <class T, class S>
S member_type(S T::*);
template <class T>
concept HasContents = requires(const T& v) {
  T::contents(v);
};
template <class T>
concept IsTuple = requires {
  std::tuple_size<T>::value;
};
template <class T>
constexpr bool is_block() {
  return requires(T & v) { v.data(); }
  &&(is_flat<ItemOf<T>>() || IsFlatArray<ItemOf<T>>::value);
}

/// Calls f.template operator()<Field>() for the type of each field or item.
template <class T, class F>
constexpr void for_each_part(F f) {
  if constexpr (HasContents<T>)
    f.template operator()<ContentsOf<T>>();
  else if constexpr (HasMembers<T>)
    std::apply([&](auto... member) { (f.template operator()<decltype(member_type(member))>(), ...); }, T::members());
  else if constexpr (Range<T>)
    f.template operator()<ItemOf<T>>();
  else if constexpr (IsTuple<T>)
    [&]<std::size_t... I>(std::index_sequence<I...>) { (f.template operator()<std::tuple_element_t<I, T>>(), ...); }
  (std::make_index_sequence<std::tuple_size_v<T>>());
  else if constexpr (PointerLike<T> && !EigenFixed<T>)
      f.template operator()<std::remove_cvref_t<decltype(*std::declval<const T&>())>>();
}

/// Whether a value can be made again from its flat form: no bare pointers, no `contents` without `from_contents`.
template <class T>
constexpr bool is_storable() {
  if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T> || EigenFixed<T>) {
    return true;
  } else {
    bool good = std::is_default_constructible_v<T> && !std::is_pointer_v<T>;
    if constexpr (HasContents<T>) good = good && requires(ContentsOf<T> c) {
        T::from_contents(std::move(c));
      };
    for_each_part<T>([&]<class Part>() { good = good && is_storable<Part>(); });
    return good;
  }
}

constexpr std::uint64_t mixed(std::uint64_t a, std::uint64_t b) {
  const std::uint64_t x = (a ^ (b + 0x9e3779b97f4a7c15ULL + (a << 6U) + (a >> 2U))) * 0xbf58476d1ce4e5b9ULL;
  return x ^ (x >> 29U);
}
template <class T>
constexpr std::uint64_t layout_of() {
  if constexpr (EigenFixed<T>) {
    return mixed(layout_of<typename T::Scalar>(), 1000U + static_cast<std::uint64_t>(T::SizeAtCompileTime));
  } else if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
    const std::uint64_t kind = std::is_floating_point_v<T> ? 1 : std::is_enum_v<T> ? 2 : std::is_signed_v<T> ? 3 : 4;
    return mixed(kind, sizeof(T));
  } else {
    std::uint64_t kind = 9;
    if constexpr (HasContents<T> || HasMembers<T>)
      kind = 5;
    else if constexpr (Range<T>)
      kind = 6;
    else if constexpr (IsTuple<T>)
      kind = 7;
    else if constexpr (IsSharedConst<T>::value)
      kind = 8;
    std::uint64_t layout = mixed(kind, 0);
    for_each_part<T>([&]<class Part>() { layout = mixed(layout, layout_of<Part>()); });
    return mixed(layout, kind);
  }
}

struct FlatSink {
  FlatWriter& out;
  void operator()(const void* data, std::size_t bytes) { out.bytes(data, bytes); }
  void array(const void* data, std::size_t bytes) { out.array(data, bytes); }
  template <class P>
  void pointer(const P& p) {
    const std::uint8_t present = p ? 1 : 0;
    out.bytes(&present, 1);
    if (!p) return;
    if constexpr (IsSharedConst<P>::value) {
      const FlatType* type = flat_type<typename IsSharedConst<P>::Type>();
      out.reference({p, type, type->hash(p.get())});
    } else {
      walk(*p, *this);
    }
  }
};

/// Whether the compiler knows an enumerator of that value: it spells any other one as a cast, "(E)7".
template <class E, E value>
consteval bool is_enumerator() {
  std::string_view text = __PRETTY_FUNCTION__;
  text.remove_prefix(text.rfind("value = ") + std::string_view("value = ").size());
  return !text.starts_with('(');
}
/// How many enumerators there are from 0 on without a gap. Those of an enum on a port are to be numbered so.
template <class E, std::uint64_t count = 0>
consteval std::uint64_t enumerators() {
  if constexpr (is_enumerator<E, static_cast<E>(count)>())
    return enumerators<E, count + 1>();
  else
    return count;
}
/// Throws Error if an enum has none of its values, which would be undefined behaviour or an index out of range later.
template <class T>
void check_enum(const T& value) {
  if constexpr (std::is_enum_v<T>) {
    if (static_cast<std::uint64_t>(value) >= enumerators<T>()) throw Error("an enum has none of its values");
  } else if constexpr (IsFlatArray<T>::value) {
    for (const auto& item : value) check_enum(item);
  }
}

template <class T>
void read_flat(T& value, FlatReader& in);

template <class T>
void read_range(T& value, FlatReader& in) {
  using Item = ItemOf<T>;
  const std::size_t size = in.count(is_block<T>() ? sizeof(Item) : 1);
  if constexpr (requires { std::tuple_size<T>::value; }) {
    if (size != value.size()) throw Error("an array has another length");
  } else if constexpr (is_block<T>()) {
    value.resize(size);
  }
  if constexpr (is_block<T>()) {
    in.array(value.data(), size * sizeof(Item));
    if constexpr (std::is_enum_v<Item> || IsFlatArray<Item>::value)
      for (const auto& item : value) check_enum(item);
  } else if constexpr (requires { std::tuple_size<T>::value; }) {
    for (auto& item : value) read_flat(item, in);
  } else {
    for (std::size_t i = 0; i < size; ++i) {
      Item item{};
      read_flat(item, in);
      value.insert(value.end(), std::move(item));
    }
  }
}

template <class T>
void read_pointer(T& value, FlatReader& in) {
  std::uint8_t present = 0;
  in.bytes(&present, 1);
  value = T{};
  if (present == 0) return;
  if constexpr (IsSharedConst<T>::value) {
    using Pointee = typename IsSharedConst<T>::Type;
    value = std::static_pointer_cast<const Pointee>(in.reference(*flat_type<Pointee>()));
  } else {
    std::remove_cvref_t<decltype(*value)> pointee{};
    read_flat(pointee, in);
    if constexpr (requires { typename T::element_type; })
      value = T(new typename T::element_type(std::move(pointee)));  // a std::unique_ptr or one that shares a mutable
    else
      value = std::move(pointee);
  }
}

template <class T>
void read_flat(T& value, FlatReader& in) {
  if constexpr (std::is_same_v<T, bool>) {  // another byte in a bool would be undefined behaviour
    std::uint8_t byte = 0;
    in.bytes(&byte, 1);
    if (byte > 1) throw Error("a truth value is neither 0 nor 1");
    value = byte == 1;
  } else if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
    in.bytes(&value, sizeof(T));
    check_enum(value);
  } else if constexpr (EigenFixed<T>) {
    in.bytes(value.data(), sizeof(*value.data()) * static_cast<std::size_t>(value.size()));
  } else if constexpr (HasContents<T>) {
    ContentsOf<T> contents{};
    read_flat(contents, in);
    value = T::from_contents(std::move(contents));
  } else if constexpr (HasMembers<T>) {
    std::apply([&](auto... member) { (read_flat(value.*member, in), ...); }, T::members());
  } else if constexpr (Range<T>) {
    read_range(value, in);
  } else if constexpr (IsTuple<T>) {
    std::apply([&](auto&... item) { (read_flat(item, in), ...); }, value);
  } else {
    read_pointer(value, in);
  }
}

}  // namespace detail

/// How values of the type are stored; null if they cannot be.
template <class T>
const FlatType* flat_type() {
  if constexpr (detail::is_storable<T>()) {
    static constexpr FlatType type{[] {
                                     if constexpr (requires { T::port_type; })
                                       return std::string_view(T::port_type);
                                     else
                                       return std::string_view();
                                   }(),
                                   detail::layout_of<T>(),
                                   [](const void* value) { return content_hash(*static_cast<const T*>(value)); },
                                   [](const void* value, FlatWriter& out) {
                                     detail::FlatSink sink{out};
                                     detail::walk(*static_cast<const T*>(value), sink);
                                   },
                                   [](FlatReader& in) -> std::shared_ptr<const void> {
                                     auto value = std::make_shared<T>();
                                     detail::read_flat(*value, in);
                                     return std::shared_ptr<const T>(std::move(value));
                                   }};
    return &type;
  } else {
    return nullptr;
  }
}

}  // namespace atrium
