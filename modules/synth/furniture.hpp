#pragma once
#include "graph/api/random.hpp"
#include "modules/synth/building.hpp"

namespace atrium::synth {

enum class RoomUse { living, kitchen, bedroom, study, hall, office, meeting };

/// Puts furniture into a room: beds, tables with legs, chairs, shelves, wardrobes and so on, each where it fits (apart
/// from others, doors kept free, nothing tall before windows), large pieces first with their back to a wall. `density`
/// 1 is an ordinary home; 0 leaves the room empty; 2 tries to place every piece twice. `ceiling`: clear height, metres.
void furnish(Building& building, int room, RoomUse use, double density, double ceiling, Random& random);

/// A wardrobe, 0.6 m deep, with its back on a wall (a side of the outline) from its end nearest to `corner`. Errors: it
/// is longer than the wall, or stands in a door's way or before a window.
void add_wardrobe(Building& building, int room, int side, const Eigen::Vector2d& corner, double length, double height);

/// Shelves and cupboards side by side along the walls, wherever doors and windows leave room: on `share` of the places,
/// up to 5 to 40 cm below the ceiling.
void line_walls(Building& building, int room, double share, double ceiling, Random& random);

/// Two waving curtains before each window of the building so far, from above it down to 5 cm above the floor, each over
/// a third of the window and 20 cm of the wall.
void add_curtains(Building& building);

/// A leaf in each door between rooms, standing open by 70 to 88 degrees into the first room.
void add_door_leaves(Building& building, Random& random);

}  // namespace atrium::synth
