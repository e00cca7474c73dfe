#include "modules/metric/rooms.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "modules/geometry/plan_overlay.hpp"
#include "modules/metric/outline_corners.hpp"

namespace atrium::metric {
namespace {

struct Room {
  PlanPolygon polygon;
  std::vector<Eigen::Vector2d> corners;
  double floor = 0;
  bool valid = true;
  double area() const { return valid ? overlay::area(polygon) : 0; }
};

Room room_of(const PlanPolygon& polygon, double floor, const std::string& what) {
  Room room;
  room.floor = floor;
  const auto check = [&](const PlanRing& ring) {
    for (const auto& p : ring)
      if (!p.allFinite()) throw Error(what + " has a corner that is not finite");
  };
  check(polygon.outline);
  for (const auto& hole : polygon.holes) check(hole);
  room.polygon = overlay::corrected(polygon);
  room.valid = polygon.outline.size() > 2 && overlay::is_valid(room.polygon);
  room.corners = corners_of(room.polygon.outline);
  return room;
}

// In the frame of `plan`, about its origin, both sides are compared. A point of another frame in it:
using ToPlan = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;

Room room_of(const std::vector<Eigen::Vector3d>& outline, const std::vector<std::vector<Eigen::Vector3d>>& holes,
             const ToPlan& to_plan, const std::string& what) {
  PlanPolygon polygon;
  double floor = 0;
  for (const auto& p : outline) {
    const Eigen::Vector3d place = to_plan(p);
    polygon.outline.emplace_back(place.head<2>());
    floor += place.z() / static_cast<double>(outline.size());
  }
  for (const auto& hole : holes) {
    polygon.holes.emplace_back();
    for (const auto& p : hole) polygon.holes.back().emplace_back(to_plan(p).head<2>());
  }
  return room_of(polygon, floor, what);
}

std::vector<Room> rooms_of(const FloorPlan& plan, const ToPlan& to_plan, const std::string& whose) {
  std::vector<Room> rooms;
  for (const auto& storey : plan.storeys)
    for (const auto& room : storey.rooms) {
      const auto raised = [&](const PlanRing& ring) {
        std::vector<Eigen::Vector3d> places;
        for (const auto& p : ring) places.push_back(plan.origin + Eigen::Vector3d(p.x(), p.y(), storey.elevation));
        return places;
      };
      std::vector<std::vector<Eigen::Vector3d>> holes;
      for (const auto& hole : room.polygon.holes) holes.push_back(raised(hole));
      rooms.push_back(room_of(raised(room.polygon.outline), holes, to_plan, whose + " '" + room.name + "'"));
    }
  return rooms;
}

std::vector<Room> rooms_of(const GroundTruth& truth, const FloorPlan& plan) {
  const ToPlan to_plan = [&](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    return plan.to_plan.rotation * (truth.origin + p) + plan.to_plan.translation - plan.origin;
  };
  std::vector<Room> rooms;
  for (const auto& room : truth.rooms)
    rooms.push_back(room_of(room.outline, {}, to_plan, "the true room '" + room.name + "'"));
  return rooms;
}

// From the true plan's frame back to the scan's, and on to the plan's; where both are turned alike, not at all, so that
// no number is rounded.
ToPlan between(const FloorPlan& from, const FloorPlan& plan) {
  const Transform &first = from.to_plan, &second = plan.to_plan;
  if (first.rotation == second.rotation && first.translation == second.translation)
    return [&plan](const Eigen::Vector3d& p) -> Eigen::Vector3d { return p - plan.origin; };
  return [&](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    const Eigen::Vector3d scan = first.rotation.transpose() * (p - first.translation);
    return second.rotation * scan + second.translation - plan.origin;
  };
}

double overlap_share(const Room& a, const Room& b) {
  const double both = overlay::area(overlay::intersection({a.polygon}, b.polygon));
  return both / (a.area() + b.area() - both);
}

struct Pair {
  double cost;
  std::size_t a, b;
  friend bool operator<(const Pair& p, const Pair& q) {
    if (p.cost != q.cost) return p.cost < q.cost;
    return p.a != q.a ? p.a < q.a : p.b < q.b;
  }
};
// The cheapest first, each member once.
std::vector<Pair> assigned(std::vector<Pair> pairs, std::size_t size_a, std::size_t size_b) {
  std::sort(pairs.begin(), pairs.end());
  std::vector<bool> taken_a(size_a, false), taken_b(size_b, false);
  std::vector<Pair> result;
  for (const auto& p : pairs) {
    if (taken_a[p.a] || taken_b[p.b]) continue;
    taken_a[p.a] = taken_b[p.b] = true;
    result.push_back(p);
  }
  return result;
}

// Degrees, 0 to 360: the turn from the next side to the one before.
double inner_angle(const std::vector<Eigen::Vector2d>& ring, std::size_t i) {
  const Eigen::Vector2d next = ring[(i + 1) % ring.size()] - ring[i],
                        before = ring[(i + ring.size() - 1) % ring.size()] - ring[i];
  const double angle = std::atan2(next.x() * before.y() - next.y() * before.x(), next.dot(before));
  return (angle < 0 ? angle + 2 * std::numbers::pi : angle) * 180 / std::numbers::pi;
}

struct Score {
  std::size_t expected = 0, found = 0, matched = 0;
  double error = 0;
};

void report(Metrics& metrics, const std::string& name, const Score& s) {
  const auto add = [&](const char* key, double value) { metrics.values.push_back({name + "." + key, value, ""}); };
  const auto n = static_cast<double>(s.matched), all = static_cast<double>(s.expected),
             found = static_cast<double>(s.found);
  add("true", all);
  add("found", found);
  add("matched", n);
  if (s.found > 0) add("precision", n / found);
  if (s.expected > 0) add("recall", n / all);
  if (s.found + s.expected > 0) add("f1", 2 * n / (found + all));
}

void match_corners(const Room& found, const Room& expected, const Rooms::Params& params, Score& corners,
                   Score& angles) {
  std::vector<Pair> near;
  for (std::size_t i = 0; i < found.corners.size(); ++i)
    for (std::size_t k = 0; k < expected.corners.size(); ++k) {
      const double distance = (found.corners[i] - expected.corners[k]).norm();
      if (distance <= params.corner_distance) near.push_back({distance, i, k});
    }
  for (const auto& pair : assigned(near, found.corners.size(), expected.corners.size())) {
    ++corners.matched;
    corners.error += pair.cost;
    const double difference = std::abs(inner_angle(found.corners, pair.a) - inner_angle(expected.corners, pair.b));
    if (difference > params.max_angle) continue;
    ++angles.matched;
    angles.error += difference;
  }
}

double total_area(const std::vector<Room>& rooms) {
  double sum = 0;
  for (const auto& r : rooms) sum += r.area();
  return sum;
}

std::vector<Pair> match_rooms(const std::vector<Room>& found, const std::vector<Room>& expected,
                              const Rooms::Params& params) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < found.size(); ++i)
    for (std::size_t k = 0; k < expected.size(); ++k) {
      if (!found[i].valid || !expected[k].valid) continue;
      if (std::abs(found[i].floor - expected[k].floor) > params.max_height) continue;
      const double share = overlap_share(found[i], expected[k]);
      if (share > params.min_iou) pairs.push_back({-share, i, k});
    }
  return assigned(pairs, found.size(), expected.size());
}

}  // namespace

