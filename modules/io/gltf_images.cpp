#include "modules/io/gltf_images.hpp"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "modules/io/glb_groups.hpp"

namespace atrium::io {
namespace {

std::size_t big_endian(const std::byte* at, std::size_t bytes) {
  std::size_t value = 0;
  for (std::size_t i = 0; i < bytes; ++i) value = value << 8U | std::to_integer<std::size_t>(at[i]);
  return value;
}

/// The pixel that stands at a place along an axis.
std::size_t wrapped(double at, std::size_t size, GltfPicture::Wrap wrap) {
  const auto whole = static_cast<double>(size);
  if (wrap == GltfPicture::Wrap::repeat) at -= std::floor(at / whole) * whole;
  if (wrap == GltfPicture::Wrap::mirror) {
    at -= std::floor(at / (2 * whole)) * 2 * whole;
    if (at >= whole) at = 2 * whole - 1 - at;
  }
  return static_cast<std::size_t>(std::clamp(at, 0.0, whole - 1));
}

std::vector<std::uint8_t> rgb_of(const tinygltf::Image& image) {
  const std::size_t bytes = image.bits == 16 ? 2 : 1, parts = static_cast<std::size_t>(image.component);
  const std::size_t count = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  std::vector<std::uint8_t> pixels(3 * count);
  if (parts == 0 || image.image.size() < count * parts * bytes) return {};
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t c = 0; c < 3; ++c)  // of 16 bits, this machine's higher byte
      pixels[3 * i + c] = image.image[(i * parts + (parts < 3 ? 0 : c)) * bytes + bytes - 1];
  return pixels;
}

}  // namespace

std::array<std::size_t, 2> image_size(const std::byte* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (text.starts_with("\x89PNG\r\n\x1A\n") && size >= 24) return {big_endian(data + 16, 4), big_endian(data + 20, 4)};
  if (!text.starts_with("\xFF\xD8")) return {};
  for (std::size_t at = 2; at + 9 < size;) {  // segments: FF, kind, length, contents
    const auto kind = std::to_integer<unsigned>(data[at + 1]);
    if (std::to_integer<unsigned>(data[at]) != 0xFF) return {};
    if (kind == 0xFF) {
      ++at;
      continue;
    }
    const bool frame = kind >= 0xC0 && kind <= 0xCF && kind != 0xC4 && kind != 0xC8 && kind != 0xCC;
    if (frame) return {big_endian(data + at + 7, 2), big_endian(data + at + 5, 2)};
    at += 2 + big_endian(data + at + 2, 2);
  }
  return {};
}

Eigen::Array3d GltfPicture::light_at(double u, double v, const std::array<Wrap, 2>& wrap) const {
  static const auto light = [] {
    std::array<double, 256> levels{};
    for (std::size_t i = 0; i < levels.size(); ++i) levels[i] = linear({static_cast<std::uint8_t>(i), 0, 0})[0];
    return levels;
  }();
  if (!std::isfinite(u) || !std::isfinite(v)) return Eigen::Array3d::Ones();
  const double x = u * static_cast<double>(width) - 0.5, y = v * static_cast<double>(height) - 0.5;
  const double left = std::floor(x), top = std::floor(y);
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  for (int dy = 0; dy < 2; ++dy)
    for (int dx = 0; dx < 2; ++dx) {
      const double weight = (dx == 1 ? x - left : 1 - x + left) * (dy == 1 ? y - top : 1 - y + top);
      const std::size_t at = 3 * (wrapped(top + dy, height, wrap[1]) * width + wrapped(left + dx, width, wrap[0]));
      for (int c = 0; c < 3; ++c) sum[c] += weight * light[pixels[at + static_cast<std::size_t>(c)]];
    }
  return sum;
}

const GltfPicture* GltfImages::of(const JsonField& reference) {
  const JsonField texture = file_.entry("textures", reference, "index");
  if (!texture.has("source")) {
    if (pictures_.emplace(std::numeric_limits<std::uint64_t>::max(), nullptr).second)
      context_.warn(texture.where() + " has no PNG or JPEG image: its colours are not read");
    return nullptr;
  }
  const JsonField image = file_.entry("images", texture, "source");
  const std::uint64_t index = texture.natural("source");
  const auto known = pictures_.find(index);
  if (known != pictures_.end()) return known->second.get();
  auto& picture = pictures_[index];
  picture = decoded(image);
  return picture.get();
}

std::array<GltfPicture::Wrap, 2> GltfImages::wrap_of(const JsonField& reference) const {
  const JsonField texture = file_.entry("textures", reference, "index");
  if (!texture.has("sampler")) return {GltfPicture::Wrap::repeat, GltfPicture::Wrap::repeat};
  const JsonField sampler = file_.entry("samplers", texture, "sampler");
  const auto along = [&](const char* key) {
    constexpr std::uint64_t clamp = 33071, mirror = 33648, repeat = 10497;
    const std::uint64_t wrap = sampler.natural(key, repeat);
    if (wrap == clamp) return GltfPicture::Wrap::clamp;
    return wrap == mirror ? GltfPicture::Wrap::mirror : GltfPicture::Wrap::repeat;
  };
  return {along("wrapS"), along("wrapT")};
}

std::unique_ptr<const GltfPicture> GltfImages::decoded(const JsonField& image) {
  constexpr std::size_t of_byte = 1000, most = std::size_t{1} << 28U;  // pixels
  const GltfFile::Bytes bytes = image.has("uri") ? file_.resource(image["uri"]) : file_.view(image, "bufferView");
  const auto [width, height] = image_size(bytes.data, bytes.size);
  if (width == 0 || height == 0) {
    context_.warn(image.where() + " is neither PNG nor JPEG: its colours are not read");
    return nullptr;
  }
  if (width > 65536 || height > 65536 || width * height > most || width * height > of_byte * bytes.size + 1000000 ||
      bytes.size > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    context_.warn(fmt::format("{} is of {} × {} pixels, more than its {} bytes can hold: its colours are not read",
                              image.where(), width, height, bytes.size));
    return nullptr;
  }
  tinygltf::Image read;
  std::string error, warning;
  if (!tinygltf::LoadImageData(&read, 0, &error, &warning, 0, 0, reinterpret_cast<const unsigned char*>(bytes.data),
                               static_cast<int>(bytes.size), nullptr)) {
    context_.warn(image.where() + " cannot be decoded: its colours are not read");
    return nullptr;
  }
  GltfPicture picture{static_cast<std::size_t>(read.width), static_cast<std::size_t>(read.height), rgb_of(read)};
  if (picture.pixels.empty()) return nullptr;
  return std::make_unique<const GltfPicture>(std::move(picture));
}

}  // namespace atrium::io
