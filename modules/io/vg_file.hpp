#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "modules/io/raw_geometry.hpp"
#include "modules/io/vg_stream.hpp"

namespace atrium::io {

/// A group as a vertex group file has it.
struct VgGroup {
  std::int64_t type = 0;                       ///< 0 plane, 1 cylinder, 2 sphere, 3 cone, 4 torus, 5 general
  std::optional<std::array<double, 4>> plane;  ///< a b c d of a x + b y + c z + d = 0, if there are four parameters
  std::vector<std::uint32_t> points;           ///< each below the number of points; may repeat
};

/// The contents of a .vg or .bvg file, both with the same order of values: points with colours and normals as columns,
/// and the groups, a group's children after it.
struct VgFile {
  RawGeometry geometry;
  std::vector<VgGroup> groups;
};

/// Throws Error with line or byte for whatever is not of the format.
VgFile read_vg_file(VgStream& stream, const std::string& path);

}  // namespace atrium::io
