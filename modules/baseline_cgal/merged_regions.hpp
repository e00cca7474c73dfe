#pragma once
#include <array>
#include <cstdint>
#include <vector>

namespace atrium::baseline {

/// Planar polygons that share edges, each of a region: the connected polygons of one plane.
struct PlanarPieces {
  std::vector<std::array<double, 3>> vertices;
  std::vector<std::vector<std::uint32_t>> polygons;  ///< in one direction within a region
  std::vector<std::int32_t> regions;                 ///< per polygon, 0, 1, …
};

struct MergedRegions {
  std::vector<std::array<double, 3>> vertices;  ///< those in use, in the order of the triangles
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::int32_t> regions;  ///< per triangle
};

/// Joins the pieces of each region to one polygon with holes, leaves out the corners at which only two regions meet
/// (they lie on the line of both planes), and cuts it into triangles by a constrained Delaunay triangulation. What was
/// edge to edge before is so afterwards: a closed surface stays closed.
MergedRegions merge_regions(const PlanarPieces& pieces);

}  // namespace atrium::baseline
