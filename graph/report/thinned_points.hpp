#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace atrium::report {

/// A GLB file of points with fewer of them.
struct ThinnedPoints {
  std::string glb;
  std::size_t points = 0;  ///< that are left
  std::size_t of = 0;      ///< that there were
};

/// Leaves `share` (0 to 1) of each primitive's points, spread evenly over their order and at least one, with all their
/// attributes; the same file and share give the same bytes. The bounds that accessors state stay those of all points.
/// Nothing for a file that is no GLB 2, is cut short, or holds anything else than points without indices whose
/// attributes are not interleaved. Cost: linear.
std::optional<ThinnedPoints> thinned_points(std::string_view glb, double share);

}  // namespace atrium::report
