#pragma once
#include <string>
#include <vector>

#include "graph/api/context.hpp"
#include "modules/io/raw_geometry.hpp"

namespace atrium::io {

/// Reads one file, or joins several: a folder stands for the scans in it, by name, without those in folders below.
/// What is no scan there is passed over, with a warning that names it; a scan that is damaged is an error there as
/// everywhere. Throws Error if nothing is left.
RawGeometry read_scan_files(const std::vector<std::string>& paths, const Context& context);

}  // namespace atrium::io
