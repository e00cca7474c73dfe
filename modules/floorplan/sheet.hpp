#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "modules/floorplan/caption.hpp"
#include "modules/floorplan/dimensions.hpp"

namespace atrium::floorplan {

enum class Paper { automatic, a4, a3, a2, a1, a0 };
/// By its name, "A3"; empty for others.
std::optional<Paper> paper_named(std::string_view name);
/// The name of a sheet of no A format, "1250 × 900 mm", of its size in millimetres.
std::string custom_paper(const Eigen::Vector2d& size);

/// How the storeys lie on the paper. Millimetres.
struct Sheet {
  std::string paper;                    ///< "A3"; "1250 × 900 mm" where no A format has room
  Eigen::Vector2d size{297, 210};       ///< of the paper
  int scale = 100;                      ///< 1 : scale
  Units units = Units::metres;          ///< of its labels
  std::vector<Eigen::Vector2d> places;  ///< per storey: of the plan's origin on the paper, y down
  std::vector<Caption> captions;        ///< per storey

  double per_metre() const { return 1000.0 / scale; }
  Eigen::Vector2d on_paper(std::size_t storey, const Eigen::Vector2d& p) const {
    return places[storey] + per_metre() * Eigen::Vector2d(p.x(), -p.y());
  }
};

constexpr double frame_margin = 10;  ///< from the paper's edge to the frame
constexpr double title_height = 24;  ///< of the strip inside of the frame's lower edge

/// What a storey's drawing takes, dimensions included, without its caption: metres of the plan, `mm` of them to a
/// millimetre of paper.
Bounds2 drawing_bounds(const PlanStorey& storey, double mm, Units units = Units::metres);

/// The storeys in a row, a column or a grid, the lowest at the left and at the bottom, captions included: at the
/// greatest usual scale (1:50, 1:100, 1:200, …) at which they fit on A4 or A3, and on the smaller of the two. Where the
/// buildings would be smaller than 25 mm there: on the smallest of A2, A1 and A0 that has room for larger ones, else on
/// a sheet as large as it takes.
///
/// `scale` (0: any) and `paper` narrow the choice: a given scale may need any paper, and on a given paper a building
/// may be of any size. Elevations count from `origin_z`. Throws Error if the given paper is too small; its help says
/// which would do.
Sheet arranged(const std::vector<PlanStorey>& storeys, double origin_z, Paper paper, int scale,
               Units units = Units::metres);

}  // namespace atrium::floorplan
