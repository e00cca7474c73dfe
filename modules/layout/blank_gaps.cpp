#include "modules/layout/blank_gaps.hpp"

#include <algorithm>
#include <cmath>

#include "modules/layout/wall_pairs.hpp"

namespace atrium::layout {
namespace {

constexpr double widest_gap = 3;           // metres
constexpr double least_gap_side = 0.8;     // of a side of the rim
constexpr double before_gap = 0.6;         // metres before the wall: what stands there hides it
constexpr std::size_t few_before_gap = 6;  // points: fewer hide nothing

constexpr double least_clean_side = 0.9;  // of each side of the rim of a window that shows nothing
constexpr double least_in_sight = 0.7;    // of its squares
constexpr double least_pane = 0.3;        // m²

struct Gap {
  BlankGap gap;
  std::size_t in_front = 0;
};

/// The share of a band's squares that are solid.
double solid_share(const FaceMask& mask, const Eigen::AlignedBox2d& band) {
  std::size_t all = 0, solid = 0;
  const Eigen::AlignedBox2i squares = mask.squares_in(band);
  for (int y = squares.min().y(); y <= squares.max().y(); ++y)
    for (int x = squares.min().x(); x <= squares.max().x(); ++x) {
      if (!band.contains(mask.centre(x, y))) continue;
      ++all;
      solid += mask.at(x, y) == Square::solid ? 1 : 0;
    }
  return all > 0 ? static_cast<double>(solid) / static_cast<double>(all) : 0;
}

/// The least share of a side of the rim that was seen.
double least_side(const FaceMask& mask, double spacing, const Eigen::AlignedBox2d& box) {
  double least = 1;
  const double near = mask.pixel() + 0.5 * spacing, far = near + std::max(0.15, spacing);
  for (int side = 0; side < 4; ++side) {
    const int axis = side / 2;
    Eigen::AlignedBox2d band = box;
    if (side % 2 == 0) {
      band.min()[axis] = box.min()[axis] - far;
      band.max()[axis] = box.min()[axis] - near;
    } else {
      band.min()[axis] = box.max()[axis] + near;
      band.max()[axis] = box.max()[axis] + far;
    }
    least = std::min(least, solid_share(mask, band));
  }
  return least;
}

/// Every square without points counts.
FaceMask all_empty(FaceMask mask) {
  for (int y = 0; y < mask.height(); ++y)
    for (int x = 0; x < mask.width(); ++x)
      if (mask.at(x, y) == Square::hidden) mask.at(x, y) = Square::hole;
  return mask;
}

void find_gaps(std::size_t face, const FaceMask& mask, const FaceEvidence& evidence, const std::vector<FaceHole>& found,
               const Openings::Params& params, std::vector<Gap>& gaps) {
  FaceMask left = all_empty(mask);
  const double pixel = mask.pixel();
  const double least = 0.5 * std::max(params.min_width / pixel, 1.0) * std::max(params.min_height / pixel, 1.0);
  for (const auto& part : left.parts())
    while (const auto squares = left.best_rectangle(part, least)) {
      const double all = (squares->sizes().x() + 1.0) * (squares->sizes().y() + 1.0);
      const bool filled = static_cast<double>(left.count(*squares, Square::hole)) >= params.min_fill * all;
      left.fill(*squares, Square::solid);
      const Eigen::Vector2d half = Eigen::Vector2d::Constant(pixel / 2);
      const Eigen::AlignedBox2d box(mask.centre(squares->min().x(), squares->min().y()) - half,
                                    mask.centre(squares->max().x(), squares->max().y()) + half);
      const Eigen::Vector2d size = box.sizes();
      const bool fits = size.x() >= params.min_width && size.y() >= params.min_height && size.x() <= widest_gap;
      const bool known =
          std::any_of(found.begin(), found.end(), [&](const FaceHole& other) { return other.box.intersects(box); });
      if (!filled || !fits || known) continue;
      const double rim = least_side(mask, evidence.spacing, box);
      if (rim < least_gap_side) continue;
      BlankGap gap{face, fitted_hole(*squares, evidence), false};
      gap.hole.kind = "window";
      gap.window = rim >= least_clean_side && size.prod() >= least_pane &&
                   static_cast<double>(mask.count(*squares, Square::hole)) >= least_in_sight * all;
      gaps.push_back({std::move(gap), 0});
    }
}

/// Whether another room's face stands behind a part of a hole.
bool has_back(const Building& building, const std::vector<std::size_t>& behind, const FaceHole& hole) {
  const auto outline = outline_of(hole);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const auto& p : outline) middle += p / static_cast<double>(outline.size());
  return std::any_of(behind.begin(), behind.end(), [&](std::size_t f) {
    const BuildingFace& back = building.faces[f];
    const auto over = [&](const Eigen::Vector3d& p) {
      return face_contains(building, back, p - back.plane.normal * back.plane.signed_distance(p), 0.02);
    };
    return over(middle) || std::any_of(outline.begin(), outline.end(), over);
  });
}

}  // namespace

std::vector<BlankGap> blank_gaps(const Building& building, const Cloud& cloud, const std::vector<FaceMask>& masks,
                                 const Evidence& evidence, const Found& found, const Openings::Params& params) {
  std::vector<Gap> gaps;
  for (std::size_t f = 0; f < masks.size(); ++f)
    if (evidence[f].looked_at() && building.faces[f].surface == SurfaceClass::wall && building.faces[f].primitive >= 0)
      find_gaps(f, masks[f], evidence[f], found[f], params, gaps);
  if (gaps.empty()) return {};
  for (const auto& point : cloud.points) {
    const Eigen::Vector3d p = point.cast<double>();
    for (Gap& g : gaps) {
      const double distance = building.faces[g.gap.face].plane.signed_distance(p);
      if (distance > before_gap || distance < 2 * evidence[g.gap.face].tolerance) continue;
      g.in_front += g.gap.hole.box.contains(g.gap.hole.frame.to_plane(p)) ? 1 : 0;
    }
  }
  const auto behind = opposite_faces(building);
  std::vector<BlankGap> result;
  for (auto& g : gaps) {
    if (g.in_front >= few_before_gap) continue;
    g.gap.window = g.gap.window && !has_back(building, behind[g.gap.face], g.gap.hole);
    result.push_back(std::move(g.gap));
  }
  return result;
}

}  // namespace atrium::layout
