#pragma once
#include <cstddef>
#include <string_view>

namespace atrium {

/// Characters (code points) of a UTF-8 text.
inline std::size_t count_characters(std::string_view text) {
  std::size_t count = 0;
  for (const char c : text)
    if ((static_cast<unsigned char>(c) & 0xC0U) != 0x80U) ++count;
  return count;
}

/// Place of the first byte that does not belong to a UTF-8 text (control characters but tab and carriage return,
/// overlong forms, surrogates, stray bytes), or npos.
std::size_t first_not_text(std::string_view text);

}  // namespace atrium
