#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace atrium::io {

/// The number types that files store.
enum class Scalar : std::uint8_t { none, i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };

constexpr std::size_t size_of(Scalar type) {
  switch (type) {
    case Scalar::i8:
    case Scalar::u8: return 1;
    case Scalar::i16:
    case Scalar::u16: return 2;
    case Scalar::i32:
    case Scalar::u32:
    case Scalar::f32: return 4;
    case Scalar::i64:
    case Scalar::u64:
    case Scalar::f64: return 8;
    default: return 0;
  }
}
constexpr bool is_floating(Scalar type) { return type == Scalar::f32 || type == Scalar::f64; }

/// Calls f(T{}) with the C++ type of `type`.
template <class F>
decltype(auto) with_scalar(Scalar type, F&& f) {
  switch (type) {
    case Scalar::i8: return f(std::int8_t{});
    case Scalar::u8: return f(std::uint8_t{});
    case Scalar::i16: return f(std::int16_t{});
    case Scalar::u16: return f(std::uint16_t{});
    case Scalar::i32: return f(std::int32_t{});
    case Scalar::u32: return f(std::uint32_t{});
    case Scalar::i64: return f(std::int64_t{});
    case Scalar::u64: return f(std::uint64_t{});
    case Scalar::f32: return f(float{});
    default: return f(double{});
  }
}

/// Reads an unaligned number; `swapped`: its bytes are in the other order than this machine's.
template <class T>
T load(const std::byte* place, bool swapped = false) {
  T value;
  if (swapped && sizeof(T) > 1) {
    std::byte turned[sizeof(T)];
    for (std::size_t i = 0; i < sizeof(T); ++i) turned[i] = place[sizeof(T) - 1 - i];
    std::memcpy(&value, turned, sizeof(T));
  } else {
    std::memcpy(&value, place, sizeof(T));
  }
  return value;
}

inline double load_number(Scalar type, const std::byte* place, bool swapped) {
  return with_scalar(type, [&](auto t) { return static_cast<double>(load<decltype(t)>(place, swapped)); });
}

}  // namespace atrium::io
