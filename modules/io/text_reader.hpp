#pragma once
#include "graph/api/context.hpp"
#include "graph/api/mapped_file.hpp"
#include "modules/io/raw_geometry.hpp"

namespace atrium::io {

/// Reads a text file of one point a line (XYZ, TXT, PTS, CSV, ASC). Values are separated by blanks, tabs, commas or
/// semicolons, with decimal points, or decimal commas where they cannot be anything else; lines that begin with # or //
/// are comments; what the columns are: text_layout. The rows of one scan are not parsed yet (RawGeometry::rows). Throws
/// Error with the line.
RawGeometry read_text(const std::shared_ptr<const MappedFile>& file, const Context& context);

}  // namespace atrium::io
