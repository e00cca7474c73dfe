#pragma once
#include <cstdint>
#include <vector>

#include "modules/types/cloud.hpp"
#include "modules/types/textures.hpp"

namespace atrium::scene {

/// How an image's plane is seen from a cloud's float coordinates.
struct TextureView {
  /// `shift` leads from the cloud's coordinates to those of the image: the difference of their origins.
  TextureView(const FaceTexture& image, const Eigen::Vector3d& shift, const Cloud& cloud, double distance);

  float height(const Eigen::Vector3f& p) const { return normal.dot(p) + offset; }  ///< in front of the plane, metres
  float column(const Eigen::Vector3f& p) const { return across.dot(p) + left; }    ///< pixels
  float row(const Eigen::Vector3f& p) const { return down.dot(p) + top; }

  Eigen::Vector3f normal, across, down;
  float offset = 0, left = 0, top = 0;
  float distance = 0;       ///< of points that give colours
  float reach = 0;          ///< how far in front points count as hiding the plane
  int width = 0, tall = 0;  ///< pixels
  std::vector<bool> seen;   ///< per sensor: whether it stands before the plane; empty: unknown
};

/// Whether the point lies over the image and is not known to be of the plane's other side.
bool is_over(const TextureView& view, const Cloud& cloud, std::size_t point);

/// Gives the image the colours of these points (all that lie over it, in ascending order). False, and no pixels, if
/// none of them gives a colour.
bool paint(const TextureView& view, const Cloud& cloud, const std::vector<std::uint32_t>& points, FaceTexture& image);

}  // namespace atrium::scene
