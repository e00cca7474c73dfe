#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "modules/types/floor_plan.hpp"

namespace atrium {

/// Cuts a polygon into triangles between its own corners only (outline, then the holes, ring by ring): n + 2h - 2 of
/// them, counter-clockwise, so that walls on its edges meet them edge to edge. Corners may stand on straight sides:
/// none of the triangles is flat. Holes are joined to the outline by the shortest bridges that meet nothing (Held
/// 2001); ears are cut by index. The rings must be simple, the outline counter-clockwise, holes clockwise; they may
/// touch in corners that both have: such a hole needs no bridge, which makes two triangles less. For other rings the
/// result is some triangles between those corners.
std::vector<std::array<std::uint32_t, 3>> clip_ears(const PlanPolygon& polygon);

}  // namespace atrium
