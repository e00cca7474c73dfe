#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>
#include <set>

#include "modules/synth/plan.hpp"
#include "modules/synth/stations.hpp"

namespace atrium::synth {
namespace {

using V = Eigen::Vector3d;
constexpr double cell = 0.1, carried = 1.4, clearance = 0.2, at_ease = 0.55, spacing = 0.1;
constexpr double unreachable = std::numeric_limits<double>::infinity();

Ring2 plan_of(const std::vector<V>& ring) {
  Ring2 plan;
  for (const auto& p : ring) plan.emplace_back(p.head<2>());
  return plan;
}

// The floors of one storey as a grid of places where somebody can walk.
class StoreyGrid {
 public:
  StoreyGrid(const SimulatedScene& scene, int storey, const TriangleTree& obstacles) {
    std::vector<std::pair<Ring2, double>> floors;  // outline, height
    for (const auto& room : scene.truth.rooms)
      if (room.storey == storey) floors.emplace_back(plan_of(room.outline), room.outline.front().z());
    for (const auto& opening : scene.truth.openings) add_passage(scene, opening, storey, floors);
    Eigen::Vector2d high = floors.front().first.front();
    low_ = high;
    for (const auto& [ring, z] : floors)
      for (const auto& p : ring) {
        low_ = low_.cwiseMin(p);
        high = high.cwiseMax(p);
      }
    columns_ = static_cast<int>(std::ceil((high.x() - low_.x()) / cell));
    rows_ = static_cast<int>(std::ceil((high.y() - low_.y()) / cell));
    places_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), V::Zero());
    clear_.assign(places_.size(), 0);
    for (int i = 0; i < std::ssize(places_); ++i) measure(i, floors, obstacles);
  }

  const V& place(int i) const { return places_[static_cast<std::size_t>(i)]; }
  struct Ways {
    std::vector<double> cost;
    std::vector<int> from;
  };
  /// The free cell nearest to a place, among those that `ways` lead to, if given; −1: none.
  int nearest(const V& p, const Ways* ways = nullptr) const {
    int best = -1;
    double least = unreachable;
    for (int i = 0; i < std::ssize(places_); ++i) {
      const auto k = static_cast<std::size_t>(i);
      if (clear_[k] < clearance || (ways != nullptr && ways->cost[k] == unreachable)) continue;
      const double d = (places_[k] - p).squaredNorm();
      if (d < least) {
        least = d;
        best = i;
      }
    }
    return best;
  }

  /// Ways to everywhere, rather through the middle of rooms and doors than along walls.
  Ways ways_from(int start) const {
    Ways ways{std::vector<double>(places_.size(), unreachable), std::vector<int>(places_.size(), -1)};
    std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> open;
    ways.cost[static_cast<std::size_t>(start)] = 0;
    open.emplace(0, start);
    while (!open.empty()) {
      const auto [cost, at] = open.top();
      open.pop();
      if (cost > ways.cost[static_cast<std::size_t>(at)]) continue;
      const int x = at % columns_, y = at / columns_;
      for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}) {
        if (x + dx < 0 || x + dx >= columns_ || y + dy < 0 || y + dy >= rows_) continue;
        const int to = (y + dy) * columns_ + x + dx;
        const double room = clear_[static_cast<std::size_t>(to)];
        if (room < clearance) continue;
        const double next = cost + std::hypot(dx, dy) * (1 + 4 * std::max(0.0, at_ease - room) / at_ease);
        if (next >= ways.cost[static_cast<std::size_t>(to)]) continue;
        ways.cost[static_cast<std::size_t>(to)] = next;
        ways.from[static_cast<std::size_t>(to)] = at;
        open.emplace(next, to);
      }
    }
    return ways;
  }

 private:
  static void add_passage(const SimulatedScene& scene, const TrueOpening& opening, int storey,
                          std::vector<std::pair<Ring2, double>>& floors) {
    if (opening.room_a < 0 || opening.room_b < 0 || opening.kind != "door") return;
    const auto &a = scene.truth.rooms[static_cast<std::size_t>(opening.room_a)],
               &b = scene.truth.rooms[static_cast<std::size_t>(opening.room_b)];
    if (a.storey != storey && b.storey != storey) return;
    const V normal = scene.truth.faces[static_cast<std::size_t>(opening.face_a)].plane.normal;
    double left = unreachable, right = -unreachable, sill = unreachable;
    const V along = V::UnitZ().cross(normal).normalized();
    for (const auto& p : opening.outline) {
      left = std::min(left, along.dot(p));
      right = std::max(right, along.dot(p));
      sill = std::min(sill, p.z());
    }
    const V level = V(normal.x(), normal.y(), 0).normalized();
    const auto corner = [&](double u, double depth) {
      const V p = along * u + level * (level.dot(opening.outline.front()) + depth);
      return Eigen::Vector2d(p.head<2>());
    };
    const double far = -opening.thickness - 0.05;
    floors.push_back({{corner(left, 0.05), corner(right, 0.05), corner(right, far), corner(left, far)}, sill});
  }

  void measure(int i, const std::vector<std::pair<Ring2, double>>& floors, const TriangleTree& obstacles) {
    const int column = i % columns_, row = i / columns_;
    const Eigen::Vector2d p = low_ + cell * Eigen::Vector2d(column + 0.5, row + 0.5);
    for (const auto& [ring, z] : floors) {
      if (!inside(ring, p)) continue;
      const V place(p.x(), p.y(), z + carried);
      const auto near = obstacles.nearest(place, 1);
      places_[static_cast<std::size_t>(i)] = place;
      clear_[static_cast<std::size_t>(i)] = near ? std::sqrt(near.squared_distance) : 1;
      return;
    }
  }

  Eigen::Vector2d low_;
  int columns_ = 0, rows_ = 0;
  std::vector<V> places_;
  std::vector<double> clear_;
};

