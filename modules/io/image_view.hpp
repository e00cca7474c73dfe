#pragma once
#include <Eigen/Core>

#include "modules/io/raw_geometry.hpp"

namespace atrium::io {

/// Whether the points, an image of rows (geometry.image_width), were taken from `eye` (in the file's units): seen from
/// there, neighbours in a row are all about the same angle apart, however far away they are, and the image is at least
/// 12 degrees wide. From other places these angles differ with distance and slant. True if there are too few points to
/// tell.
bool is_image_from(const RawGeometry& geometry, const Eigen::Vector3d& eye);

}  // namespace atrium::io
