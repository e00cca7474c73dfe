#include "graph/report/picture.hpp"

#include <png.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include "graph/api/context.hpp"
#include "graph/api/error.hpp"

namespace atrium::report {
namespace {

constexpr std::array<std::uint8_t, 3> vermilion{0xd5, 0x5e, 0x00};

int distance(const std::uint8_t* a, const std::uint8_t* b) {
  int largest = 0;
  for (int c = 0; c < 4; ++c) largest = std::max(largest, std::abs(int{a[c]} - int{b[c]}));
  return largest;
}

}  // namespace

Picture read_picture(const std::filesystem::path& file) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&image, file.c_str()) == 0)
    throw Error(file.string() + " cannot be read as a PNG file: " + image.message);
  image.format = PNG_FORMAT_RGBA;
  Picture picture{image.width, image.height, std::vector<std::uint8_t>(PNG_IMAGE_SIZE(image))};
  if (png_image_finish_read(&image, nullptr, picture.pixels.data(), 0, nullptr) == 0)
    throw Error(file.string() + " cannot be read as a PNG file: " + image.message);
  return picture;
}

void write_picture(const std::filesystem::path& file, const Picture& picture) {
  std::error_code ignored;
  std::filesystem::create_directories(file.parent_path(), ignored);
  AtomicFile target(file);
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = picture.width;
  image.height = picture.height;
  image.format = PNG_FORMAT_RGBA;
  png_alloc_size_t size = 0;
  if (png_image_write_to_memory(&image, nullptr, &size, 0, picture.pixels.data(), 0, nullptr) == 0)
    throw Error("cannot make a PNG file of " + file.string() + ": " + image.message);
  std::vector<std::uint8_t> bytes(size);
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.pixels.data(), 0, nullptr) == 0)
    throw Error("cannot make a PNG file of " + file.string() + ": " + image.message);
  target.write(bytes.data(), size);
  target.commit();
}

PixelDifference compare(const Picture& a, const Picture& b) {
  PixelDifference result;
  result.comparable = a.width == b.width && a.height == b.height;
  result.pixels = std::uint64_t{a.width} * a.height;
  if (!result.comparable) return result;
  for (std::size_t i = 0; i < a.pixels.size(); i += 4) {
    const int d = distance(&a.pixels[i], &b.pixels[i]);
    result.different += d > 0 ? 1 : 0;
    result.largest = std::max(result.largest, d);
  }
  return result;
}

Picture difference_picture(const Picture& a, const Picture& b) {
  Picture result = a;
  for (std::size_t i = 0; i < a.pixels.size(); i += 4) {
    std::uint8_t* const out = &result.pixels[i];
    out[3] = 255;
    if (distance(&a.pixels[i], &b.pixels[i]) > 0) {
      std::copy(vermilion.begin(), vermilion.end(), out);
      continue;
    }
    const int grey = (2 * a.pixels[i] + 5 * a.pixels[i + 1] + a.pixels[i + 2]) / 8;
    out[0] = out[1] = out[2] = static_cast<std::uint8_t>(170 + grey / 3);
  }
  return result;
}

}  // namespace atrium::report
