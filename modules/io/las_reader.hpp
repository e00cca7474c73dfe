#pragma once
#include "graph/api/context.hpp"
#include "graph/api/mapped_file.hpp"
#include "modules/io/raw_geometry.hpp"

namespace atrium::io {

/// Reads a LAS file (1.0 to 1.4, records of types 0 to 10) or a LAZ file (types 0 to 3 and 6 to 8). The points are a
/// source, read block by block, chunks of LAZ side by side.
///
/// Coordinates are scaled and offset in double. Colours have 16 bits, or 8 if none in the file is above 255. Intensity
/// and classification (the label) are kept; bytes behind those of the record's type are passed over; points that are
/// withheld are left out. The coordinate reference system is that of the WKT or the GeoTIFF keys, with its unit; a
/// warning if it is one of degrees.
///
/// Throws Error (with the byte) for what is damaged or does not fit into the file.
RawGeometry read_las(const std::shared_ptr<const MappedFile>& file, const Context& context);

}  // namespace atrium::io
