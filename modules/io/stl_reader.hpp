#pragma once
#include "graph/api/context.hpp"
#include "graph/api/mapped_file.hpp"
#include "modules/io/raw_geometry.hpp"

namespace atrium::io {

/// Whether a file begins as a text STL does: with "solid", in any case, perhaps behind blanks, and no zero byte near.
bool begins_as_stl_text(std::string_view text);

/// Reads an STL file, binary or ascii (told apart by the size that the binary count gives, not by the word "solid" that
/// binary files may begin with too). Corners at exactly the same place become one vertex; the file's facet normals are
/// not used. A binary count of 0 before facets is passed over, with a warning. Throws Error with line (ascii) or byte
/// (binary).
RawGeometry read_stl(const std::shared_ptr<const MappedFile>& file, const Context& context);

}  // namespace atrium::io
