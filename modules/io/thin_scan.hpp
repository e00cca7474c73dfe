#pragma once
#include "graph/api/context.hpp"
#include "modules/io/raw_geometry.hpp"
#include "modules/types/cloud.hpp"

namespace atrium::io {

/// Reads a geometry's points and thins them as they come to one a voxel, as filter.voxel_grid does: the same centroids,
/// colours, normals, labels, intensities and sources in the same order, with the same bytes for any number of threads.
/// Memory grows with the voxels that hold points, not with the points: about 60 bytes a voxel, and 12 more
/// for colours and 40 for normals. Voxels lie within 2²⁰ sizes of the cloud's origin; points further away are kept as
/// they are, with a warning; throws Error if more than 100 and 0.1 % of them are such. With a `share` above 0 voxels
/// that hold noise are left out (noise_voxels); the log says how many.
Cloud thinned(const RawGeometry& geometry, double scale, double voxel, double share, const Context& context);

/// Some of the points, whole blocks evenly over the file, about 1 M at most: enough to guess the unit from.
Cloud sample_of(const RawGeometry& geometry, const Context& context);

}  // namespace atrium::io
