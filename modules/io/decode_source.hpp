#pragma once
#include "graph/api/context.hpp"
#include "modules/io/point_source.hpp"
#include "modules/types/cloud.hpp"

namespace atrium::io {

/// A block of points as a cloud has them: float32 from an origin, in metres, unit normals, colours as bytes.
struct LocalBlock {
  Cloud points;
  std::size_t not_finite = 0;   ///< left out
  std::size_t misses = 0;       ///< left out
  std::size_t bad_normals = 0;  ///< zero or not finite
};

/// Turns a block into a cloud's columns, those in `roles`; `to` is used again.
void localise(const PointBlock& block, const std::array<bool, role_count>& roles, double scale,
              const Eigen::Vector3d& origin, LocalBlock& to);

/// Calls work(block, points) for all blocks of the source, several side by side on the run's threads, with progress.
void for_blocks(const PointSource& source, double scale, const Eigen::Vector3d& origin, const Context& context,
                const std::function<void(std::size_t block, LocalBlock& points)>& work);

/// Some of the points, evenly over the blocks, for choose_origin: those that are good.
std::vector<Eigen::Vector3d> some_points(const PointSource& source, double scale);

/// What became of a file's records, and normals that are none.
struct RecordCounts {
  std::size_t points = 0, not_finite = 0, misses = 0, bad_normals = 0;
};
/// Warns of what was left out, drops what cannot be used, and gives the cloud its sensors. Throws Error if fewer than
/// three points are left.
void finish_blocks(const RawGeometry& geometry, const RecordCounts& counts, double scale, Cloud& cloud,
                   const Context& context);

/// decode_cloud for geometries whose points come from a source.
Cloud decode_blocks(const RawGeometry& geometry, double scale, const Context& context);

}  // namespace atrium::io
