#include "modules/io/gltf_accessors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <limits>

namespace atrium::io {
namespace {

constexpr bool gltf_is_swapped = std::endian::native == std::endian::big;

Scalar component_of(const JsonField& field) {
  switch (field.natural("componentType")) {
    case 5120: return Scalar::i8;
    case 5121: return Scalar::u8;
    case 5122: return Scalar::i16;
    case 5123: return Scalar::u16;
    case 5125: return Scalar::u32;
    case 5126: return Scalar::f32;
    default: field["componentType"].fail("is none of glTF's: 5120 to 5123, 5125, 5126");
  }
}

std::size_t width_of_type(const JsonField& field) {
  const std::string type = field["type"].text();
  if (type == "SCALAR") return 1;
  if (type.size() == 4 && type.starts_with("VEC") && type[3] >= '2' && type[3] <= '4')
    return static_cast<std::size_t>(type[3] - '0');
  field["type"].fail("is '" + type + "', not SCALAR, VEC2, VEC3 or VEC4");
}

GltfShape shape_of(const JsonField& field, GltfFile& file) {
  if (field.has("bufferView")) file.view(field, "bufferView");  // so that its buffer's bytes count
  GltfShape shape;
  const std::uint64_t count = field.natural("count");
  // Each row has a byte at least; rows without bytes, all zero, may have as many.
  if (count > file.bytes() || count >= std::numeric_limits<std::uint32_t>::max())
    field["count"].fail(fmt::format("is {}, more than the file's {} bytes can hold", count, file.bytes()),
                        "the file is cut short or damaged: copy or export it again");
  shape.count = static_cast<std::size_t>(count);
  shape.width = width_of_type(field);
  shape.type = component_of(field);
  shape.normalised = field.has("normalized") && field["normalized"].is_true();
  return shape;
}

/// Elements at equal distances that are all within their view.
struct Elements {
  const std::byte* first = nullptr;
  std::size_t stride = 0;
};
Elements elements(GltfFile& file, const JsonField& field, std::size_t count, std::size_t size) {
  Elements found;
  const GltfFile::Bytes view = file.view(field, "bufferView", &found.stride);
  if (found.stride == 0) found.stride = size;
  const std::uint64_t offset = field.natural("byteOffset", 0);
  const std::uint64_t needed = count == 0 ? 0 : found.stride * (count - 1) + size;
  if (found.stride < size) field.fail(fmt::format("has elements of {} bytes at a distance of {}", size, found.stride));
  if (offset > view.size || needed > view.size - offset)
    field.fail(fmt::format("needs {} elements of {} bytes from byte {} of its buffer view on, which has {} bytes (from "
                           "{})",
                           count, size, offset, view.size, view.place),
               "the file is cut short or damaged: copy or export it again");
  found.first = view.data + offset;
  return found;
}

float normalised(Scalar type, float v) {
  switch (type) {
    case Scalar::i8: return std::max(v / 127.0F, -1.0F);
    case Scalar::u8: return v / 255.0F;
    case Scalar::i16: return std::max(v / 32767.0F, -1.0F);
    case Scalar::u16: return v / 65535.0F;
    default: return v;
  }
}

/// Copies `count` rows to where to(i) says.
template <class To>
void copy_rows(const Elements& from, const GltfShape& shape, std::size_t count, To&& to) {
  with_scalar(shape.type, [&](auto t) {
    using T = decltype(t);
    for (std::size_t i = 0; i < count; ++i) {
      float* row = to(i);
      for (std::size_t c = 0; c < shape.width; ++c) {
        const auto v = static_cast<float>(load<T>(from.first + i * from.stride + c * sizeof(T), gltf_is_swapped));
        row[c] = shape.normalised ? normalised(shape.type, v) : v;
      }
    }
  });
}

std::vector<std::uint32_t> read_indices(GltfFile& file, const JsonField& field, std::size_t count, Scalar type) {
  if (type != Scalar::u8 && type != Scalar::u16 && type != Scalar::u32)
    field["componentType"].fail("is no whole number without sign, as indices are");
  const Elements from = elements(file, field, count, size_of(type));
  std::vector<std::uint32_t> indices(count);
  const auto read = [&](auto t) {
    for (std::size_t i = 0; i < count; ++i)
      indices[i] = load<decltype(t)>(from.first + i * from.stride, gltf_is_swapped);
  };
  if (type == Scalar::u8)
    read(std::uint8_t{});
  else if (type == Scalar::u16)
    read(std::uint16_t{});
  else
    read(std::uint32_t{});
  return indices;
}

void check_below(const std::vector<std::uint32_t>& indices, std::size_t limit, const JsonField& field) {
  for (std::size_t i = 0; i < indices.size(); ++i)
    if (indices[i] >= limit)
      field.fail(fmt::format("has at place {} the index {}, but there are {} vertices", i, indices[i], limit));
}

void put_sparse(GltfFile& file, const JsonField& accessor, GltfNumbers& numbers, const GltfShape& shape) {
  const JsonField sparse = accessor["sparse"];
  const std::uint64_t count = sparse.natural("count");
  if (count > numbers.count) sparse["count"].fail("is more than that of the accessor");
  const auto some = static_cast<std::size_t>(count);
  const auto places = read_indices(file, sparse["indices"], some, component_of(sparse["indices"]));
  check_below(places, numbers.count, sparse["indices"]);
  const Elements from = elements(file, sparse["values"], some, size_of(shape.type) * shape.width);
  copy_rows(from, shape, some, [&](std::size_t i) { return numbers.values.data() + places[i] * numbers.width; });
}

}  // namespace

GltfShape gltf_shape(GltfFile& file, const JsonField& from, const char* key) {
  return shape_of(file.entry("accessors", from, key), file);
}

GltfNumbers gltf_numbers(GltfFile& file, const JsonField& from, const char* key) {
  const JsonField accessor = file.entry("accessors", from, key);
  const GltfShape shape = shape_of(accessor, file);
  GltfNumbers numbers{shape.count, shape.width, shape.type, {}};
  Elements base;
  if (accessor.has("bufferView"))
    base = elements(file, accessor, shape.count, size_of(shape.type) * shape.width);
  else if (!accessor.has("sparse"))
    accessor.fail("has neither a bufferView nor sparse values", "if the file is compressed, export it without");
  numbers.values.resize(shape.count * shape.width);
  if (base.first != nullptr)
    copy_rows(base, shape, shape.count, [&](std::size_t i) { return numbers.values.data() + i * shape.width; });
  if (accessor.has("sparse")) put_sparse(file, accessor, numbers, shape);
  return numbers;
}

std::vector<std::uint32_t> gltf_indices(GltfFile& file, const JsonField& from, const char* key, std::size_t vertices) {
  const JsonField accessor = file.entry("accessors", from, key);
  if (!accessor.has("bufferView")) accessor.fail("has no bufferView", "if the file is compressed, export it without");
  const GltfShape shape = shape_of(accessor, file);
  if (shape.width != 1) accessor["type"].fail("is not SCALAR, as indices are");
  if (accessor.has("sparse")) accessor["sparse"].fail("is not read for indices");
  auto indices = read_indices(file, accessor, shape.count, shape.type);
  check_below(indices, vertices, accessor);
  return indices;
}

}  // namespace atrium::io
