#include "modules/metric/openings.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>

#include "modules/geometry/plan_overlay.hpp"

namespace atrium::metric {
namespace {

using Outline = std::vector<Eigen::Vector3d>;

// Where the true wall is, and how to look at it.
struct Wall {
  Eigen::Vector3d place, normal, right, up;
  double thickness;

  explicit Wall(const Outline& outline, double depth)
      : place(outline.front()), normal(area_vector(outline).normalized()), thickness(depth) {
    right = normal.unitOrthogonal();
    up = normal.cross(right);
  }
  PlanPolygon projected(const Outline& outline) const {
    PlanPolygon polygon;
    for (const auto& p : outline) polygon.outline.emplace_back(right.dot(p - place), up.dot(p - place));
    return overlay::corrected(polygon);
  }
  // From the space between the wall's faces to the middle of the outline.
  double distance(const Outline& outline) const {
    double before = 0;
    for (const auto& p : outline) before += normal.dot(p - place) / static_cast<double>(outline.size());
    return std::max({0.0, before, -thickness - before});
  }
};

double shared(const PlanPolygon& a, const PlanPolygon& b) {
  const double both = overlay::area(overlay::intersection({a}, b));
  return both / (overlay::area(a) + overlay::area(b) - both);
}

bool is_simple(const Outline& outline, const std::string& what) {
  for (const auto& p : outline)
    if (!p.allFinite()) throw Error(what + " has a corner that is not finite");
  return outline.size() > 2 && area_vector(outline).norm() > 0 &&
         overlay::is_valid(Wall(outline, 0).projected(outline));
}

// Intersection over union as seen on the true wall; 0 where the planes do not fit.
double overlap(const Outline& found, const TrueOpening& expected, const Openings::Params& params) {
  const Wall wall(expected.outline, expected.thickness);
  const double cosine = std::cos(params.max_angle * std::numbers::pi / 180);
  if (std::abs(area_vector(found).normalized().dot(wall.normal)) < cosine) return 0;
  if (wall.distance(found) > params.max_distance) return 0;
  return shared(wall.projected(found), wall.projected(expected.outline));
}

struct Found {
  const BuildingOpening* opening;
  std::vector<Outline> sides;  // simple ones
};

std::vector<Found> openings_of(const Building& building, const Context& context) {
  std::vector<Found> result;
  std::size_t broken = 0;
  for (const auto& opening : building.openings) {
    Found found{&opening, {}};
    for (const auto* outline : {&opening.outline_a, &opening.outline_b})
      if (!outline->empty() && is_simple(*outline, "opening " + std::to_string(result.size())))
        found.sides.push_back(*outline);
    broken += found.sides.empty() ? 1 : 0;
    result.push_back(std::move(found));
  }
  if (broken > 0) context.warn(std::to_string(broken) + " openings are no simple polygon: they match nothing");
  return result;
}

struct OpeningPair {
  double share;
  std::size_t found, expected;
};

// The best first, each opening once.
std::vector<OpeningPair> assigned(std::vector<OpeningPair> pairs) {
  std::sort(pairs.begin(), pairs.end(), [](const OpeningPair& p, const OpeningPair& q) {
    return std::tuple(-p.share, p.found, p.expected) < std::tuple(-q.share, q.found, q.expected);
  });
  std::set<std::size_t> found, expected;
  std::erase_if(pairs, [&](const OpeningPair& p) {
    if (found.count(p.found) != 0 || expected.count(p.expected) != 0) return true;
    found.insert(p.found);
    expected.insert(p.expected);
    return false;
  });
  return pairs;
}

std::vector<OpeningPair> candidates(const std::vector<Found>& found, const std::vector<TrueOpening>& expected,
                                    const Openings::Params& params) {
  std::vector<OpeningPair> pairs;
  for (std::size_t i = 0; i < found.size(); ++i)
    for (std::size_t k = 0; k < expected.size(); ++k) {
      double share = 0;
      for (const auto& side : found[i].sides) share = std::max(share, overlap(side, expected[k], params));
      if (share > params.min_iou) pairs.push_back({share, i, k});
    }
  return pairs;
}

struct OpeningScore {
  std::size_t expected = 0, found = 0, matched = 0;
};

void report(Metrics& metrics, const std::string& name, const OpeningScore& s, bool counts) {
  const auto add = [&](const char* key, std::size_t over, double under) {
    metrics.values.push_back({name + "." + key, static_cast<double>(over) / under, ""});
  };
  if (counts) {
    add("true", s.expected, 1);
    add("found", s.found, 1);
  }
  add("matched", s.matched, 1);
  if (s.found > 0) add("precision", s.matched, static_cast<double>(s.found));
  if (s.expected > 0) add("recall", s.matched, static_cast<double>(s.expected));
  if (s.found + s.expected > 0) add("f1", 2 * s.matched, static_cast<double>(s.found + s.expected));
}

constexpr std::int32_t outside = -1, no_true_room = -2;

// Per room of the building the true room that it is; of two found rooms the one that has more of it.
std::vector<std::int32_t> true_rooms(const Building& building, const GroundTruth& truth) {
  constexpr double storey = 1, half = 0.5;
  std::vector<std::int32_t> result(building.rooms.size(), no_true_room);
  std::vector<double> share(truth.rooms.size(), half);
  std::vector<std::int32_t> best(truth.rooms.size(), -1);
  const Wall plan({Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()}, 0);
  for (std::size_t i = 0; i < result.size(); ++i) {
    const Outline& outline = building.rooms[i].outline;
    if (!is_simple(outline, "room " + std::to_string(i))) continue;
    for (std::size_t k = 0; k < truth.rooms.size(); ++k) {
      const Outline& expected = truth.rooms[k].outline;
      if (!is_simple(expected, "the true room '" + truth.rooms[k].name + "'")) continue;
      if (std::abs(outline.front().z() - expected.front().z()) > storey) continue;
      if (const double common = shared(plan.projected(outline), plan.projected(expected)); common > share[k]) {
        share[k] = common;
        best[k] = static_cast<std::int32_t>(i);
      }
    }
  }
  for (std::size_t k = 0; k < best.size(); ++k)
    if (best[k] >= 0) result[static_cast<std::size_t>(best[k])] = static_cast<std::int32_t>(k);
  return result;
}

// About the building's origin, in its frame.
GroundTruth placed(const GroundTruth& truth, const Transform& transform, const Eigen::Vector3d& origin) {
  GroundTruth result = transformed(truth, transform);
  const Eigen::Vector3d shift = result.origin - origin;
  for (auto& opening : result.openings)
    for (auto& p : opening.outline) p += shift;
  for (auto& room : result.rooms)
    for (auto& p : room.outline) p += shift;
  return result;
}

std::size_t joined_rightly(const std::vector<OpeningPair>& pairs, const Building& building, const GroundTruth& truth) {
  const auto rooms = true_rooms(building, truth);
  const auto room = [&](std::int32_t i) { return i < 0 || i >= std::ssize(rooms) ? outside : rooms[i]; };
  return static_cast<std::size_t>(std::count_if(pairs.begin(), pairs.end(), [&](const OpeningPair& p) {
    const auto& found = building.openings[p.found];
    const auto& expected = truth.openings[p.expected];
    return std::minmax({room(found.room_a), room(found.room_b)}) == std::minmax({expected.room_a, expected.room_b});
  }));
}

/// One walks through both; which is which is a matter of width.
std::string kind_of(const std::string& kind) { return kind == "passage" ? "door" : kind; }

}  // namespace

Openings::Out Openings::run(const In& in, const Params& params, Context& context) {
  const Building nothing;
  const Building& building = in.building ? *in.building : nothing;
  const GroundTruth truth = placed(*in.truth, in.transform ? *in.transform : Transform{}, building.origin);
  std::vector<TrueOpening> expected = truth.openings;
  for (const auto& opening : expected)
    if (!is_simple(opening.outline, "a true opening")) throw Error("a true opening is no simple polygon");
  const auto found = openings_of(building, context);
  const auto alike = candidates(found, expected, params);
  auto same_kind = alike;
  std::erase_if(same_kind, [&](const OpeningPair& p) {
    return kind_of(found[p.found].opening->kind) != kind_of(expected[p.expected].kind);
  });
  same_kind = assigned(same_kind);

  Out out;
  report(out.metrics, "openings", {expected.size(), found.size(), same_kind.size()}, true);
  std::map<std::string, OpeningScore> kinds;
  for (const auto& opening : expected) ++kinds[kind_of(opening.kind)].expected;
  for (const auto& opening : building.openings) ++kinds[kind_of(opening.kind)].found;
  for (const auto& pair : same_kind) ++kinds[kind_of(expected[pair.expected].kind)].matched;
  for (const auto& [kind, score] : kinds) report(out.metrics, "openings." + kind, score, true);
  report(out.metrics, "openings.any_kind", {expected.size(), found.size(), assigned(alike).size()}, false);
  if (same_kind.empty()) return out;
  double sum = 0;
  for (const auto& pair : same_kind) sum += pair.share;
  const auto n = static_cast<double>(same_kind.size());
  out.metrics.values.push_back({"openings.iou", sum / n, ""});
  out.metrics.values.push_back(
      {"openings.joined", static_cast<double>(joined_rightly(same_kind, building, truth)) / n, ""});
  return out;
}

}  // namespace atrium::metric
