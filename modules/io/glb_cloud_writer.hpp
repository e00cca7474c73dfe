#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "graph/api/context.hpp"
#include "modules/types/cloud.hpp"

namespace atrium::io {

/// Writes points of a cloud as a GLB file, in tiles of 64 m: places in whole millimetres of the tile, as 16 bits a
/// coordinate (KHR_mesh_quantization), colours linear, as glTF has them. `up`: which direction of the cloud's frame is
/// glTF's +y. Without colours intensities are written as greys. Where wild points would make more than 512 tiles, these
/// are larger and coarser. Throws Error for coordinates that are not finite, and beyond 2 GiB.
void write_glb(const Cloud& cloud, const std::vector<std::uint32_t>& points, const Eigen::Vector3d& up,
               AtomicFile& file);

}  // namespace atrium::io
