#pragma once
#include "modules/floorplan/sheet.hpp"
#include "modules/floorplan/svg_canvas.hpp"

namespace atrium::floorplan {

/// Whether something in it was corrected by hand.
bool has_corrections(const PlanStorey& storey);

/// The mark of what was corrected by hand: a small diamond, its middle in millimetres on the sheet.
void draw_correction_mark(SvgCanvas& canvas, const Eigen::Vector2d& middle);

/// Draws storey number `index` of the sheet, whose walls are turned parallel to it: floors, walls, openings, labels of
/// the rooms, dimensions and the sheet's caption.
void draw_storey(SvgCanvas& canvas, const Sheet& sheet, std::size_t index, const PlanStorey& storey, bool dimensions);

/// The frame and the strip at its foot: title, what is drawn, north arrow, scale.
struct TitleBlock {
  std::string title, note;
  std::size_t rooms = 0, storeys = 0;
  double area = 0;         ///< of all rooms, square metres
  bool corrected = false;  ///< something has the mark of a correction: the strip says what it means
  double north = 0;        ///< radians, counter-clockwise from the sheet's up to the input's +y
};
void draw_title(SvgCanvas& canvas, const Sheet& sheet, const TitleBlock& block);

}  // namespace atrium::floorplan
