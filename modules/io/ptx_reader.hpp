#pragma once
#include "graph/api/context.hpp"
#include "graph/api/mapped_file.hpp"
#include "modules/io/raw_geometry.hpp"

namespace atrium::io {

/// Whether the text begins as a PTX file does: two whole numbers, the scanner's place and its three axes (three numbers
/// each), and a matrix of four lines of four.
bool is_ptx(std::string_view text);

/// Reads a PTX file: one or several grids of columns × rows points with intensity and perhaps colours, each with the
/// scanner's place, which is kept, and the 4 × 4 matrix that leads into the common frame (p' = p · M). (0, 0, 0) is a
/// ray that hit nothing. Metres. Throws Error with the line.
RawGeometry read_ptx(const std::shared_ptr<const MappedFile>& file, const Context& context);

}  // namespace atrium::io
