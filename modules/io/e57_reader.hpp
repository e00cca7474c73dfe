#pragma once
#include "graph/api/context.hpp"
#include "graph/api/mapped_file.hpp"
#include "modules/io/raw_geometry.hpp"

namespace atrium::io {

/// Reads an E57 file (ASTM E2807): all of its scans, each in the place that its pose says, in metres. The points are a
/// source, read block by block. Checksums of all pages that are read are checked.
///
/// Cartesian or spherical coordinates of any number type. Records whose cartesianInvalidState or sphericalInvalidState
/// is not 0 are no points; nor are those at exactly (0, 0, 0) of a scan that is spherical, a grid (rowIndex,
/// columnIndex), that has a pose, or whose first block has several of them and no state: a ray that hit nothing.
/// Colours are scaled from colorLimits, else from the field's minimum and maximum, to 0 … 255; intensities likewise to
/// 0 … 1, or kept where there are no limits. Normals of the extension are turned with the pose; `classification`
/// becomes the label. A column is kept if all scans with points have it.
///
/// The scanners' places are the poses' translations. An all-zero pose may be one that nobody set: it counts if another
/// scan has a pose that is not, or if the scan is a grid or spherical. If the place of any scan is not known, none is
/// kept.
///
/// Throws Error (with the byte, or the scan) for what is damaged, for a file without scans or points, and for scans
/// that lie on top of each other in the file.
RawGeometry read_e57(const std::shared_ptr<const MappedFile>& file, const Context& context);

}  // namespace atrium::io
