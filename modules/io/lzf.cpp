#include "modules/io/lzf.hpp"

#include <cstring>

namespace atrium::io {

bool expand_lzf(const std::byte* data, std::size_t data_size, std::vector<std::byte>& to, std::size_t size) {
  // One byte of input gives at most 88 of output (three bytes give 264): no more memory than the input can fill.
  if (size / 88 > data_size) return false;
  to.resize(size);
  std::size_t in = 0;
  std::size_t out = 0;
  while (in < data_size) {
    const auto control = std::to_integer<std::size_t>(data[in++]);
    if (control < 32) {  // a run of literal bytes
      const std::size_t length = control + 1;
      if (length > data_size - in || length > size - out) return false;
      std::memcpy(to.data() + out, data + in, length);
      in += length;
      out += length;
      continue;
    }
    // A copy of earlier output, which may overlap what it makes.
    std::size_t length = control >> 5U;
    if (length == 7) {
      if (in == data_size) return false;
      length += std::to_integer<std::size_t>(data[in++]);
    }
    length += 2;
    if (in == data_size) return false;
    const std::size_t distance = ((control & 31U) << 8U) + std::to_integer<std::size_t>(data[in++]) + 1;
    if (distance > out || length > size - out) return false;
    for (std::size_t k = 0; k < length; ++k, ++out) to[out] = to[out - distance];
  }
  return out == size;
}

}  // namespace atrium::io
