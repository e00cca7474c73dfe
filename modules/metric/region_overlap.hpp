#pragma once
#include <cstdint>
#include <vector>

namespace atrium::metric {

/// How many points a true and a found region share.
struct Overlap {
  std::uint32_t expected, found;
  std::size_t points;
};
struct Regions {
  std::vector<std::size_t> expected, found;  ///< number of points of each; 0: the region does not count
  std::vector<Overlap> overlaps;             ///< by expected, then found; none empty
};

/// Counts and pairs of Hoover et al. 1996 at one threshold (metric.primitives tells the definitions).
struct Segmentation {
  std::vector<Overlap> correct;
  std::size_t oversegmented = 0, undersegmented = 0, missed = 0, noise = 0;
};
Segmentation compare_regions(const Regions& regions, double threshold);

}  // namespace atrium::metric
