#include "modules/floorplan/room_label.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "modules/floorplan/plan_view.hpp"

namespace atrium::floorplan {
namespace {

// Scaled so that the label is a square of half side 1: its clearance is then a distance by the largest coordinate.
class Clearance {
 public:
  Clearance(const PlanPolygon& room, const std::vector<PlanWall>& walls, const Eigen::Vector2d& half) {
    for (const auto& wall : walls) walls_.emplace_back(wall.from.cwiseQuotient(half), wall.to.cwiseQuotient(half));
    add(room.outline, half);
    for (const auto& hole : room.holes) add(hole, half);
  }
  // Half side of the largest square about p within the room; negative outside.
  double at(const Eigen::Vector2d& p) const {
    double nearest = 1e300;
    bool inside = false;
    for (const auto& [a, b] : edges_) {
      nearest = std::min(nearest, distance(p, a, b));
      if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()))
        inside = !inside;
    }
    for (const auto& [a, b] : walls_) nearest = std::min(nearest, distance(p, a, b));
    return inside ? nearest : -nearest;
  }

 private:
  void add(const PlanRing& ring, const Eigen::Vector2d& half) {
    for (std::size_t i = 0; i < ring.size(); ++i)
      edges_.emplace_back(ring[i].cwiseQuotient(half), ring[(i + 1) % ring.size()].cwiseQuotient(half));
  }
  // Largest coordinate of the segment's nearest point by that measure: the least of max(|x|, |y|) along it lies at an
  // end or where |x| = |y|.
  static double distance(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    const Eigen::Vector2d from = a - p, d = b - a;
    double least = std::min(from.cwiseAbs().maxCoeff(), (b - p).cwiseAbs().maxCoeff());
    for (const double share : {-(from.x() - from.y()) / (d.x() - d.y()), -(from.x() + from.y()) / (d.x() + d.y()),
                               -from.x() / d.x(), -from.y() / d.y()})
      if (std::isfinite(share) && share > 0 && share < 1)
        least = std::min(least, (from + share * d).cwiseAbs().maxCoeff());
    return least;
  }
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> edges_, walls_;
};

}  // namespace

bool is_doubtful(const PlanRoom& room) {
  constexpr double doubtful = 0.5;
  return room.confidence >= 0 && room.confidence < doubtful;
}

std::string confidence_text(const PlanRoom& room) { return fmt::format("confidence {:.2f}", room.confidence); }

LabelPlace label_place(const PlanPolygon& room, const Eigen::Vector2d& size, const std::vector<PlanWall>& walls) {
  constexpr int steps = 40;
  constexpr double roomy = 1.4;  // beyond this, the middle counts more than more room
  const Clearance clearance(room, walls, 0.5 * size);
  Bounds2 box;
  for (const auto& p : room.outline) box.add(p);
  const Eigen::Vector2d centre = 0.5 * (box.low + box.high);
  LabelPlace best;
  double best_score = 0;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= steps; ++j) {
      const Eigen::Vector2d p = box.low + Eigen::Vector2d(i, j).cwiseProduct(box.size()) / steps;
      const double clear = clearance.at(p.cwiseQuotient(0.5 * size));
      const double score = std::min(clear, roomy) - 0.1 * (p - centre).norm() / box.size().norm();
      if (clear > 0 && score > best_score) {
        best_score = score;
        best = {p, std::min(1.0, clear)};
      }
    }
  return best;
}

}  // namespace atrium::floorplan
