#include "modules/io/png_encoder.hpp"

#include <fmt/format.h>
#include <png.h>

#include "graph/api/error.hpp"

namespace atrium::io {

std::vector<std::uint8_t> encode_png(std::int32_t width, std::int32_t height, const std::vector<std::uint8_t>& pixels) {
  if (width < 1 || height < 1 ||
      pixels.size() != static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3)
    throw Error(
        fmt::format("an image of {} × {} pixels has {} bytes instead of 3 for each", width, height, pixels.size()));
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = PNG_FORMAT_RGB;
  image.flags = PNG_IMAGE_FLAG_FAST;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::vector<std::uint8_t> bytes(size);
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels.data(), 0, nullptr) == 0)
    throw Error(fmt::format("an image of {} × {} pixels cannot be written as PNG: {}", width, height, image.message));
  bytes.resize(size);
  return bytes;
}

}  // namespace atrium::io
