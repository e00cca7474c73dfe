#pragma once
#include "modules/synth/scanner.hpp"
#include "modules/types/plane_primitives.hpp"

namespace atrium::synth {

/// Points that draw from one stream of random numbers: point i belongs to stream i / scan_chunk + 1.
inline constexpr std::size_t scan_chunk = 16384;

/// From the scene's frame to the cloud's: turned by `yaw` and `tilt`, shifted by `offset`. Throws Error unless that has
/// three numbers.
Transform pose_of(const Scan::Params& params);
/// A cloud of so many points, to be filled, with the columns that are asked for.
Cloud empty_scan(std::size_t points, const Scan::Params& params, const Transform& pose);
/// Scans points begin … end - 1 of `total`, all of one chunk, into the cloud from the place `at` on.
void scan_points(const Scanner& scanner, const Scan::Params& params, const Transform& pose, std::size_t begin,
                 std::size_t end, std::size_t total, Random random, Cloud& cloud, std::size_t at);

}  // namespace atrium::synth
