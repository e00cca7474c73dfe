#pragma once
#include "modules/building/correction_draft.hpp"

/// What follows from a room's faces, and whether a corrected room is sound.
namespace atrium::building {

/// Outline and holes of the plan (all that faces looking upwards cover, at the height that the outline has), area,
/// volume and mean height. False if the plan is not one polygon.
bool measure_room(Building& building, std::int32_t room);

/// The area by which the plans of these rooms overlap those of rooms with which they share heights, and how many of
/// their faces cross or touch themselves (as where a room touches itself along an upright edge).
struct Overlap {
  double area = 0;
  std::int32_t room = -1, other = -1;  ///< the pair that shares most
  std::size_t crossing = 0;
};
Overlap overlap_of(const Building& building, const std::vector<std::int32_t>& rooms);

/// Measures corrected rooms, and throws the correction's Error where one is not closed, crosses itself or overlaps
/// others more than `before`, or has an opening that leaves its wall.
void settle_rooms(CorrectionDraft& draft, const Correction& correction, const std::vector<std::int32_t>& rooms,
                  const Overlap& before);

/// Walls, storeys' heights and, where floors were corrected, their elevations; thickness of openings' walls.
void settle_building(CorrectionDraft& draft, bool floors);

}  // namespace atrium::building
