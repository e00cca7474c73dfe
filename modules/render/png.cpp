#include "modules/render/png.hpp"

#include <png.h>

#include <array>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "graph/api/context.hpp"
#include "graph/api/error.hpp"

namespace atrium::render {
namespace {

/// libpng's own record of one picture that is read or written; freed with it.
struct Image {
  png_image png{};
  Image() { png.version = PNG_IMAGE_VERSION; }
  ~Image() { png_image_free(&png); }
  Image(const Image&) = delete;
  Image& operator=(const Image&) = delete;
  std::string message() const { return png.message; }
};

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (!in.is_open() || in.bad()) throw Error("cannot read " + path.string());
  return bytes;
}

}  // namespace

void require_png_name(const std::filesystem::path& path) {
  if (path.extension() != ".png")
    throw Error("a picture's file must end in .png: " + path.string(), "pictures are written as PNG only");
}

void write_png(const Picture& picture, const std::filesystem::path& path) {
  Image image;
  image.png.width = static_cast<png_uint_32>(picture.width);
  image.png.height = static_cast<png_uint_32>(picture.height);
  image.png.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image.png);
  std::vector<char> bytes(size);
  if (png_image_write_to_memory(&image.png, bytes.data(), &size, 0, picture.pixels.data(), 0, nullptr) == 0)
    throw Error("cannot encode the picture " + path.string() + ": " + image.message());
  AtomicFile file(path);
  file.write(bytes.data(), size);
  file.commit();
}

Picture read_png(const std::filesystem::path& path) {
  const std::string bytes = bytes_of(path);
  if (png_sig_cmp(reinterpret_cast<png_const_bytep>(bytes.data()), 0, std::min<std::size_t>(bytes.size(), 8)) != 0 ||
      bytes.size() < 8)
    throw Error("not a PNG file: " + path.string());
  const auto damaged = [&](const std::string& reason) {
    return Error(path.string() + " is damaged or not whole: " + reason, "copy or make the picture again");
  };
  Image image;
  if (png_image_begin_read_from_memory(&image.png, bytes.data(), bytes.size()) == 0) throw damaged(image.message());
  if (std::uint64_t{image.png.width} * image.png.height > most_pixels)
    throw Error(path.string() + " is too large: " + std::to_string(image.png.width) + " x " +
                    std::to_string(image.png.height) + " pixels",
                "at most " + std::to_string(most_pixels / 1000000) + " million pixels can be read");
  image.png.format = PNG_FORMAT_RGB;
  image.png.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;  // unless the file says otherwise
  Picture picture;
  picture.width = static_cast<std::int32_t>(image.png.width);
  picture.height = static_cast<std::int32_t>(image.png.height);
  picture.pixels.resize(PNG_IMAGE_SIZE(image.png));
  constexpr png_color white{255, 255, 255};
  if (png_image_finish_read(&image.png, &white, picture.pixels.data(), 0, nullptr) == 0) throw damaged(image.message());
  return picture;
}

}  // namespace atrium::render
