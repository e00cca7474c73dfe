#include "modules/floorplan/walls.hpp"

#include <algorithm>
#include <cmath>

#include "modules/floorplan/regions.hpp"
#include "modules/floorplan/wall_pieces.hpp"

namespace atrium::floorplan {
namespace {

PlanWall wall_of(const WallPiece& piece) {
  PlanWall wall{piece.from, piece.to, piece.thickness, {}, piece.primitives};
  if (piece.two_faces()) {
    wall.outline = {meet(piece.right, piece.start), meet(piece.right, piece.end), meet(piece.left, piece.end),
                    meet(piece.left, piece.start)};
    wall.from = 0.5 * (wall.outline[0] + wall.outline[3]);
    wall.to = 0.5 * (wall.outline[1] + wall.outline[2]);
  }
  return wall;
}

// The part of the line from a to b within the convex ring, counter-clockwise, as metres from a.
Span within_ring(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const PlanRing& ring) {
  const Eigen::Vector2d along = (b - a).normalized();
  Span span{0, (b - a).norm()};
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d side = ring[(i + 1) % ring.size()] - ring[i];
    const double rate = cross(side, along), at = cross(side, a - ring[i]);
    if (std::abs(rate) < 1e-12) {
      if (at < 0) return {0, 0};
    } else if (rate > 0) {
      span.from = std::max(span.from, -at / rate);
    } else {
      span.to = std::min(span.to, -at / rate);
    }
  }
  return span.length() > 0 ? span : Span{0, 0};
}

// What of a single face an earlier wall covers.
Span covered(const PlanWall& face, const PlanWall& wall, double merge_distance) {
  constexpr double nearly_parallel = 0.17;  // sin 10°
  const Eigen::Vector2d along = (face.to - face.from).normalized(), other = (wall.to - wall.from).normalized();
  const bool parallel = std::abs(cross(along, other)) < nearly_parallel;
  if (!parallel) return wall.outline.empty() ? Span{0, 0} : within_ring(face.from, face.to, wall.outline);
  if (wall.outline.empty() && along.dot(other) < 0) return {0, 0};  // two sides of a thin wall are both seen
  const double beyond = wall.outline.empty() ? merge_distance : 0;
  return within_ring(face.from, face.to, strip(wall.from, wall.to, 0.5 * wall.thickness + merge_distance, beyond));
}

// Step 4: walls whose thickness was given, longest first, where no other wall covers their face. An end that stays is
// the one of step 3.
void add_given_walls(std::vector<PlanWall>& walls, std::vector<WallPiece> pieces, const WallLimits& limits) {
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const WallPiece& a, const WallPiece& b) { return a.given > b.given; });
  for (const auto& piece : pieces) {
    const Eigen::Vector2d &along = piece.left.along, normal(-along.y(), along.x());
    const auto at = [&](double s) -> Eigen::Vector2d { return piece.left.point + s * along; };
    PlanWall face;
    face.from = at(0);
    face.to = at(piece.given);
    std::vector<Span> spans{{0, piece.given}};
    for (const auto& wall : walls) spans = without(spans, covered(face, wall, limits.merge_distance));
    for (const auto& span : spans) {
      if (span.length() < limits.min_length) continue;
      WallPiece rest = piece;
      if (span.from > 0) rest.start = {at(span.from), normal};
      if (span.to < piece.given) rest.end = {at(span.to), normal};
      walls.push_back(wall_of(rest));
    }
  }
}

// Step 4: single faces, longest first, without what other walls cover.
void add_single_faces(std::vector<PlanWall>& walls, std::vector<PlanWall> singles, const WallLimits& limits) {
  std::stable_sort(singles.begin(), singles.end(), [](const PlanWall& a, const PlanWall& b) {
    return (a.to - a.from).norm() > (b.to - b.from).norm();
  });
  for (const auto& single : singles) {
    std::vector<Span> spans{{0, (single.to - single.from).norm()}};
    for (const auto& wall : walls) spans = without(spans, covered(single, wall, limits.merge_distance));
    const Eigen::Vector2d along = (single.to - single.from).normalized();
    for (const auto& span : spans) {
      if (span.length() < limits.min_length) continue;
      PlanWall rest = single;
      rest.from = single.from + span.from * along;
      rest.to = single.from + span.to * along;
      walls.push_back(std::move(rest));
    }
  }
}

}  // namespace

std::vector<PlanWall> walls_of(const std::vector<WallFace>& faces, const WallLimits& limits) {
  std::vector<PlanWall> walls, singles;
  std::vector<WallPiece> given;
  for (const auto& piece : joined_ends(paired_faces(faces, limits), limits.corner_gap)) {
    if (piece.length() < 1e-6) continue;
    if (piece.given > 0)
      given.push_back(piece);
    else
      (piece.two_faces() ? walls : singles).push_back(wall_of(piece));
  }
  add_given_walls(walls, std::move(given), limits);
  add_single_faces(walls, std::move(singles), limits);
  return walls;
}

}  // namespace atrium::floorplan
