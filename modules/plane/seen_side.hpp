#pragma once
#include <memory>

#include "graph/api/context.hpp"
#include "modules/types/plane_primitives.hpp"

namespace atrium::plane {

/// How the sides of planes were told, for the log.
struct SeenSides {
  std::size_t by_positions = 0, by_free_space = 0, by_normals = 0;
  std::size_t turned_against_normals = 0;  ///< the cloud's normals look the other way
};

/// Turns each plane to the side from which its surface was seen. Asked in this order:
///
/// 1. The scanner's positions, where the cloud has them. A position that saw all points (no `source`) counts for those
///    points only to which the way is free: it stood in one room, the other rooms' walls say nothing by it.
/// 2. Free space over the whole scene: rays leave places of the surface to both sides (straight, at 45° and at 70°)
///    until they meet points off the plane. A ray's length counts, at most 3 m; one that leaves the scene counts 0,
///    since the outside of a building is not seen. So a room is before a wall even where it is wide, and the 12 cm to
///    its other face are not. And the surface's rim: where its points end, rays along it at 20 cm meet a floor, a
///    ceiling, another wall or furniture on the side of the room, and nothing in a cavity between two rooms. The shares
///    of both are added. But a surface that has another one 12 to 65 cm before most of its places, straight on, and
///    nothing on its other side is the outer face of a wall, a roof or a slab, as models and scans from outside have
///    them: it looks outwards, unless the cloud's normals say otherwise. (Closets that deep at the outside of a
///    building look the same.)
/// 3. The cloud's normals (their axes never, only their signs), where these say nothing.
///
/// Cost: at most 127 places × 65 rays of 20 m for each plane; a grid over the points. Deterministic. The planes' sizes,
/// inliers and order do not change.
SeenSides turn_to_seen_sides(PlanePrimitives& planes, const Context& context);

}  // namespace atrium::plane
