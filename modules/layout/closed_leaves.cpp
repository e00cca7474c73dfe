#include "modules/layout/closed_leaves.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "modules/geometry/quantile.hpp"
#include "modules/layout/wall_levels.hpp"

namespace atrium::layout {
namespace {

constexpr double narrowest_leaf = 0.6, widest_leaf = 2.05, lowest_leaf = 1.85, highest_leaf = 2.4;  // metres; of leaves
constexpr double rim_width = 0.2;                                                                   // metres
constexpr double least_step = 0.02, most_behind = 0.16, most_before = 0.06;                         // metres

constexpr double narrowest_pane = 0.5, widest_pane = 2.4;  // metres; of windows, both ways
constexpr double lowest_sill = 0.4, highest_sill = 1.3;    // metres over the foot
constexpr double lowest_head = 1.7, highest_pane = 2.6;    // metres over the foot
constexpr double least_pane_step = 0.03;                   // metres

struct LeafRectangle {
  LevelBlock leaf;
  double score = 0;
};

/// The rim left, right, above and, of what does not stand on the floor, below; a side that the face does not have is
/// empty. Squares of the edge belong to neither.
std::array<LevelBlock, 4> rims_of(const LevelBlock& leaf, const WallLevels& levels) {
  const int rim = static_cast<int>(std::lround(rim_width / levels.pixel));
  const auto clipped = [&](int x0, int x1, int y0, int y1) {
    return LevelBlock{std::clamp(x0, 0, levels.width), std::clamp(x1, 0, levels.width),
                      std::clamp(y0, 0, levels.height), std::clamp(y1, 0, levels.height)};
  };
  return {clipped(leaf.x0 - 1 - rim, leaf.x0 - 1, leaf.y0, leaf.y1),
          clipped(leaf.x1 + 1, leaf.x1 + 1 + rim, leaf.y0, leaf.y1),
          clipped(leaf.x0, leaf.x1, leaf.y1 + 1, leaf.y1 + 1 + rim),
          clipped(leaf.x0, leaf.x1, leaf.y0 - 1 - rim, leaf.y0 - 1)};
}

/// What stands on the floor covers the lowest squares.
constexpr int foot_row = 1;
bool stands(const LevelBlock& leaf) { return leaf.y0 <= foot_row; }
std::size_t sides_of(const LevelBlock& leaf) { return stands(leaf) ? 3 : 4; }

constexpr double least_rim = 0.1, beside_leaf = 0.15;  // metres: of the rim's width; where the face ends beside a leaf

/// Whether a side lacks because the face ends there. The wall above a leaf cannot lack.
bool may_lack(const std::array<LevelBlock, 4>& rims, std::size_t side, const LevelBlock& leaf,
              const WallLevels& levels) {
  if (!stands(leaf)) return false;
  if (side == 0) return leaf.x0 * levels.pixel <= beside_leaf && rims[1].area() > 0;
  if (side == 1) return (levels.width - leaf.x1) * levels.pixel <= beside_leaf && rims[0].area() > 0;
  return false;
}

bool is_narrow(const LevelBlock& rim, std::size_t side, const WallLevels& levels) {
  return (side >= 2 ? rim.y1 - rim.y0 : rim.x1 - rim.x0) * levels.pixel < least_rim - 1e-9;
}

/// How much a rectangle differs from its rim, in relation to how much both scatter; 0: it is no leaf.
double score_of(const LevelBlock& leaf, const WallLevels& levels, const LevelSums& sums) {
  constexpr double seen = 0.5, least_mean = 0.6 * least_step, noise = 0.004;  // shares of squares; metres
  const Spread inside = sums.in(leaf);
  if (inside.count < seen * leaf.area()) return 0;
  const auto rims = rims_of(leaf, levels);
  Spread around;
  double way = 0;
  std::size_t lacking = 0;
  for (std::size_t s = 0; s < sides_of(leaf); ++s) {
    if (is_narrow(rims[s], s, levels)) {
      if (!may_lack(rims, s, leaf, levels) || ++lacking > 1) return 0;
      continue;
    }
    const Spread rim = sums.in(rims[s]);
    if (rim.count < seen * rims[s].area()) return 0;
    const double step = rim.mean() - inside.mean();
    if (std::abs(step) < least_mean || step * way < 0) return 0;
    way = step;
    around += rim;
  }
  const double step = around.mean() - inside.mean();
  const double variance = (inside.scatter() + around.scatter()) / (inside.count + around.count);
  return step * step * inside.count * around.count / (inside.count + around.count) / (variance + noise * noise);
}

std::vector<float> seen_in(const WallLevels& levels, const LevelBlock& block) {
  std::vector<float> result;
  result.reserve(static_cast<std::size_t>(block.area()));
  for (int y = block.y0; y < block.y1; ++y)
    for (int x = block.x0; x < block.x1; ++x)
      if (const float d = levels.at(x, y); !std::isnan(d)) result.push_back(d);
  return result;
}

/// The share of values within `most` of a level.
double share_at(const std::vector<float>& values, double level, double most) {
  if (values.empty()) return 0;
  const auto near = std::count_if(values.begin(), values.end(), [&](float d) { return std::abs(d - level) <= most; });
  return static_cast<double>(near) / static_cast<double>(values.size());
}

/// A door's casing stands before the wall beside the leaf.
void leave_out_casing(std::vector<float>& side, double wall) {
  constexpr double least = 0.01, most = 0.06;  // metres before the wall
  const auto is_casing = [&](float d) { return d > wall + least && d < wall + most; };
  if (2 * std::count_if(side.begin(), side.end(), is_casing) <= static_cast<std::ptrdiff_t>(side.size()))
    std::erase_if(side, is_casing);
}

struct Judged {
  double leaf = 0, wall = 0;  ///< their levels, metres
  double confidence = 0;      ///< 0: no leaf
  double step() const { return wall - leaf; }
};

/// Whether the rectangle is a leaf by the middles of its squares, and how sure that is.
Judged judge(const LevelBlock& leaf, const WallLevels& levels) {
  constexpr double most_off = 0.035, least_inside = 0.85, least_side = 0.8;  // metres; shares of squares
  constexpr double foot = 0.45, foot_seen = 0.3, foot_share = 0.7;           // metres; shares
  Judged judged;
  std::vector<float> inside = seen_in(levels, leaf), around;
  judged.leaf = median(inside);
  const auto rims = rims_of(leaf, levels);
  std::vector<std::vector<float>> sides;
  sides.reserve(rims.size());
  for (std::size_t s = 0; s < sides_of(leaf); ++s) {
    if (is_narrow(rims[s], s, levels)) continue;
    sides.push_back(seen_in(levels, rims[s]));
    around.insert(around.end(), sides.back().begin(), sides.back().end());
  }
  judged.wall = median(around);
  for (auto& side : sides) leave_out_casing(side, judged.wall);
  const double step = judged.step();
  if (std::abs(step) < least_step || step > most_behind || step < -most_before) return judged;
  if (!stands(leaf) && step < least_pane_step) return judged;
  const double off = std::min(0.5 * std::abs(step), most_off);
  double clean = 1;
  for (const auto& side : sides) clean = std::min(clean, share_at(side, judged.wall, off));
  const double filled = share_at(inside, judged.leaf, off);
  const bool before = step < 0, strict = before || !stands(leaf);  // so do cupboards and pictures: all must be clean
  if (clean < (strict ? 0.5 * (1 + least_side) : least_side)) return judged;
  if (filled < (strict ? 0.5 * (1 + least_inside) : least_inside)) return judged;
  const double seen = static_cast<double>(inside.size()) / leaf.area();
  const double sharp = std::clamp(std::abs(step) / (2 * least_step), 0.5, 1.0);
  judged.confidence = clean * filled * std::min(1.0, 0.3 + seen) * sharp * (sides.size() < sides_of(leaf) ? 0.8 : 1) *
                      (before ? 0.7 : 1);
  if (!stands(leaf)) return judged;
  LevelBlock low = leaf;
  low.y1 = std::min(leaf.y1, leaf.y0 + static_cast<int>(std::lround(foot / levels.pixel)));
  const auto lower = seen_in(levels, low);
  if (static_cast<double>(lower.size()) < foot_seen * low.area() || share_at(lower, judged.leaf, off) < foot_share)
    judged.confidence = 0;
  return judged;
}

constexpr double least_score = 100;

/// The best first.
void sort_by_score(std::vector<LeafRectangle>& all) {
  std::stable_sort(all.begin(), all.end(),
                   [](const LeafRectangle& a, const LeafRectangle& b) { return a.score > b.score; });
}

/// How much of the face stands off its middle level by so much that it may be a leaf, m².
double area_off_level(const WallLevels& levels) {
  constexpr double most = 0.6 * least_step;  // metres
  std::vector<float> all = seen_in(levels, {0, levels.width, 0, levels.height});
  if (all.empty()) return 0;
  const double level = median(all);
  return (1 - share_at(all, level, most)) * static_cast<double>(all.size()) * levels.pixel * levels.pixel;
}

std::vector<LeafRectangle> door_candidates(const WallLevels& levels, const LevelSums& sums) {
  const auto squares = [&](double length) { return static_cast<int>(std::lround(length / levels.pixel)); };
  std::vector<LeafRectangle> result;
  for (int x0 = 0; x0 < levels.width; ++x0)
    for (int x1 = x0 + squares(narrowest_leaf); x1 <= std::min(levels.width, x0 + squares(widest_leaf)); ++x1)
      for (int y1 = squares(lowest_leaf); y1 <= std::min(levels.height, squares(highest_leaf)); ++y1) {
        const LevelBlock leaf{x0, x1, 1, y1};  // what stands on the floor covers the lowest squares
        if (const double score = score_of(leaf, levels, sums); score >= least_score) result.push_back({leaf, score});
      }
  sort_by_score(result);
  return result;
}

/// A rectangle whose sides move by a square for as long as that makes it better.
LeafRectangle refined(LeafRectangle best, const WallLevels& levels, const LevelSums& sums) {
  constexpr int most_moves = 20;
  for (int move = 0; move < most_moves; ++move) {
    const LevelBlock from = best.leaf;
    for (const auto side : {&LevelBlock::x0, &LevelBlock::x1, &LevelBlock::y0, &LevelBlock::y1})
      for (const int way : {-1, 1}) {
        LevelBlock leaf = from;
        leaf.*side += way;
        if (stands(leaf) || leaf.x0 < 0 || leaf.x1 > levels.width || leaf.y1 > levels.height) continue;
        if (const double score = score_of(leaf, levels, sums); score > best.score) best = {leaf, score};
      }
    if (best.leaf.x0 == from.x0 && best.leaf.x1 == from.x1 && best.leaf.y0 == from.y0 && best.leaf.y1 == from.y1) break;
  }
  return best;
}

/// Every second square, then refined.
std::vector<LeafRectangle> window_candidates(const WallLevels& levels, const LevelSums& sums) {
  constexpr int stride = 2;
  const auto squares = [&](double length) { return static_cast<int>(std::lround(length / levels.pixel)); };
  const int top = std::min(levels.height, squares(highest_pane));
  std::vector<LeafRectangle> result;
  for (int x0 = 0; x0 < levels.width; x0 += stride)
    for (int x1 = x0 + squares(narrowest_pane); x1 <= std::min(levels.width, x0 + squares(widest_pane)); x1 += stride)
      for (int y0 = squares(lowest_sill); y0 <= squares(highest_sill); y0 += stride)
        for (int y1 = std::max(squares(lowest_head), y0 + squares(narrowest_pane)); y1 <= top; y1 += stride) {
          const LevelBlock leaf{x0, x1, y0, y1};
          if (const double score = score_of(leaf, levels, sums); score >= least_score) result.push_back({leaf, score});
        }
  sort_by_score(result);
  return result;
}

/// The leaf as a hole of its face, its sides where the wall's points end.
FaceHole hole_of(const LevelBlock& leaf, const Judged& judged, const WallLevels& levels, const FaceEvidence& evidence) {
  const Eigen::Vector2d low = evidence.mask.box().min();
  const Eigen::AlignedBox2d rough(low + levels.pixel * Eigen::Vector2d(leaf.x0, stands(leaf) ? 0 : leaf.y0),
                                  low + levels.pixel * Eigen::Vector2d(leaf.x1, leaf.y1));
  FaceEvidence around;
  around.frame = evidence.frame;
  around.mask = FaceMask(evidence.mask.box(), evidence.mask.pixel());
  around.spacing = evidence.spacing;
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(2 * rim_width);
  const Eigen::AlignedBox2d near(rough.min() - margin, rough.max() + margin);
  const double middle = 0.5 * (judged.leaf + judged.wall), wall = judged.step() > 0 ? 1 : -1;
  for (const auto& p : evidence.near) {
    const Eigen::Vector2d place = p.head<2>().cast<double>();
    if (near.contains(place) && wall * (p.z() - middle) > 0) around.on.push_back(place);
  }
  FaceHole hole = fitted_hole(around.mask.squares_in(rough), around);
  if (!stands(leaf)) {
    hole.kind = "window";
    return hole;
  }
  hole.kind = "door";
  hole.foot = low.y();
  hole.box.min().y() = hole.foot;
  hole.leads_on = true;
  return hole;
}

}  // namespace

std::vector<ClosedLeaf> closed_leaves(const BuildingFace& face, const FaceEvidence& evidence) {
  constexpr double much = 0.5, least_part = 0.5;  // of the larger of two rectangles; of the smallest leaf
  std::vector<ClosedLeaf> result;
  if (!evidence.looked_at() || face.primitive < 0 || face.surface != SurfaceClass::wall) return result;
  const WallLevels levels = levels_of(evidence);
  if (levels.squares.empty()) return result;
  const double off = area_off_level(levels);
  if (off < least_part * narrowest_pane * narrowest_pane) return result;
  const LevelSums sums(levels);
  std::vector<LevelBlock> taken;
  const auto take = [&](const LevelBlock& leaf) {
    if (std::any_of(taken.begin(), taken.end(), [&](const LevelBlock& b) { return b.touches(leaf); })) return true;
    const Judged judged = judge(leaf, levels);
    if (judged.confidence <= 0) return false;
    const FaceHole hole = hole_of(leaf, judged, levels, evidence);
    constexpr double slack = 0.05;  // metres: of its squares
    if (hole.kind == "door" && hole.box.sizes().y() > highest_leaf + slack) return false;
    taken.push_back(leaf);
    result.push_back({hole, judged.step(), std::min(1.0, judged.confidence)});
    return true;
  };
  if (off >= least_part * narrowest_leaf * lowest_leaf) {
    // The best come first: where many are none, so is the rest.
    constexpr int most_tries = 100, place = 5;  // squares: leaves around one middle
    std::map<int, int> failed;
    for (const auto& candidate : door_candidates(levels, sums)) {
      int& tries = failed[(candidate.leaf.x0 + candidate.leaf.x1) / 2 / place];
      if (tries < most_tries && !take(candidate.leaf)) ++tries;
    }
  }
  std::vector<LevelBlock> rejected;
  for (const auto& candidate : window_candidates(levels, sums)) {
    const LevelBlock& leaf = candidate.leaf;
    if (std::none_of(taken.begin(), taken.end(), [&](const LevelBlock& b) { return b.touches(leaf); }) &&
        std::none_of(rejected.begin(), rejected.end(), [&](const LevelBlock& b) { return b.shared(leaf) > much; })) {
      const LevelBlock refined_leaf = refined(candidate, levels, sums).leaf;
      if (!take(refined_leaf)) rejected.push_back(refined_leaf);
    }
  }
  return result;
}

}  // namespace atrium::layout
