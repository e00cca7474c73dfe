#pragma once
#include <string>
#include <vector>

#include "modules/floorplan/plan_view.hpp"
#include "modules/floorplan/units.hpp"

namespace atrium::floorplan {

/// Text on the plan, read from its lower or right edge.
struct Label {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  bool upwards = false;  ///< runs along +y
  double height = 0;     ///< of its digits
  std::string text;
  double from = 0, to = 0;  ///< the stops that it stands between
  bool aside = false;       ///< not above the line, for want of room
  bool inferred = false;    ///< one of its stops is on inferred walls only: its text is in parentheses
};

enum class Side { bottom, left, top, right };

/// A chain of dimensions on a line parallel to an axis, outside of the building.
struct DimensionChain {
  Side side = Side::bottom;
  double line = 0;            ///< y of the line (bottom, top) or x (left, right)
  double from_building = 0;   ///< where the extension lines begin, in the same direction
  double depth = 0;           ///< how far outside of the line its texts reach, beyond the first row
  std::vector<double> stops;  ///< along the line, ascending, at least two
  std::vector<Label> labels;  ///< dimension_text(); one per interval, no two on top of each other

  bool upright() const { return side == Side::left || side == Side::right; }
  /// The point at `along` the line and `across` it.
  Eigen::Vector2d at(double along, double across) const {
    return upright() ? Eigen::Vector2d(across, along) : Eigen::Vector2d(along, across);
  }
  /// +1 where outwards from the building is upwards or to the right.
  double outwards() const { return side == Side::top || side == Side::right ? 1 : -1; }
};

/// The dimensions of a storey whose walls are parallel to the axes: on each side a chain of the doors and windows of
/// the facades that look there, one of the wall faces that can be seen from there (top and right only where they differ
/// from bottom and left), and outside of them the whole length. `mm` is how many metres of the plan are a millimetre of
/// paper; `plain` is as of dimension_text(). What ends at a wall that nobody has seen is in parentheses.
std::vector<DimensionChain> dimensions_of(const PlanStorey& storey, double mm, Units units = Units::metres,
                                          bool plain = false);

/// Width of a text of the given height, at most (wide sans-serif fonts).
double text_width(const std::string& text, double height);

}  // namespace atrium::floorplan
