#include "modules/io/gltf_colours.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace atrium::io {
namespace {

/// What a primitive's material says of its colour.
struct BaseColour {
  Eigen::Array3d factor = Eigen::Array3d::Ones();
  const GltfPicture* picture = nullptr;
  std::array<GltfPicture::Wrap, 2> wrap{};
  std::string places;                      ///< the attribute with the vertices' places in it
  Eigen::Matrix<double, 2, 3> to_picture;  ///< KHR_texture_transform
};

double number_or(const JsonField& field, const char* key, double otherwise) {
  return field.has(key) ? field[key].number() : otherwise;
}

Eigen::Vector2d pair_or(const JsonField& field, const char* key, double otherwise) {
  if (!field.has(key)) return {otherwise, otherwise};
  return {field[key].at(0).number(), field[key].at(1).number()};
}

void read_picture(const JsonField& reference, GltfImages& images, BaseColour& colour) {
  colour.picture = images.of(reference);
  colour.wrap = images.wrap_of(reference);
  std::uint64_t set = reference.natural("texCoord", 0);
  colour.to_picture << 1, 0, 0, 0, 1, 0;
  if (reference.has("extensions") && reference["extensions"].has("KHR_texture_transform")) {
    const JsonField moved = reference["extensions"]["KHR_texture_transform"];
    const Eigen::Vector2d shift = pair_or(moved, "offset", 0), scale = pair_or(moved, "scale", 1);
    const double turn = number_or(moved, "rotation", 0);
    set = moved.natural("texCoord", set);
    colour.to_picture << std::cos(turn) * scale.x(), std::sin(turn) * scale.y(), shift.x(), -std::sin(turn) * scale.x(),
        std::cos(turn) * scale.y(), shift.y();
  }
  colour.places = fmt::format("TEXCOORD_{}", set);
}

BaseColour base_colour(GltfFile& file, GltfImages& images, const JsonField& primitive) {
  BaseColour colour;
  if (!primitive.has("material")) return colour;
  const JsonField material = file.entry("materials", primitive, "material");
  if (!material.has("pbrMetallicRoughness")) return colour;
  const JsonField looks = material["pbrMetallicRoughness"];
  if (looks.has("baseColorFactor"))
    for (std::size_t a = 0; a < 3; ++a)
      colour.factor[static_cast<int>(a)] = std::clamp(looks["baseColorFactor"].at(a).number(), 0.0, 1.0);
  if (looks.has("baseColorTexture")) read_picture(looks["baseColorTexture"], images, colour);
  if (colour.picture != nullptr && !primitive["attributes"].has(colour.places.c_str())) colour.picture = nullptr;
  return colour;
}

/// Numbers of the vertices, as many as there are.
GltfNumbers of_vertices(GltfFile& file, const JsonField& attributes, const char* key, std::size_t least,
                        std::size_t vertices) {
  GltfNumbers numbers = gltf_numbers(file, attributes, key);
  if (numbers.width < least || numbers.count != vertices)
    attributes[key].fail(
        fmt::format("has {} entries of {} numbers, but there are {} vertices", numbers.count, numbers.width, vertices));
  return numbers;
}

}  // namespace

std::uint8_t srgb_byte(double linear) {
  if (!(linear > 0)) return 0;  // NaN too
  const double v = std::min(linear, 1.0);
  const double s = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255 * s));
}

std::vector<Colour> gltf_colours(GltfFile& file, GltfImages& images, const JsonField& primitive, std::size_t vertices,
                                 bool plain_material) {
  const JsonField attributes = primitive["attributes"];
  BaseColour base = base_colour(file, images, primitive);
  const bool own = attributes.has("COLOR_0");
  if (base.picture == nullptr && !own && !plain_material) return {};
  if (base.picture == nullptr && !own && (base.factor == 1).all()) return {};
  std::vector<Eigen::Array3d> light(vertices, base.factor);
  if (own) {
    const GltfNumbers numbers = of_vertices(file, attributes, "COLOR_0", 3, vertices);
    for (std::size_t i = 0; i < vertices; ++i)
      for (int a = 0; a < 3; ++a) light[i][a] *= static_cast<double>(numbers.row(i)[a]);
  }
  if (base.picture != nullptr) {
    const GltfNumbers numbers = of_vertices(file, attributes, base.places.c_str(), 2, vertices);
    for (std::size_t i = 0; i < vertices; ++i) {
      const float* uv = numbers.row(i);
      const Eigen::Vector2d at =
          base.to_picture * Eigen::Vector3d(static_cast<double>(uv[0]), static_cast<double>(uv[1]), 1);
      light[i] *= base.picture->light_at(at.x(), at.y(), base.wrap);
    }
  }
  std::vector<Colour> colours(vertices);
  for (std::size_t i = 0; i < vertices; ++i)
    for (std::size_t a = 0; a < 3; ++a) colours[i][a] = srgb_byte(light[i][static_cast<int>(a)]);
  return colours;
}

}  // namespace atrium::io
