#pragma once
#include <array>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace atrium::baseline {

/// What a node and its helper program hand each other, in both directions: the request on the helper's standard input,
/// the reply on its standard output. What the columns hold is said where they are filled.
struct Exchange {
  auto columns() { return std::tie(numbers, text, points, normals, triangles, indices); }
  std::vector<double> numbers;
  std::string text;  ///< in a reply: why there is none, and from its second line on, what would help
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<double, 3>> normals;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::int32_t> indices;
};

/// First word of an exchange; changes with the columns, so that a helper of another build is noticed.
inline constexpr std::uint64_t exchange_mark = 0x4154524955583031ULL;

/// The columns as bytes of this machine: the mark, then for each column its number of items and the items.
inline std::string to_bytes(Exchange exchange) {
  std::string bytes(reinterpret_cast<const char*>(&exchange_mark), sizeof exchange_mark);
  const auto put = [&](const auto& column) {
    const std::uint64_t items = column.size();
    bytes.append(reinterpret_cast<const char*>(&items), sizeof items);
    bytes.append(reinterpret_cast<const char*>(column.data()), items * sizeof column[0]);
  };
  std::apply([&](const auto&... column) { (put(column), ...); }, exchange.columns());
  return bytes;
}

/// Throws std::runtime_error when the bytes are not a whole exchange.
inline Exchange from_bytes(std::string_view bytes) {
  const auto take = [&](void* target, std::size_t size) {
    if (bytes.size() < size) throw std::runtime_error("incomplete exchange");
    if (size > 0) std::memcpy(target, bytes.data(), size);
    bytes.remove_prefix(size);
  };
  std::uint64_t mark = 0;
  take(&mark, sizeof mark);
  if (mark != exchange_mark) throw std::runtime_error("not an exchange of this version");
  Exchange exchange;
  const auto get = [&](auto& column) {
    std::uint64_t items = 0;
    take(&items, sizeof items);
    if (items > bytes.size() / sizeof column[0]) throw std::runtime_error("incomplete exchange");
    column.resize(items);
    take(column.data(), items * sizeof column[0]);
  };
  std::apply([&](auto&... column) { (get(column), ...); }, exchange.columns());
  if (!bytes.empty()) throw std::runtime_error("bytes after the exchange");
  return exchange;
}

}  // namespace atrium::baseline