Rooms::Out Rooms::run(const In& in, const Params& params, Context& context) {
  if (static_cast<bool>(in.truth) == static_cast<bool>(in.true_plan))
    throw Error(in.truth ? "both truth and true_plan are wired" : "neither truth nor true_plan is wired",
                "wire one of them: truth of a simulated scene or a layout, or a plan");
  const FloorPlan& plan = *in.plan;
  const auto expected =
      in.truth ? rooms_of(*in.truth, plan) : rooms_of(*in.true_plan, between(*in.true_plan, plan), "the true room");
  const auto found = rooms_of(plan, between(plan, plan), "the room");
  if (expected.empty()) throw Error("the truth has no rooms: nothing to compare with");
  for (const auto* side : {&found, &expected}) {
    const auto broken = std::count_if(side->begin(), side->end(), [](const Room& r) { return !r.valid; });
    if (broken > 0)
      context.warn(std::to_string(broken) + (side == &found ? " rooms of the plan" : " true rooms") +
                   " are no simple polygon: they match nothing");
  }
  Score rooms{expected.size(), found.size()}, corners, angles;
  for (const auto& r : found) corners.found += r.corners.size();
  for (const auto& r : expected) corners.expected += r.corners.size();
  angles = corners;
  for (const auto& pair : match_rooms(found, expected, params)) {
    ++rooms.matched;
    rooms.error -= pair.cost;
    match_corners(found[pair.a], expected[pair.b], params, corners, angles);
  }
  Out out;
  const auto mean = [&](const char* name, const Score& s, const char* unit) {
    if (s.matched > 0) out.metrics.values.push_back({name, s.error / static_cast<double>(s.matched), unit});
  };
  report(out.metrics, "rooms", rooms);
  mean("rooms.iou", rooms, "");
  out.metrics.values.push_back({"rooms.area.true", total_area(expected), "m2"});
  out.metrics.values.push_back({"rooms.area.found", total_area(found), "m2"});
  report(out.metrics, "rooms.corners", corners);
  mean("rooms.corners.error", corners, "m");
  report(out.metrics, "rooms.angles", angles);
  mean("rooms.angles.error", angles, "deg");
  return out;
}

}  // namespace atrium::metric
