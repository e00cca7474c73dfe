#include "modules/geometry/upright_evidence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "modules/geometry/upright_things.hpp"
#include "modules/geometry/upright_view.hpp"

namespace atrium {
namespace {

/// Distances between main levels that face each other, one a column; rising. None if they lie over each other in few
/// columns: a table is no ceiling.
std::vector<double> gaps_of(const UprightView& view) {
  std::vector<double> gaps;
  constexpr double least = 0.3;  // of any unit: what is less is one surface or a step
  constexpr double least_share = 0.2;
  std::size_t levels = 0;
  for (std::size_t c = 0; c + 1 < view.columns().size(); ++c) {
    double widest = 0;
    bool any = false;
    for (auto i = view.columns()[c]; i < view.columns()[c + 1]; ++i) {
      const auto& item = view.items()[i];
      if (!item.main || item.kind != UprightView::Kind::level) continue;
      const auto* above = view.above(item.block, item.height);
      const auto* below = view.below(item.block, item.height);
      if (above != nullptr) widest = std::max(widest, above->height - static_cast<double>(item.height));
      if (below != nullptr) widest = std::max(widest, static_cast<double>(item.height) - below->height);
      any = true;
    }
    if (widest > least) gaps.push_back(widest);
    levels += any ? 1 : 0;
  }
  if (static_cast<double>(gaps.size()) < least_share * static_cast<double>(levels)) gaps.clear();
  std::sort(gaps.begin(), gaps.end());
  return gaps;
}

/// ln of the density (over ln of the length) of a clear height or width of rooms in a dwelling or office, and of halls.
struct GapFit {
  double home_height = -1, home_width = -1, hall_height = -1, hall_width = -1;  ///< −1: no gap, which says nothing
};

double log_density(double length, double median, double deviation) {
  const double z = std::log(length / median) / deviation;
  constexpr double least = -6;
  return std::max(least, -0.5 * z * z - std::log(deviation * std::sqrt(2 * std::numbers::pi)));
}

GapFit fit_of(const std::vector<double>& gaps) {
  if (gaps.empty()) return {};
  GapFit fit{0, 0, 0, 0};
  const auto n = static_cast<double>(gaps.size());
  for (const double g : gaps) {
    fit.home_height += log_density(g, 2.6, 0.17) / n;
    fit.home_width += log_density(g, 3.8, 0.65) / n;
    fit.hall_height += log_density(g, 6.0, 0.5) / n;
    fit.hall_width += log_density(g, 14.0, 0.6) / n;
  }
  return fit;
}

struct Axis {
  UprightAxis axis;
  std::array<UprightEvidence, 2> ways;
  GapFit fit;
  double cover = 0, spread = 1;
};

double cover_of(const UprightView& view) {
  double covered = 0;
  for (std::size_t c = 0; c + 1 < view.columns().size(); ++c) {
    bool main = false;
    for (auto i = view.columns()[c]; i < view.columns()[c + 1]; ++i)
      main = main || (view.items()[i].large && view.items()[i].kind == UprightView::Kind::level);
    covered += main ? 1 : 0;
  }
  return view.columns().size() > 1 ? covered / static_cast<double>(view.columns().size() - 1) : 0;
}

Axis look_along(const SurfacePieces& pieces, const UprightAxis& axis, double scale) {
  Axis result{axis, {}, {}, 0, 1};
  const UprightView view(pieces, axis.direction, scale);
  add_things(view, result.ways);
  const std::vector<double> gaps = gaps_of(view);
  result.fit = fit_of(gaps);
  for (auto& way : result.ways) way.room_height = gaps.empty() ? 0 : gaps[gaps.size() / 2];
  result.cover = cover_of(view);
  result.spread = view.spread();
  return result;
}

/// ln of the density of the clear heights along an axis and of the widths along those across it, be it a dwelling or,
/// which is rarer, a hall: what is high is wide.
double heights_of(const Axis& axis, const std::vector<Axis>& axes) {
  double home = 0, hall = 0, across = 0;
  constexpr double upright = 0.2588;  // cosine of 75 degrees
  for (const auto& other : axes) {
    if (std::abs(other.axis.direction.dot(axis.axis.direction)) > upright) continue;
    home += other.fit.home_width;
    hall += other.fit.hall_width;
    ++across;
  }
  constexpr double share_of_halls = 0.05;
  home = axis.fit.home_height + (across > 0 ? 2 * home / across : -2);
  hall = axis.fit.hall_height + (across > 0 ? 2 * hall / across : -2);
  const double more = std::max(home, hall);
  return more + std::log((1 - share_of_halls) * std::exp(home - more) + share_of_halls * std::exp(hall - more));
}

}  // namespace

std::vector<UprightCandidate> upright_candidates(const std::vector<SurfacePiece>& points,
                                                 const std::vector<FacedArea>& faces, double scale,
                                                 const Context& context) {
  constexpr double smallest = 0.05;  // metres: the width of a door in ten pieces or more
  const SurfacePieces pieces = thin_to_pieces(points, smallest / scale);
  const std::vector<UprightAxis> known = upright_axes(faces);
  std::vector<Axis> axes(known.size());
  context.parallel_for(
      axes.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) axes[i] = look_along(pieces, known[i], scale);
      },
      1);
  double support = 1e-3, cover = 1e-3, spread = 1e300;
  for (const auto& axis : axes) {
    support = std::max(support, axis.axis.support);
    cover = std::max(cover, axis.cover);
    spread = std::min(spread, axis.spread);
  }
  std::vector<UprightCandidate> result;
  for (const auto& axis : axes) {
    for (const bool upwards : {true, false}) {
      UprightEvidence e = axis.ways[upwards ? 0 : 1];
      e.heights = heights_of(axis, axes);
      e.structure = std::max(-4.0, 6 * std::log(std::max(1e-3, axis.axis.support) / support));
      e.cover = std::max(-3.0, 3 * std::log(std::max(1e-3, axis.cover) / cover));
      e.few_levels = std::max(-2.0, std::log(spread / axis.spread));
      result.push_back({upwards ? axis.axis.direction : Eigen::Vector3d(-axis.axis.direction), e});
    }
  }
  return result;
}

}  // namespace atrium
