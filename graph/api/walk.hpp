#pragma once
#include <array>
#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

struct XXH3_state_s;

namespace atrium {

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
/// Of the bytes.
std::string hash_of_text(std::string_view text);

namespace detail {

template <class T>
concept HasMembers = requires {
  T::members();
};
template <class T>
concept EigenDense = requires(const T& m) {
  T::SizeAtCompileTime;
  m.derived();
  m.data();
};
template <class T>
constexpr bool is_eigen_fixed() {
  if constexpr (EigenDense<T>)
    return T::SizeAtCompileTime >= 0;  // else Eigen::Dynamic
  else
    return false;
}
template <class T>
concept EigenFixed = is_eigen_fixed<T>();
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

/// Walks every byte of a value that counts, in a fixed order: `sink(data, size)` gets single numbers and the like,
/// `sink.array(data, size)` the items of a container in one block, `sink.pointer(p)` what may be null or shared.
template <class T, class Sink>
void walk(const T& value, Sink& sink) {
  static_assert(!EigenDense<T> || EigenFixed<T>,
                "of Eigen's matrices only those of a fixed size can be on a port: give a std::vector of columns");
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
      sink.array(value.data(), value.size() * sizeof(Item));
    } else {
      for (const auto& item : value) walk(static_cast<const Item&>(item), sink);
    }
  } else if constexpr (requires { std::tuple_size<T>::value; }) {
    std::apply([&](const auto&... item) { (walk(item, sink), ...); }, value);
  } else if constexpr (PointerLike<T>) {
    sink.pointer(value);
  } else {
    static_assert(HasMembers<T>, "a port's value needs `static constexpr auto members()` that lists its fields");
  }
}

struct HashSink {
  ContentHash hash;
  void operator()(const void* data, std::size_t bytes) { hash.bytes(data, bytes); }
  void array(const void* data, std::size_t bytes) { hash.bytes(data, bytes); }
  template <class P>
  void pointer(const P& p) {
    const std::uint8_t present = p ? 1 : 0;
    hash.bytes(&present, 1);
    if (p) walk(*p, *this);
  }
};
/// What a pointer leads to is not counted: other edges hold it too.
struct SizeSink {
  std::size_t size = 0;
  void operator()(const void* /*data*/, std::size_t bytes) { size += bytes; }
  void array(const void* /*data*/, std::size_t bytes) { size += bytes; }
  template <class P>
  void pointer(const P& /*p*/) {
    ++size;
  }
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

}  // namespace atrium
