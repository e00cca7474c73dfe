#pragma once
#include <cstdint>
#include <string>

#include "graph/api/context.hpp"
#include "modules/io/raw_geometry.hpp"

namespace atrium::io {

/// Whether rows of text are read into columns, or left to be parsed block by block (RawGeometry::rows).
enum class Rows : std::uint8_t { loaded, left };

/// Reads a file in the format that its beginning shows or that its extension names. Throws Error if that is none of
/// those that are known. Warns about what was skipped.
RawGeometry read_geometry(const std::string& path, const Context& context, Rows rows = Rows::loaded);

/// Why a regular file is none that read_geometry reads, by its beginning and its extension: "empty"; "" if it may be
/// one.
std::string why_no_scan(const std::string& path);

}  // namespace atrium::io
