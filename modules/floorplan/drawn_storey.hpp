#pragma once
#include "modules/floorplan/sheet.hpp"
#include "modules/floorplan/svg_canvas.hpp"

namespace atrium::floorplan {

/// Whether something in it was corrected by hand.
bool has_corrections(const PlanStorey& storey);

constexpr double correction_mark_size = 1.1;  ///< of the mark, from its middle to its corners, millimetres of paper
/// Where an opening has its mark, in the plan.
Eigen::Vector2d mark_place(const PlanOpening& opening);

/// The mark of what was corrected by hand: a small diamond, its middle in millimetres on the sheet.
void draw_correction_mark(SvgCanvas& canvas, const Eigen::Vector2d& middle);

/// Draws storey number `index` of the sheet, whose walls are turned parallel to it: floors, walls, openings, labels of
/// the rooms, dimensions and the sheet's caption.
/// Returns whether some of the dimensions are inferred.
bool draw_storey(SvgCanvas& canvas, const Sheet& sheet, std::size_t index, const PlanStorey& storey, bool dimensions);

/// The frame and the strip at its foot: title, what is drawn, north arrow, scale.
struct TitleBlock {
  std::string title, note;
  std::size_t rooms = 0, storeys = 0;
  double area = 0;         ///< of all rooms, square metres
  bool corrected = false;  ///< something has the mark of a correction: the strip says what it means
  bool inferred = false;   ///< some dimensions are in parentheses: likewise
  std::string accuracy;    ///< how far the scan is from the model; empty: not known
  double north = 0;        ///< radians, counter-clockwise from the sheet's up to the input's +y
};
void draw_title(SvgCanvas& canvas, const Sheet& sheet, const TitleBlock& block);

}  // namespace atrium::floorplan
