#pragma once
#include "modules/floorplan/sheet.hpp"
#include "modules/floorplan/svg_canvas.hpp"

namespace atrium::floorplan {

/// Draws places of one storey's plan on the sheet.
class Pen {
 public:
  Pen(SvgCanvas& canvas, const Sheet& sheet, std::size_t index) : canvas_(canvas), sheet_(sheet), index_(index) {}
  Eigen::Vector2d at(const Eigen::Vector2d& p) const { return sheet_.on_paper(index_, p); }
  void polygon(const PlanPolygon& polygon, std::string_view attributes = {}) const {
    std::vector<PlanRing> rings{ring(polygon.outline)};
    for (const auto& hole : polygon.holes) rings.push_back(ring(hole));
    canvas_.polygon(rings, attributes);
  }
  void line(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const { canvas_.line(at(a), at(b)); }
  void arc(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double radius, bool left) const {
    canvas_.arc(at(a), at(b), radius * sheet_.per_metre(), !left);
  }
  double mm() const { return 1 / sheet_.per_metre(); }  // metres of the plan
  Units units() const { return sheet_.units; }

 private:
  PlanRing ring(const PlanRing& corners) const {
    PlanRing result;
    for (const auto& p : corners) result.push_back(at(p));
    return result;
  }
  SvgCanvas& canvas_;
  const Sheet& sheet_;
  std::size_t index_;
};

/// Millimetres of paper behind a face whose other side is not known.
constexpr double hatch_width = 2.2;

}  // namespace atrium::floorplan