// Goes from target to target, always to the nearest that is left.
class Walker {
 public:
  Walker(const SimulatedScene& scene, const TriangleTree& obstacles) : obstacles_(obstacles) {
    std::set<int> storeys;
    for (const auto& room : scene.truth.rooms) storeys.insert(room.storey);
    for (const int storey : storeys) grids_.emplace_back(scene, storey, obstacles);
  }

  std::vector<V> visit(const std::vector<V>& places) {
    std::vector<Target> targets;
    for (const auto& place : places) {
      const Target target = target_at(place);
      if (target.cell < 0) continue;
      // What is far from every floor's cells is on stairs: it leads from storey to storey.
      (target.off > 0.5 ? stairs_ : targets).push_back(target);
    }
    if (targets.empty()) return {places.front()};
    at_ = targets.front();
    path_ = {grid().place(at_.cell)};
    targets.erase(targets.begin());
    while (!targets.empty()) {
      const auto ways = grid().ways_from(at_.cell);
      const std::size_t next = nearest(targets, ways);
      if (cost(targets[next], ways) < unreachable)
        go(targets[next].cell, ways);
      else
        climb(targets[next], ways);
      at_ = targets[next];
      targets.erase(targets.begin() + static_cast<std::ptrdiff_t>(next));
    }
    return path_;
  }

 private:
  struct Target {
    V place;
    int grid = -1, cell = -1;
    double off = unreachable;  // from the cell
  };
  const StoreyGrid& grid() const { return grids_[static_cast<std::size_t>(at_.grid)]; }

  Target target_at(const V& place) const {
    Target best{place};
    for (int g = 0; g < std::ssize(grids_); ++g) {
      const auto& grid = grids_[static_cast<std::size_t>(g)];
      const int i = grid.nearest(place);
      if (i < 0 || (grid.place(i) - place).norm() >= best.off) continue;
      best = {place, g, i, (grid.place(i) - place).norm()};
    }
    return best;
  }
  double cost(const Target& target, const StoreyGrid::Ways& ways) const {
    return target.grid == at_.grid ? cell * ways.cost[static_cast<std::size_t>(target.cell)] : unreachable;
  }
  // What lies on another storey or behind a shut door comes last.
  std::size_t nearest(const std::vector<Target>& targets, const StoreyGrid::Ways& ways) const {
    std::size_t best = 0;
    double least = unreachable;
    for (std::size_t i = 0; i < targets.size(); ++i) {
      double far = cost(targets[i], ways);
      if (far == unreachable) far = 1e3 + (targets[i].place - path_.back()).norm();
      if (far >= least) continue;
      least = far;
      best = i;
    }
    return best;
  }
  void go(int to, const StoreyGrid::Ways& ways) {
    std::vector<V> back;
    for (int i = to; i >= 0; i = ways.from[static_cast<std::size_t>(i)]) back.push_back(grid().place(i));
    path_.insert(path_.end(), back.rbegin(), back.rend());
  }
  // Over the first stairs that both storeys see; without stairs the walk goes on there as if begun anew.
  void climb(const Target& target, const StoreyGrid::Ways& ways) {
    const auto& other = grids_[static_cast<std::size_t>(target.grid)];
    const auto onwards = other.ways_from(target.cell);
    for (const auto& step : stairs_) {
      const int foot = grid().nearest(step.place, &ways), head = other.nearest(step.place, &onwards);
      if (foot < 0 || head < 0) continue;
      const V &below = grid().place(foot), &above = other.place(head);
      if (obstacles_.blocked(below, step.place - below, 1) || obstacles_.blocked(step.place, above - step.place, 1))
        continue;
      go(foot, ways);
      path_.push_back(step.place);
      for (int i = head; i >= 0; i = onwards.from[static_cast<std::size_t>(i)]) path_.push_back(other.place(i));
      return;
    }
    path_.push_back(other.place(target.cell));
  }

