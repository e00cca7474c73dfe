#pragma once
#include "graph/api/context.hpp"
#include "modules/io/cloud_stream.hpp"
#include "modules/types/cloud.hpp"

namespace atrium::io {

/// Writes a cloud as an E57 file (ASTM E2807, version 1.0): a scan for each sensor, with its place as the pose and the
/// points around it as float32; without sensors one scan without a pose, in float32 while the cloud's origin is 0, else
/// in double. Points keep their order within a scan. Colours are bytes, intensities float32, normals those of the
/// extension for surface normals, labels `las:classification`.
/// `crs`: what stands as coordinateMetadata; empty: none.
void write_e57(const Cloud& cloud, const std::string& crs, AtomicFile& file);

/// The same in pieces: a scan for each of `scans`, in the order of their points, without bounds.
std::unique_ptr<CloudStream> e57_stream(const StreamedCloud& cloud, AtomicFile& file);

}  // namespace atrium::io
