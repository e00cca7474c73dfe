#include "modules/building/shell_welding.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

namespace atrium::building {
namespace {

constexpr double one_place = 0.0005;  // metres
constexpr double least_piece = 1e-6;  // square metres

}  // namespace

using layout::Ring;

ShellWelding::ShellWelding(const std::vector<ShellPiece>& source) {
  for (const auto& piece : source) {
    WeldedPiece welded{&piece, {ring_of(piece.outline)}, 0};
    for (const auto& hole : piece.holes) welded.rings.push_back(ring_of(hole));
    pieces.push_back(std::move(welded));
  }
  for (auto& piece : pieces) {
    for (auto& ring : piece.rings) ring = without_spikes(with_places_between(ring));
    for (const auto& ring : piece.rings)
      piece.area += layout::signed_area(ring, vertices, piece.piece->face.plane.normal);
  }
  std::erase_if(pieces, [](const WeldedPiece& piece) { return piece.area < least_piece; });
  for (auto& piece : pieces) std::erase_if(piece.rings, [](const Ring& ring) { return ring.size() < 3; });
}

std::uint32_t ShellWelding::vertex(const Eigen::Vector3d& place) {
  for (std::size_t i = 0; i < vertices.size(); ++i)
    if ((vertices[i] - place).squaredNorm() < one_place * one_place) return static_cast<std::uint32_t>(i);
  vertices.push_back(place);
  return static_cast<std::uint32_t>(vertices.size()) - 1;
}
Ring ShellWelding::ring_of(const std::vector<Eigen::Vector3d>& places) {
  Ring ring;
  for (const auto& p : places) ring.push_back(vertex(p));
  return ring;
}
Ring ShellWelding::with_places_between(const Ring& ring) const {
  Ring result;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const std::uint32_t a = ring[i], b = ring[(i + 1) % ring.size()];
    if (a == b) continue;
    result.push_back(a);
    const Eigen::Vector3d side = vertices[b] - vertices[a];
    std::vector<std::pair<double, std::uint32_t>> between;
    for (std::uint32_t v = 0; v < vertices.size(); ++v) {
      if (v == a || v == b) continue;
      const double t = side.dot(vertices[v] - vertices[a]) / side.squaredNorm();
      if (t > 0 && t < 1 && (vertices[a] + t * side - vertices[v]).norm() < one_place) between.emplace_back(t, v);
    }
    std::sort(between.begin(), between.end());
    for (const auto& [t, v] : between) result.push_back(v);
  }
  return result;
}
/// Without ways there and back.
Ring ShellWelding::without_spikes(Ring ring) {
  for (std::size_t i = 0; ring.size() > 2 && i < ring.size();) {
    const std::size_t next = (i + 1) % ring.size(), after = (i + 2) % ring.size();
    if (ring[i] == ring[next] || ring[i] == ring[after]) {
      ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(next));
      i = i > 0 ? i - 1 : 0;
    } else {
      ++i;
    }
  }
  return ring;
}

}  // namespace atrium::building
