#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "modules/io/raw_geometry.hpp"

namespace atrium::io {

/// Stands where a strip of triangles ends; no index of a vertex.
inline constexpr std::uint32_t strip_end = 0xFFFFFFFF;

/// Collects the faces of a file, or of a piece of it, as triangles.
struct FaceList {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::array<std::vector<std::int32_t>, 3> attributes;  ///< class, storey, primitive: per triangle, or empty
  std::size_t skipped = 0;                              ///< faces of fewer than three corners
  std::vector<FaceFan> fans;                            ///< faces of more than three

  /// Adds a polygon as a fan of triangles. values: its attributes, where the file has them.
  void add(const std::vector<std::uint32_t>& corners, const std::array<bool, 3>& has,
           const std::array<std::int32_t, 3>& values);
  /// Adds strips of triangles, one after the other with `strip_end` between them: a corner makes a triangle with the
  /// two before it, every other one turned round. Triangles with a corner twice, which only lead on, are left out.
  void add_strips(const std::vector<std::uint32_t>& corners, const std::array<bool, 3>& has,
                  const std::array<std::int32_t, 3>& values);
  /// Puts the pieces, in order, into the geometry.
  static void join(std::vector<FaceList>& pieces, RawGeometry& geometry);
};

/// 0 class, 1 storey, 2 primitive; -1 for other names.
int face_attribute(std::string_view property);

/// A corner as a vertex index. Throws Error (`where`: file and line or byte) unless it is a whole number in 0 …
/// count-1. `first`: the number that the format gives the first vertex, for the message.
std::uint32_t vertex_index(double corner, std::size_t count, const std::string& where, int first = 0);
/// Whether the number, in place of a strip's corner, ends the strip: -1, or 2³² - 1 where numbers have no sign.
constexpr bool ends_strip(double corner) { return corner == -1 || corner == strip_end; }

}  // namespace atrium::io
