#include "modules/baseline/face_neighbours.hpp"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <tuple>

namespace atrium::baseline {
namespace {

struct TriangleSide {
  std::uint32_t low, high, place;  // place: 3 · triangle + edge
  friend bool operator<(const TriangleSide& a, const TriangleSide& b) {
    return std::tie(a.low, a.high, a.place) < std::tie(b.low, b.high, b.place);
  }
};

}  // namespace

FaceNeighbours face_neighbours(const Mesh& mesh, const Context& context) {
  std::vector<TriangleSide> sides(3 * mesh.triangles.size());
  context.parallel_for(mesh.triangles.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]);
        sides[3 * t + k] = {low, high, static_cast<std::uint32_t>(3 * t + k)};
      }
  });
  tbb::parallel_sort(sides.begin(), sides.end());
  FaceNeighbours result;
  result.of.resize(mesh.triangles.size());
  for (std::size_t i = 0, j = 0; i < sides.size(); i = j) {
    for (j = i; j < sides.size() && sides[j].low == sides[i].low && sides[j].high == sides[i].high;) ++j;
    for (std::size_t k = i; k < j; ++k) {
      std::uint32_t other = FaceNeighbours::none;
      if (j - i == 2) other = sides[i + j - 1 - k].place / 3;
      if (j - i > 2) other = FaceNeighbours::several;
      result.of[sides[k].place / 3][sides[k].place % 3] = other;
    }
  }
  return result;
}

}  // namespace atrium::baseline
