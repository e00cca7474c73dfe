#pragma once
#include <memory>
#include <vector>

#include "graph/api/context.hpp"
#include "modules/io/point_source.hpp"

namespace atrium::io {

/// Several scans as one, in their order and in the file's coordinates, which are double: the points of each are read
/// when they are asked for. Columns that only some have are left out, with a warning. Scanners' places are kept if they
/// are known of every scan. Throws Error where the scans cannot be in one frame: reference systems or units that
/// differ, and where one has faces, which have to be sampled first.
RawGeometry joined(std::vector<RawGeometry> parts, const Context& context);

}  // namespace atrium::io
