#include "graph/pipeline/utf8.hpp"

#include <cstdint>

namespace atrium {
namespace {

/// Length of the sequence that begins at `at`, or 0 when it is not valid.
std::size_t sequence_length(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
  const std::uint32_t first = byte(at);
  std::size_t length = 0;
  std::uint32_t code = 0, least = 0;
  if (first >= 0xC2U && first < 0xE0U)
    length = 2, code = first & 0x1FU, least = 0x80U;
  else if (first >= 0xE0U && first < 0xF0U)
    length = 3, code = first & 0x0FU, least = 0x800U;
  else if (first >= 0xF0U && first < 0xF5U)
    length = 4, code = first & 0x07U, least = 0x10000U;
  if (length == 0 || at + length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(at + i) & 0xC0U) != 0x80U) return 0;
    code = code << 6U | (byte(at + i) & 0x3FU);
  }
  const bool surrogate = code >= 0xD800U && code < 0xE000U;
  return code < least || code > 0x10FFFFU || surrogate ? 0 : length;
}

}  // namespace

std::size_t first_not_text(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if (byte < 0x80U) {
      const bool control = (byte < 0x20U && byte != '\t' && byte != '\n' && byte != '\r') || byte == 0x7FU;
      if (control) return i;
      ++i;
    } else {
      const std::size_t length = sequence_length(text, i);
      if (length == 0) return i;
      i += length;
    }
  }
  return std::string_view::npos;
}

}  // namespace atrium
