#include <algorithm>
#include <cmath>
#include <limits>

#include "modules/floorplan/wall_pieces.hpp"

namespace atrium::floorplan {
namespace {

constexpr double crossing = 0.34;  // sin 20°: walls at a smaller angle do not end on each other

struct Joint {
  double cost = std::numeric_limits<double>::infinity();
  double reach = 0;  // metres outwards from the end to where it joins
  Line on;
};

// Whether the end e is near enough to q for any joint: further away, none of joint()'s conditions can hold.
bool in_reach(const WallPiece& p, const Eigen::Vector2d& e, const WallPiece& q, double corner_gap) {
  const double reach = 2 * corner_gap + 0.5 * p.thickness + q.thickness * (0.5 + 1 / crossing);
  return (e.array() >= q.from.array().min(q.to.array()) - reach).all() &&
         (e.array() <= q.from.array().max(q.to.array()) + reach).all();
}

// How the end `e` of a piece (`outwards` away from it) may join q.
Joint joint(const WallPiece& p, const Eigen::Vector2d& e, const Eigen::Vector2d& outwards, const WallPiece& q,
            double corner_gap) {
  if (std::abs(cross(outwards, q.left.along)) < crossing) return {};
  const Line axis{e, outwards};
  const auto reach_of = [&](const Line& face) { return outwards.dot(meet(axis, face) - e); };
  Line near = q.left, far = q.right;
  if (reach_of(near) > reach_of(far)) std::swap(near, far);
  const double first = reach_of(near), last = reach_of(far);
  if (first > corner_gap || last < -corner_gap) return {};
  // Where along q the end would arrive, against q's own ends.
  const Eigen::Vector2d along = (q.to - q.from).normalized();
  const double place = along.dot(meet(axis, near) - q.from), slack = 0.5 * p.thickness + corner_gap;
  if (place < -slack || place > q.length() + slack) return {};
  const double cost = std::max({0.0, first, -last});
  return p.two_faces() ? Joint{cost, last, far} : Joint{cost, first, near};
}

Joint best_joint(const std::vector<WallPiece>& pieces, std::size_t p, bool at_end, double corner_gap) {
  const WallPiece& piece = pieces[p];
  const Eigen::Vector2d along = (piece.to - piece.from).normalized();
  const Eigen::Vector2d end = at_end ? piece.to : piece.from, outwards = at_end ? along : Eigen::Vector2d(-along);
  Joint best;
  for (std::size_t q = 0; q < pieces.size(); ++q) {
    if (q == p || !in_reach(piece, end, pieces[q], corner_gap)) continue;
    const Joint found = joint(piece, end, outwards, pieces[q], corner_gap);
    // Of two walls in the same place, the one of two faces is known better.
    if (found.cost < best.cost || (found.cost == best.cost && found.reach > best.reach)) best = found;
  }
  return best;
}

}  // namespace

std::vector<WallPiece> joined_ends(const std::vector<WallPiece>& pieces, double corner_gap) {
  std::vector<WallPiece> result = pieces;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const Joint start = best_joint(pieces, p, false, corner_gap), end = best_joint(pieces, p, true, corner_gap);
    const Eigen::Vector2d along = (pieces[p].to - pieces[p].from).normalized();
    WallPiece joined = pieces[p];
    if (std::isfinite(start.cost)) {
      joined.start = start.on;
      joined.from = pieces[p].from - start.reach * along;
    }
    if (std::isfinite(end.cost)) {
      joined.end = end.on;
      joined.to = pieces[p].to + end.reach * along;
    }
    if (along.dot(joined.to - joined.from) > 0) result[p] = joined;  // else it is too short to be cut at both ends
  }
  return result;
}

}  // namespace atrium::floorplan
