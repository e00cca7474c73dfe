#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include "graph/api/context.hpp"
#include "modules/types/cloud.hpp"
#include "modules/types/mesh.hpp"

namespace atrium::building {

/// What the points near one face are like.
struct FaceDistances {
  double area = 0;  ///< of its triangles
  Eigen::Vector3d origin = Eigen::Vector3d::Zero(), across = Eigen::Vector3d::UnitX(), up = Eigen::Vector3d::UnitY();
  Eigen::Vector2d low = Eigen::Vector2d::Zero(), high = Eigen::Vector2d::Zero();  ///< its extent across and up
  std::vector<float> signed_distances;                                            ///< in the order of the points
  struct Square {
    std::int32_t x = 0, y = 0;  ///< place across and up, in squares from `low`
    double mean = 0;
  };
  std::vector<Square> squares;  ///< those with points, by y, then x
};

/// Gives each `step`-th point to the nearest face (by the triangles' `primitives`, below `faces`) at most `reach` away.
std::vector<FaceDistances> face_distances(const Mesh& mesh, const Cloud& cloud, std::size_t step, std::size_t faces,
                                          double reach, double cell, const Context& context);

}  // namespace atrium::building
