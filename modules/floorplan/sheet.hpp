#pragma once
#include <string>
#include <vector>

#include "modules/floorplan/dimensions.hpp"

namespace atrium::floorplan {

enum class Paper { automatic, a4, a3, a2, a1, a0 };

/// How the storeys lie on the paper. Millimetres.
struct Sheet {
  std::string paper;                    ///< "A3"
  Eigen::Vector2d size{297, 210};       ///< of the paper
  int scale = 100;                      ///< 1 : scale
  std::vector<Eigen::Vector2d> places;  ///< per storey: of the plan's origin on the paper, y down

  double per_metre() const { return 1000.0 / scale; }
  Eigen::Vector2d on_paper(std::size_t storey, const Eigen::Vector2d& p) const {
    return places[storey] + per_metre() * Eigen::Vector2d(p.x(), -p.y());
  }
};

constexpr double frame_margin = 10;   ///< from the paper's edge to the frame
constexpr double title_height = 24;   ///< of the strip inside of the frame's lower edge
constexpr double caption_height = 9;  ///< above each storey

/// What a storey's drawing takes, dimensions included, without its caption: metres of the plan, `mm` of them to a
/// millimetre of paper.
Bounds2 drawing_bounds(const PlanStorey& storey, double mm);

/// The greatest usual scale (1:50, 1:100, 1:200, …) at which all storeys, side by side or above each other, fit on A4
/// or A3, and the smaller of the two. `scale` (0: any) and `paper` narrow the choice; a given scale may need up to A0.
/// Throws Error if they do not fit.
Sheet arranged(const std::vector<PlanStorey>& storeys, Paper paper, int scale);

}  // namespace atrium::floorplan
