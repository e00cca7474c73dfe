#pragma once
#include <Eigen/Core>
#include <array>

namespace atrium::metric {

using Corners = std::array<Eigen::Vector3d, 3>;

/// How two triangles meet, decided without rounding error. Corners at exactly the same place are common, and a common
/// corner, or a whole common edge, is no meeting: that is how the faces of a surface hang together.
enum class Meeting {
  apart,     ///< in nothing but common corners or a common edge
  touching,  ///< at the border of one at least: a corner or an edge of one lies on the other, or edges cross
  crossing,  ///< their insides cross along a segment
  overlap    ///< they lie in one plane and their insides share area
};
/// Neither triangle may be without area. Coordinates as in geometry/exact_sign.hpp.
Meeting meeting(const Corners& a, const Corners& b);

/// Whether the edge from p to q, which lies in the triangle's plane, has a piece in its inside.
bool enters(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Corners& triangle);

/// Whether two edges lie on one line and share a piece of it, however short.
bool share_piece(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r,
                 const Eigen::Vector3d& s);

/// Whether two bent strips pass through each other along the line from p to q: each holds on to the line and has a half
/// on the side of either of its two points (none on the line); going round the line one meets their halves in turn.
bool strips_cross(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const std::array<Eigen::Vector3d, 2>& one,
                  const std::array<Eigen::Vector3d, 2>& other);

/// How far two crossing triangles reach through each other's plane: the least of the four reaches, to either side of
/// either plane.
double crossing_depth(const Corners& a, const Corners& b);

}  // namespace atrium::metric
