#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "modules/layout/arrangement.hpp"
#include "modules/layout/raster.hpp"
#include "modules/types/cell_complex.hpp"

namespace atrium::layout {

/// A line in plan and the walls on it.
struct WallLine {
  Arrangement::Line line;
  double begin = 0, end = 0;  ///< where its evidence lies, along line.along()
  double low = 0, high = 0;   ///< heights between which its walls were seen, metres
  double area = 0;            ///< of the walls' squares, square metres
  std::vector<std::int32_t> primitives;
};

/// The primitives of a surface: its own, if it was seen, and those that joined it.
std::vector<std::int32_t> primitives_of(const CellSurface& surface);

/// A wall as a line, as far as it lies between two heights; none if less than 0.3 m of its height does. `low` and
/// `high` of the result are its lowest and highest rows that are about as full as others.
std::optional<WallLine> wall_line(const PlanePrimitives& planes, std::size_t primitive, const Footprint& footprint,
                                  double bottom, double top);

/// Walls that run within min_gap of a larger one's line are on that line. `apart(a, b)`: pairs that are left as they
/// are. The result is sorted by falling area.
void join_lines(std::vector<WallLine>& lines, double min_gap,
                const std::function<bool(const WallLine&, const WallLine&)>& apart);

/// Surfaces that nowhere differ from a larger one by more than the gap are that one; by falling area.
void join_surfaces(std::vector<CellSurface>& surfaces, const std::vector<Footprint>& footprints, double min_gap);

/// The lines over which two surfaces, of which one is slanted, have the same height, as far as both were seen near it.
/// `some` and `others` may be the same.
std::vector<WallLine> meeting_lines(const std::vector<CellSurface>& some, const std::vector<CellSurface>& others,
                                    const std::vector<Footprint>& footprints);

}  // namespace atrium::layout
