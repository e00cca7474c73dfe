#include "modules/io/faces.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "graph/api/error.hpp"

namespace atrium::io {

void FaceList::add(const std::vector<std::uint32_t>& corners, const std::array<bool, 3>& has,
                   const std::array<std::int32_t, 3>& values) {
  if (corners.size() < 3) {
    ++skipped;
    return;
  }
  if (corners.size() > 3) fans.push_back({triangles.size(), corners.size()});
  for (std::size_t k = 2; k < corners.size(); ++k) {
    triangles.push_back({corners[0], corners[k - 1], corners[k]});
    for (std::size_t a = 0; a < 3; ++a)
      if (has[a]) attributes[a].push_back(values[a]);
  }
}

void FaceList::add_strips(const std::vector<std::uint32_t>& corners, const std::array<bool, 3>& has,
                          const std::array<std::int32_t, 3>& values) {
  std::size_t length = 0;  // corners of this strip so far
  for (std::size_t k = 0; k < corners.size(); ++k) {
    length = corners[k] == strip_end ? 0 : length + 1;
    if (length < 3) continue;
    std::uint32_t a = corners[k - 2], b = corners[k - 1];
    const std::uint32_t c = corners[k];
    if (a == b || b == c || a == c) continue;
    if (length % 2 == 0) std::swap(a, b);
    triangles.push_back({a, b, c});
    for (std::size_t v = 0; v < 3; ++v)
      if (has[v]) attributes[v].push_back(values[v]);
  }
}

void FaceList::join(std::vector<FaceList>& pieces, RawGeometry& geometry) {
  const std::array<std::vector<std::int32_t>*, 3> to = {&geometry.classes, &geometry.storeys, &geometry.primitives};
  std::size_t total = 0;
  for (const auto& piece : pieces) total += piece.triangles.size();
  geometry.triangles.reserve(total);
  for (auto& piece : pieces) {
    for (const FaceFan& fan : piece.fans) geometry.fans.push_back({geometry.triangles.size() + fan.first, fan.corners});
    geometry.triangles.insert(geometry.triangles.end(), piece.triangles.begin(), piece.triangles.end());
    for (std::size_t a = 0; a < 3; ++a)
      to[a]->insert(to[a]->end(), piece.attributes[a].begin(), piece.attributes[a].end());
    geometry.skipped_faces += piece.skipped;
    piece = {};
  }
}

int face_attribute(std::string_view property) {
  if (property == "class") return 0;
  if (property == "storey") return 1;
  return property == "primitive" ? 2 : -1;
}

std::uint32_t vertex_index(double corner, std::size_t count, const std::string& where, int first) {
  if (!(corner >= 0 && corner < static_cast<double>(count)) || corner != std::floor(corner))
    throw Error(fmt::format("{}: a face's corner is vertex {}, but there are {} vertices ({} to {})", where,
                            corner + first, count, first,
                            (count == 0 ? 0 : count - 1) + static_cast<std::size_t>(first)));
  return static_cast<std::uint32_t>(corner);
}

}  // namespace atrium::io
