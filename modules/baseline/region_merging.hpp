#pragma once
#include <cstdint>
#include <vector>

#include "modules/baseline/area_moments.hpp"
#include "modules/baseline/planar_partition.hpp"

namespace atrium::baseline {

/// Joins neighbouring regions of which one plane serves both: each lies within half the distance limit of it (root mean
/// square), and their own normals are within the angle limit. The pair of least residual first. `region` is renumbered
/// from 0 without gaps, `moments` are those of what is left.
void merge_regions(const FaceNeighbours& neighbours, const PartitionLimits& limits, std::vector<std::int32_t>& region,
                   std::vector<AreaMoments>& moments);

}  // namespace atrium::baseline