  const TriangleTree& obstacles_;
  std::vector<StoreyGrid> grids_;
  std::vector<Target> stairs_;
  Target at_;
  std::vector<V> path_;
};

// Rounds corners off, then takes a place every 10 cm; where something is in the way it goes on behind that.
std::vector<V> evenly(const std::vector<V>& path, const TriangleTree& obstacles) {
  constexpr double gap = 0.5;  // longer steps are stairs, or lead nowhere
  std::vector<V> smooth = path;
  for (std::size_t i = 2; i + 2 < path.size(); ++i) {
    bool near = true;
    V sum = path[i];
    for (const std::size_t k : {i - 2, i - 1, i + 1, i + 2}) {
      near = near && (path[k] - path[i]).norm() < gap;
      sum += path[k];
    }
    if (near) smooth[i] = sum / 5;
  }
  std::vector<V> places{smooth.front()};
  for (std::size_t i = 1; i < smooth.size(); ++i) {
    const V step = smooth[i] - smooth[i - 1];
    if (step.norm() > gap && obstacles.blocked(smooth[i - 1], step, 1)) places.push_back(smooth[i]);
    while ((smooth[i] - places.back()).norm() >= spacing)
      places.push_back(places.back() + spacing * (smooth[i] - places.back()).normalized());
  }
  return places;
}

// A unit vector that turns slowly: three waves per coordinate over the whole walk.
class SlowDirection {
 public:
  explicit SlowDirection(Random& random) {
    for (auto& wave : waves_)
      for (int k = 0; k < 3; ++k) wave.push_back({random.normal(), random.uniform(0, 2 * std::numbers::pi)});
  }
  V at(double share) const {
    V v = V::Zero();
    for (int axis = 0; axis < 3; ++axis)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto& [size, phase] = waves_[static_cast<std::size_t>(axis)][k];
        v[axis] += size * std::sin(2 * std::numbers::pi * share * static_cast<double>(k + 1) / 3 + phase);
      }
    return v.norm() > 0 ? v.normalized() : V::UnitX();
  }

 private:
  std::array<std::vector<std::pair<double, double>>, 3> waves_;
};

}  // namespace

std::vector<Station> walk(const SimulatedScene& scene, const TriangleTree& obstacles, const Scan::Params& params,
                          Random random) {
  std::vector<V> targets;
  for (const auto& tripod : tripods(scene, params, random)) targets.push_back(tripod.place);
  if (targets.empty()) return {};
  const auto places = evenly(Walker(scene, obstacles).visit(targets), obstacles);
  const SlowDirection direction(random);
  std::vector<Station> stations;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(std::max<std::size_t>(1, places.size() - 1));
    Station station{places[i] + V(0, 0, 0.02 * std::sin(static_cast<double>(i)))};
    const V ahead = places[std::min(i + 3, places.size() - 1)] - places[i >= 3 ? i - 3 : 0];
    station.heading = V(ahead.x(), ahead.y(), 0).normalized();
    const Eigen::AngleAxisd turn(share * params.drift_angle * std::numbers::pi / 180, V::UnitZ());
    station.drift = Eigen::Translation3d(station.place + share * params.drift * direction.at(share)) * turn *
                    Eigen::Translation3d(-station.place);
    stations.push_back(station);
  }
  return stations;
}

}  // namespace atrium::synth
