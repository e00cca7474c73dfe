#pragma once
#include <cstdint>
#include <vector>

#include "modules/io/gltf_file.hpp"
#include "modules/io/scalar.hpp"

namespace atrium::io {

/// Rows of numbers: what glTF calls an accessor, normalised where it says so (0 … 1, −1 … 1), with its sparse values in
/// place. All but 32-bit whole numbers are exact as float.
struct GltfNumbers {
  std::size_t count = 0, width = 0;
  Scalar type = Scalar::none;
  std::vector<float> values;  ///< count × width
  const float* row(std::size_t i) const { return values.data() + i * width; }
};

/// What an accessor says of itself, without its numbers.
struct GltfShape {
  std::size_t count = 0, width = 0;
  Scalar type = Scalar::none;
  bool normalised = false;
};

/// The shape of the accessor that the field `key` of `from` names. Throws Error if its type is none of glTF's, or if it
/// promises more rows than the file has bytes.
GltfShape gltf_shape(GltfFile& file, const JsonField& from, const char* key);
/// Its numbers. Throws Error where they are not all within the file.
GltfNumbers gltf_numbers(GltfFile& file, const JsonField& from, const char* key);
/// The numbers of an accessor of indices: one each, of 8, 16 or 32 bits without sign; each below `vertices`.
std::vector<std::uint32_t> gltf_indices(GltfFile& file, const JsonField& from, const char* key, std::size_t vertices);

}  // namespace atrium::io
