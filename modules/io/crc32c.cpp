#include "modules/io/crc32c.hpp"

#include <array>
#include <cstring>

#if defined(__x86_64__)
#include <nmmintrin.h>
#endif

namespace atrium::io {
namespace {

constexpr std::uint32_t polynomial = 0x82F63B78U;  // bits mirrored

/// tables[k][b]: what byte b does to the remainder when k bytes follow it.
constexpr auto crc_tables = [] {
  std::array<std::array<std::uint32_t, 256>, 8> tables{};
  for (std::uint32_t b = 0; b < 256; ++b) {
    std::uint32_t r = b;
    for (int bit = 0; bit < 8; ++bit) r = (r >> 1U) ^ ((r & 1U) != 0 ? polynomial : 0U);
    tables[0][b] = r;
  }
  for (std::size_t k = 1; k < 8; ++k)
    for (std::size_t b = 0; b < 256; ++b) tables[k][b] = (tables[k - 1][b] >> 8U) ^ tables[0][tables[k - 1][b] & 0xFFU];
  return tables;
}();

std::uint32_t by_tables(std::uint32_t crc, const std::byte* data, std::size_t size) {
  for (; size >= 8; data += 8, size -= 8) {
    std::uint32_t low = 0, high = 0;
    for (unsigned i = 0; i < 4; ++i) {
      low |= std::to_integer<std::uint32_t>(data[i]) << (8 * i);
      high |= std::to_integer<std::uint32_t>(data[4 + i]) << (8 * i);
    }
    low ^= crc;
    crc = 0;
    for (unsigned i = 0; i < 4; ++i)
      crc ^= crc_tables[7 - i][(low >> (8 * i)) & 0xFFU] ^ crc_tables[3 - i][(high >> (8 * i)) & 0xFFU];
  }
  for (; size > 0; ++data, --size)
    crc = (crc >> 8U) ^ crc_tables[0][(crc ^ std::to_integer<std::uint32_t>(*data)) & 0xFFU];
  return crc;
}

#if defined(__x86_64__)
__attribute__((target("sse4.2"))) std::uint32_t by_instruction(std::uint32_t crc, const std::byte* data,
                                                               std::size_t size) {
  std::uint64_t wide = crc;
  for (; size >= 8; data += 8, size -= 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, data, 8);
    wide = _mm_crc32_u64(wide, word);
  }
  crc = static_cast<std::uint32_t>(wide);
  for (; size > 0; ++data, --size) crc = _mm_crc32_u8(crc, std::to_integer<std::uint8_t>(*data));
  return crc;
}
#endif

}  // namespace

std::uint32_t crc32c(const std::byte* data, std::size_t size) {
#if defined(__x86_64__)
  static const bool has_instruction = __builtin_cpu_supports("sse4.2") != 0;
  if (has_instruction) return ~by_instruction(~0U, data, size);
#endif
  return ~by_tables(~0U, data, size);
}

}  // namespace atrium::io
