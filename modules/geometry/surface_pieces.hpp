#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "graph/api/context.hpp"

namespace atrium {

/// One square piece of a scanned surface: the smallest unit of evidence, so that dense and sparse parts count alike.
struct SurfacePiece {
  Eigen::Vector3f place;
  Eigen::Vector3f normal;  ///< unit length, its sign means nothing; zero where the surface is not plane
};

/// A scan as pieces of equal size.
struct SurfacePieces {
  std::vector<SurfacePiece> pieces;
  double size = 0;  ///< edge of a piece, in the unit of the places; its area is size²
};

/// Thins points with their normals to one piece per cube. The cubes have edges of `smallest`, doubled until the
/// surfaces are covered without gaps (halving the number of squares by four when their edge doubles shows that they
/// are) or there are few enough of them. Cost: O(n log n). The result does not depend on the number of threads.
SurfacePieces thin_to_pieces(const std::vector<SurfacePiece>& points, double smallest);

/// Pieces of a cloud whose planes are not known: normals from the 12 nearest among at most `most` points, which are
/// taken evenly from the file's order. Works in any unit. About 0.1 s for 40,000 points.
std::vector<SurfacePiece> pieces_with_normals(const std::vector<Eigen::Vector3f>& points, std::size_t most,
                                              const Context& context);

}  // namespace atrium
