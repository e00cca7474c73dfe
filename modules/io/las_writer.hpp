#pragma once
#include <string>

#include "graph/api/context.hpp"
#include "modules/io/cloud_stream.hpp"
#include "modules/types/cloud.hpp"

namespace atrium::io {

/// Writes a cloud as a LAS file, or LAZ if it is to be compressed: version 1.4 with a reference system that is
/// WKT, or with labels that need 8 bits, else 1.2. Coordinates in steps of 0.1 mm from the cloud's origin (of
/// more, where the cloud is more than 400 km wide), intensities in 16 bits (0 … 1 as 0 … 65535), colours in 16 bits
/// (times 257), labels as classification. Warns of what the format does not hold: normals, sensors, labels below 0 or
/// above 255 (31 in LAZ, whose records are of types 0 and 2).
void write_las(const Cloud& cloud, const std::string& crs, const std::string& path, bool compressed, AtomicFile& file,
               const Context& context);

/// LAS in pieces, without labels. Warns of what is not kept.
std::unique_ptr<CloudStream> las_stream(const StreamedCloud& cloud, AtomicFile& file, const Context& context);

}  // namespace atrium::io
