#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "graph/api/mapped_file.hpp"
#include "modules/io/scalar.hpp"

namespace atrium::io {

struct PlyProperty {
  std::string name;  ///< in lower case, as the elements'
  Scalar type = Scalar::none;
  Scalar count_type = Scalar::none;  ///< none: one number; else a list, led by its length in this type
  bool is_list() const { return count_type != Scalar::none; }
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
  /// Bytes that a record has at least (lists empty): exactly these if it has no list.
  std::size_t record_size() const;
  bool has_lists() const;
};

struct PlyHeader {
  enum class Format : std::uint8_t { ascii, little_endian, big_endian };
  Format format = Format::ascii;
  std::vector<PlyElement> elements;
  std::size_t body = 0;   ///< byte where the data begin
  std::size_t lines = 0;  ///< of the header
};

/// Whether a file begins as PLY files do: with a line "ply".
bool begins_as_ply(std::string_view text);

/// Reads the header; its lines may end in LF, CR LF or CR, or some in one and some in another. Upper and lower case are
/// the same. Throws Error with the line's number.
PlyHeader read_ply_header(const MappedFile& file);

}  // namespace atrium::io
