#include "modules/layout/face_holes.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "modules/geometry/quantile.hpp"
#include "modules/layout/raster.hpp"

namespace atrium::layout {
namespace {

constexpr std::size_t few = 6;        // points: fewer say nothing
constexpr double reveal_depth = 0.3;  // metres behind the face that jambs are looked for

/// One side of a rough rectangle, and the places beside it as numbers that grow towards the hole.
struct Side {
  int axis;
  bool low;
  double inwards(double place) const { return low ? place : -place; }
};

/// Of the points outside of this side the last before the hole, but for outliers.
std::optional<double> last_before(const std::vector<double>& beside) {
  constexpr double most = 0.95;
  if (beside.size() < few) return std::nullopt;
  return quantile(beside, most);
}

/// The middle of the slice that holds at least half of the places: a jamb, seen edge on.
std::optional<double> jamb(std::vector<double>& places) {
  constexpr double slice = 0.04;
  if (places.size() < few) return std::nullopt;
  std::sort(places.begin(), places.end());
  std::size_t most = 0, first = 0;
  for (std::size_t i = 0, k = 0; k < places.size(); ++k) {
    while (places[k] - places[i] > slice) ++i;
    if (k - i + 1 <= most) continue;
    most = k - i + 1;
    first = i;
  }
  if (most < few || 2 * most < places.size()) return std::nullopt;
  return places[first + most / 2];
}

/// Moves the sides of a rectangle to where the face's points around it begin, or where its reveal stands.
void fit_sides(const FaceEvidence& evidence, FaceHole& hole) {
  const double pixel = evidence.mask.pixel();
  const double out = 2 * evidence.spacing + 1.5 * pixel, in = 1.5 * pixel;
  const Eigen::AlignedBox2d rough = hole.box;
  for (int s = 0; s < 4; ++s) {
    const Side side{s / 2, s % 2 == 0};
    const double at = side.inwards(side.low ? rough.min()[side.axis] : rough.max()[side.axis]);
    const int across = 1 - side.axis;
    const auto add = [&](std::vector<double>& places, double x, double y) {
      const Eigen::Vector2d p(x, y);
      const double place = side.inwards(p[side.axis]);
      if (place >= at - out && place <= at + in && p[across] > rough.min()[across] && p[across] < rough.max()[across])
        places.push_back(place);
    };
    std::vector<double> beside, reveal;
    for (const auto& p : evidence.on) add(beside, p.x(), p.y());
    std::optional<double> place;
    if (beside.size() < 4 * few || evidence.spacing > 0) {
      for (const auto& p : evidence.behind)
        if (p.z() < reveal_depth) add(reveal, p.x(), p.y());
      place = jamb(reveal);
      if (place) hole.support[static_cast<std::size_t>(s)] = reveal.size();
    }
    if (!place) {
      place = last_before(beside);
      if (place) hole.support[static_cast<std::size_t>(s)] = beside.size();
    }
    if (place) (side.low ? hole.box.min()[side.axis] : hole.box.max()[side.axis]) = side.inwards(*place);
  }
  if (hole.box.isEmpty()) hole.box = rough;
}

/// Whether enough of a rectangle is a hole. What is hidden may or may not be.
bool fills(const FaceMask& mask, const Eigen::AlignedBox2i& squares, double min_fill) {
  const auto hole = static_cast<double>(mask.count(squares, Square::hole));
  const auto hidden = static_cast<double>(mask.count(squares, Square::hidden));
  return hole + 0.5 * hidden >= min_fill * (squares.sizes().x() + 1.0) * (squares.sizes().y() + 1.0);
}

/// What the squares of the least opening that counts sum up to.
double least_sum(const BuildingFace& face, const FaceEvidence& evidence, const Openings::Params& params) {
  const double pixel = evidence.mask.pixel(), lost = 2 * (evidence.spacing + pixel);
  const bool wall = face.surface == SurfaceClass::wall;
  const double width = (wall ? params.min_width : params.min_slab_width) - lost;
  const double height = (wall ? params.min_height : params.min_slab_width) - lost;
  return 0.5 * std::max(width / pixel, 1.0) * std::max(height / pixel, 1.0);
}

/// Says what kind of opening a hole is; false if it is too small for any.
bool name_hole(const Openings::Params& params, const BuildingFace& face, const Eigen::AlignedBox2d& all,
               FaceHole& hole) {
  const Eigen::Vector2d size = hole.box.sizes();
  const bool slab = face.surface != SurfaceClass::wall && is_level(face.plane);
  if (slab ? size.minCoeff() < params.min_slab_width : size.x() < params.min_width || size.y() < params.min_height)
    return false;
  hole.kind = slab ? "slab" : "window";
  if (face.surface == SurfaceClass::wall && hole.box.min().y() - all.min().y() <= params.sill_height) {
    hole.kind = "door";
    hole.box.min().y() = all.min().y();
  }
  return true;
}

/// Whether most of the face was seen between two heights below a hole.
bool is_solid_below(const FaceMask& mask, const FaceHole& hole, double low, double high) {
  constexpr double most = 0.5;
  const Eigen::AlignedBox2i squares =
      mask.squares_in({Eigen::Vector2d(hole.box.min().x(), low), Eigen::Vector2d(hole.box.max().x(), high)});
  return static_cast<double>(mask.count(squares, Square::solid)) >
         most * (squares.sizes().x() + 1.0) * (squares.sizes().y() + 1.0);
}

/// Whether a hole may be the upper part of a door: it is as high, and what is below it is hidden. A strip of wall right
/// below it is a sill, whatever hides the rest (a radiator, mostly).
bool has_hidden_foot(const FaceEvidence& evidence, const FaceHole& hole) {
  constexpr double least_top = 1.7, sill = 0.15;  // metres over the foot; below the hole
  const FaceMask& mask = evidence.mask;
  const double foot = mask.box().min().y(), bottom = hole.box.min().y();
  if (hole.box.max().y() < foot + least_top) return false;
  const double edge = mask.pixel() + evidence.spacing;
  if (is_solid_below(mask, hole, std::max(foot, bottom - std::max(sill, 3 * edge)), bottom - edge)) return false;
  return !is_solid_below(mask, hole, foot, bottom);
}

/// How much of the face was seen in a box of its squares.
struct Seen {
  std::size_t squares = 0, solid = 0;
  double share(double without_squares) const {
    return squares > 0 ? static_cast<double>(solid) / static_cast<double>(squares) : without_squares;
  }
};
Seen seen_in(const FaceMask& mask, const Eigen::AlignedBox2d& box) {
  Seen seen;
  const Eigen::AlignedBox2i squares = mask.squares_in(box);
  for (int y = squares.min().y(); y <= squares.max().y(); ++y)
    for (int x = squares.min().x(); x <= squares.max().x(); ++x) {
      if (!box.contains(mask.centre(x, y)) || mask.at(x, y) == Square::outside) continue;
      ++seen.squares;
      seen.solid += mask.at(x, y) == Square::solid ? 1 : 0;
    }
  return seen;
}

/// Whether enough of the face was seen around a hole. Beyond the face's own edge nothing is expected; but a hole that
/// is wide must have both jambs in its face.
bool has_rim(const FaceMask& mask, const BuildingFace& face, double spacing, const FaceHole& hole,
             const Openings::Params& params) {
  constexpr double rim = 0.15, least_side = 0.4;  // metres; share of one side
  const double near = mask.pixel() + 0.5 * spacing, far = near + std::max(rim, spacing);
  const bool slab = hole.kind == "slab", strict = slab || hole.box.sizes().x() > params.max_door_width;
  const bool upright = face.surface == SurfaceClass::wall;
  Seen all;
  for (int side = 0; side < 4; ++side) {
    const int axis = side / 2;
    Eigen::AlignedBox2d band = hole.box;
    if (side % 2 == 0) {
      band.min()[axis] = hole.box.min()[axis] - far;
      band.max()[axis] = hole.box.min()[axis] - near;
    } else {
      band.min()[axis] = hole.box.max()[axis] + near;
      band.max()[axis] = hole.box.max()[axis] + far;
    }
    const Seen seen = seen_in(mask, band);
    all.squares += seen.squares;
    all.solid += seen.solid;
    if (strict && seen.share(upright && axis == 0 ? 0 : 1) < least_side) return false;
  }
  return all.share(slab ? 0 : 1) >= (strict ? params.min_wide_rim : params.min_rim);
}

/// Whether anything was seen behind a hole, its reveal at least, and more than strays; or the hole from both sides.
bool seen_through(const FaceEvidence& evidence, const FaceHole& hole) {
  constexpr double least_share = 0.02, clear = 6, most = 0.5;  // strays are denser where the way is short
  const Eigen::Vector2d jamb = Eigen::Vector2d::Constant(evidence.mask.pixel());
  const Eigen::AlignedBox2d around(hole.box.min() - jamb, hole.box.max() + jamb);
  const Eigen::AlignedBox2i squares = evidence.open.squares_in(around);
  const double all = (squares.sizes().x() + 1.0) * (squares.sizes().y() + 1.0);
  const auto points = std::count_if(evidence.through.begin(), evidence.through.end(),
                                    [&](const Eigen::Vector2d& p) { return around.contains(p); });
  if (static_cast<double>(evidence.seen_from_both.count(squares, Square::hole)) > most * all) return true;
  return static_cast<double>(points) >= static_cast<double>(few) + clear * evidence.stray * all &&
         static_cast<double>(evidence.open.count(squares, Square::solid)) >= least_share * all;
}

/// Whether one can go through a hole that meets the floor: a leaf fills it, or the floor goes on behind it.
bool leads_on(const FaceEvidence& evidence, const FaceHole& hole, const Openings::Params& params) {
  constexpr double reveal = 0.15, strip = 0.1;  // metres inside of the sides; of a strip of floor
  constexpr double least = 0.2;                 // of the density of the face's own points
  constexpr double step_share = 0.25;           // of that, of lower floors
  const FaceMask& mask = evidence.mask;
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(reveal).cwiseMin(0.25 * hole.box.sizes());
  const Eigen::AlignedBox2d inner(hole.box.min() + margin, hole.box.max() - margin);
  const auto solid = static_cast<double>(mask.count(mask.squares_in(mask.box()), Square::solid));
  const double density = static_cast<double>(evidence.on.size()) / std::max(1.0, solid);  // per square
  const double per_square = least * density / (mask.pixel() * mask.pixel());              // per square metre
  double leaf = 0;
  std::size_t floor = 0;
  std::vector<bool> strips(static_cast<std::size_t>(std::max(1.0, inner.sizes().x() / strip)), false);
  const auto beyond = [&](const Eigen::Vector3d& p) {
    return p.z() >= params.max_thickness && p.x() > inner.min().x() && p.x() < inner.max().x();
  };
  const auto add_floor = [&](const Eigen::Vector3d& p) {
    ++floor;
    const double at = (p.x() - inner.min().x()) / inner.sizes().x() * static_cast<double>(strips.size());
    strips[std::min(strips.size() - 1, static_cast<std::size_t>(at))] = true;
  };
  for (const auto& p : evidence.behind)
    if (p.z() < params.max_thickness)
      leaf += inner.contains(Eigen::Vector2d(p.head<2>())) ? 1 : 0;
    else if (beyond(p) && p.y() < hole.box.min().y() + reveal)
      add_floor(p);
  // Floors outside lie lower, by up to a step; so do strays.
  const double most_strays =
      step_share * per_square * inner.sizes().x() * (depth_behind(params) - params.max_thickness);
  if (static_cast<double>(std::count_if(evidence.lower.begin(), evidence.lower.end(), beyond)) > most_strays)
    for (const auto& p : evidence.lower)
      if (beyond(p)) add_floor(p);
  const auto covered = static_cast<std::size_t>(std::count(strips.begin(), strips.end(), true));
  return leaf >= per_square * inner.volume() || (floor >= few && 2 * covered >= strips.size());
}

/// Whether the floor goes on behind a hole that meets it and of which everything was in sight: of a door without a
/// reveal nothing else shows.
bool is_clean_doorway(const FaceMask& mask, const FaceEvidence& evidence, const FaceHole& hole,
                      const Openings::Params& params) {
  constexpr double lintel = 0.1;  // metres: what reaches the ceiling is the end of a wall, or a niche
  if (hole.box.max().y() > mask.box().max().y() - lintel) return false;
  constexpr double clean = 0.8;  // squares beside its sides count as wall
  if (hole.kind != "door" || !leads_on(evidence, hole, params)) return false;
  const Eigen::AlignedBox2i squares = mask.squares_in(hole.box);
  return static_cast<double>(mask.count(squares, Square::hole)) >=
         clean * (squares.sizes().x() + 1.0) * (squares.sizes().y() + 1.0);
}

/// Leaves out those that touch a larger one: they are its fringe.
void drop_fringes(std::vector<FaceHole>& holes, const FaceEvidence& evidence) {
  const Eigen::Vector2d near = Eigen::Vector2d::Constant(evidence.spacing + evidence.mask.pixel());
  std::stable_sort(holes.begin(), holes.end(),
                   [](const auto& a, const auto& b) { return a.box.volume() > b.box.volume(); });
  std::vector<FaceHole> kept;
  for (const auto& hole : holes) {
    const Eigen::AlignedBox2d around(hole.box.min() - near, hole.box.max() + near);
    if (std::none_of(kept.begin(), kept.end(), [&](const auto& other) { return around.intersects(other.box); }))
      kept.push_back(hole);
  }
  holes = std::move(kept);
}

}  // namespace

FaceHole fitted_hole(const Eigen::AlignedBox2i& squares, const FaceEvidence& evidence) {
  FaceHole hole;
  hole.frame = evidence.frame;
  const Eigen::Vector2d half = Eigen::Vector2d::Constant(evidence.mask.pixel() / 2);
  hole.box = {evidence.mask.centre(squares.min().x(), squares.min().y()) - half,
              evidence.mask.centre(squares.max().x(), squares.max().y()) + half};
  fit_sides(evidence, hole);
  hole.box = hole.box.intersection(evidence.mask.box());
  return hole;
}

std::vector<FaceHole> face_holes(const BuildingFace& face, FaceEvidence& evidence, const Openings::Params& params) {
  std::vector<FaceHole> result;
  if (!evidence.looked_at() || face.primitive < 0) return result;
  const FaceMask before = evidence.mask;
  const double least = least_sum(face, evidence, params);
  for (const auto& part : evidence.mask.parts())
    while (const auto squares = evidence.mask.best_rectangle(part, least)) {
      const bool filled = fills(evidence.mask, *squares, params.min_fill);
      evidence.mask.fill(*squares, Square::solid);
      if (!filled) continue;
      FaceHole hole = fitted_hole(*squares, evidence);
      if (!name_hole(params, face, evidence.mask.box(), hole)) continue;
      if (seen_through(evidence, hole) || is_clean_doorway(before, evidence, hole, params)) {
        hole.foot = evidence.mask.box().min().y();
        hole.foot_hidden = face.surface == SurfaceClass::wall && has_hidden_foot(evidence, hole);
        hole.leads_on = leads_on(evidence, hole, params);
        hole.doubtful = !has_rim(before, face, evidence.spacing, hole, params);
        result.push_back(hole);
      }
    }
  drop_fringes(result, evidence);
  return result;
}

std::vector<Eigen::Vector3d> outline_of(const FaceHole& hole) {
  std::vector<Eigen::Vector3d> result;
  for (const auto& [u, v] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
    result.push_back(hole.frame.to_space(
        {u == 0 ? hole.box.min().x() : hole.box.max().x(), v == 0 ? hole.box.min().y() : hole.box.max().y()}));
  return result;
}

}  // namespace atrium::layout
