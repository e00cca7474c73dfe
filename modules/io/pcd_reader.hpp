#pragma once
#include "graph/api/context.hpp"
#include "graph/api/mapped_file.hpp"
#include "modules/io/raw_geometry.hpp"

namespace atrium::io {

/// Reads a PCD file (versions 0.5 to 0.7; ascii, binary, binary_compressed; fields of any type and count; colours
/// packed into one number of four bytes, written as a float or as a whole number; organised clouds; numbers broken into
/// lines in any way). Throws Error with line (ascii) or byte offset (binary).
RawGeometry read_pcd(const std::shared_ptr<const MappedFile>& file, const Context& context);

}  // namespace atrium::io
