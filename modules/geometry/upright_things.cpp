#include "modules/geometry/upright_things.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

namespace atrium {
namespace {

using ViewItem = UprightView::Item;
using Kind = UprightView::Kind;

double normal_density(double x, double mean, double deviation) {
  const double z = (x - mean) / deviation;
  return std::exp(-0.5 * z * z) / (deviation * std::sqrt(2 * std::numbers::pi));
}

/// ln(p / q) of a height at which something free and level is found above a floor: furniture against anything.
double furniture_weight(double h) {
  constexpr double low = 0.15, high = 2.4;
  const double p = 0.25 * normal_density(h, 0.45, 0.05) + 0.30 * normal_density(h, 0.74, 0.04) +
                   0.10 * normal_density(h, 0.90, 0.04) + 0.20 * (h < 1.2 ? 1 / (1.2 - low) : 0) + 0.15 / (high - low);
  return std::clamp(std::log(p * (high - low)), -1.2, 1.5);
}

/// ln(p / q) of a height at which a wall begins: a door's head or a wall behind furniture against anything.
double door_weight(double h) {
  constexpr double low = 0.4, high = 3.0;
  const double p = 0.40 * normal_density(h, 2.05, 0.06) + 0.20 * normal_density(h, 0.75, 0.08) +
                   0.10 * normal_density(h, 0.45, 0.06) + 0.30 / (high - low);
  return std::clamp(std::log(p * (high - low)), -1.0, 1.5);
}

/// Independent sightings: one per square metre of plan and step of 10 cm, if large enough.
class Sightings {
 public:
  void add(std::uint32_t block, double height, double amount) {
    seen_.push_back({std::uint64_t{block} << 16 | static_cast<std::uint64_t>(std::clamp(height * 10, 0.0, 60000.0)),
                     height, amount});
  }
  /// Calls sighting(mean height) for each with at least this amount.
  template <class Sighting>
  void each(double least, const Sighting& sighting) {
    std::stable_sort(seen_.begin(), seen_.end(), [](const One& a, const One& b) { return a.key < b.key; });
    for (std::size_t i = 0; i < seen_.size();) {
      double amount = 0, sum = 0;
      const auto key = seen_[i].key;
      for (; i < seen_.size() && seen_[i].key == key; ++i)
        amount += seen_[i].amount, sum += seen_[i].amount * seen_[i].height;
      if (amount >= least) sighting(sum / amount);
    }
  }

 private:
  struct One {
    std::uint64_t key;
    double height, amount;
  };
  std::vector<One> seen_;
};

/// Adds up the weights of sightings. Those of one height say less and less (a beam or a shelf on all of a wall is one
/// thing, and so are the tables of a canteen): n of them count as 1 + ln n.
class Steps {
 public:
  void add(double height, double weight, double count = 1) {
    auto& step = steps_[static_cast<int>(height * 10)];
    step.first += weight * count;
    step.second += count;
  }
  double sum() const {
    constexpr double independent = 0.6;
    double all = 0;
    for (const auto& [height, step] : steps_)
      all += independent * step.first / std::max(1.0, step.second) * (1 + std::log(std::max(1.0, step.second)));
    return all;
  }

 private:
  std::map<int, std::pair<double, double>> steps_;  // by height in steps of 10 cm: sum of weights, number
};

/// The items of a column from bottom to top, whichever end is up. Heights grow upwards.
class Column {
 public:
  Column(const UprightView& view, std::size_t column, bool upwards)
      : begin_(view.columns()[column]), size_(view.columns()[column + 1] - begin_), view_(view), upwards_(upwards) {}
  std::size_t size() const { return size_; }
  const ViewItem& operator[](std::size_t i) const { return view_.items()[begin_ + (upwards_ ? i : size_ - 1 - i)]; }
  double height(std::size_t i) const { return upwards_ ? (*this)[i].height : -(*this)[i].height; }
  /// Height of item i above the floor below it, or −1.
  double over_floor(std::size_t i) const { return distance(i, upwards_); }
  double under_ceiling(std::size_t i) const { return distance(i, !upwards_); }

 private:
  double distance(std::size_t i, bool down) const {
    const auto& item = (*this)[i];
    const auto* level = down ? view_.below(item.block, item.height) : view_.above(item.block, item.height);
    return level == nullptr ? -1 : std::abs(static_cast<double>(item.height) - level->height);
  }
  std::size_t begin_, size_;
  const UprightView& view_;
  bool upwards_;
};

/// A piece of something level that is free above.
struct Spot {
  std::uint32_t column = 0;
  double height = 0;  ///< along the direction that is taken for up
  double over_floor = 0;
  bool between = false;  ///< a ceiling is known above it
};

std::vector<Spot> spots_of(const UprightView& view, bool upwards) {
  std::vector<Spot> spots;
  for (std::size_t c = 0; c + 1 < view.columns().size(); ++c) {
    const Column column(view, c, upwards);
    for (std::size_t i = 0; i < column.size(); ++i) {
      if (column[i].kind != Kind::level || column[i].main) continue;
      // Free above, but for what is the same surface.
      std::size_t next = i + 1;
      const double same = std::max(0.06, 1.5 * view.piece());
      constexpr double clear = 0.3;
      while (next < column.size() && column.height(next) < column.height(i) + same) ++next;
      if (next < column.size() && column.height(next) < column.height(i) + clear) continue;
      const double h = column.over_floor(i);
      constexpr double highest = 2.4;
      if (h > 0 && h < highest)
        spots.push_back({static_cast<std::uint32_t>(c), column.height(i), h, column.under_ceiling(i) > 0});
    }
  }
  return spots;
}

/// The numbers of connected surfaces that spots belong to: neighbours in plan, of about one height.
std::vector<std::uint32_t> surfaces_of(const UprightView& view, const std::vector<Spot>& spots) {
  std::vector<std::uint32_t> parent(spots.size());
  for (std::uint32_t i = 0; i < parent.size(); ++i) parent[i] = i;
  const auto root = [&](std::uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  constexpr double step = 0.08;  // metres
  const auto join = [&](std::uint32_t i, std::int64_t column) {
    auto other = std::lower_bound(spots.begin(), spots.end(), column,
                                  [](const Spot& s, std::int64_t wanted) { return s.column < wanted; });
    for (; other != spots.end() && other->column == column; ++other)
      if (std::abs(other->height - spots[i].height) < step)
        parent[root(static_cast<std::uint32_t>(other - spots.begin()))] = root(i);
  };
  for (std::uint32_t i = 0; i < spots.size(); ++i) {
    join(i, spots[i].column);
    for (const auto& [r, c] : {std::pair{0, 1}, {1, -1}, {1, 0}, {1, 1}})
      if (const std::int64_t at = view.neighbour(spots[i].column, r, c); at >= 0) join(i, at);
  }
  for (std::uint32_t i = 0; i < parent.size(); ++i) parent[i] = root(i);
  return parent;
}

/// A surface as a rectangle of the same moments.
struct Surface {
  double area = 0, over_floor = 0, length = 0, width = 0;
  double between = 0;  ///< share that has a ceiling above it
};

std::vector<Surface> tops_of(const UprightView& view, bool upwards) {
  const std::vector<Spot> spots = spots_of(view, upwards);
  const std::vector<std::uint32_t> parts = surfaces_of(view, spots);
  std::map<std::uint32_t, std::vector<std::uint32_t>> members;
  for (std::uint32_t i = 0; i < parts.size(); ++i) members[parts[i]].push_back(i);
  std::vector<Surface> result;
  for (const auto& [part, list] : members) {
    Surface s;
    const auto n = static_cast<double>(list.size());
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
    for (const auto i : list) {
      s.over_floor += spots[i].over_floor / n;
      s.between += spots[i].between ? 1 / n : 0;
      mean += view.place_of(spots[i].column) / n;
    }
    for (const auto i : list) {
      const Eigen::Vector2d d = view.place_of(spots[i].column) - mean;
      spread += d * d.transpose() / n;
    }
    s.area = n * view.piece() * view.piece();
    const double half = spread.trace() / 2, off = std::hypot((spread(0, 0) - spread(1, 1)) / 2, spread(0, 1));
    s.length = std::sqrt(12 * (half + off));
    s.width = std::sqrt(12 * std::max(0.0, half - off));
    result.push_back(s);
  }
  return result;
}

/// A beam, a duct or a sill runs through the room; furniture in one piece does not, but for worktops.
bool runs_through(const Surface& s) {
  constexpr double longest = 2.4, narrow = 0.8, low = 0.8, high = 1.0;
  return s.length > longest && s.width < narrow && (s.over_floor < low || s.over_floor > high);
}

void add_furniture(const UprightView& view, bool upwards, UprightEvidence& evidence) {
  constexpr double least = 0.08, most = 6;  // square metres: what is larger is a floor
  Steps steps;
  double seen = 0;
  for (const Surface& s : tops_of(view, upwards)) {
    if (s.area < least || s.area > most || runs_through(s)) continue;
    constexpr double each = 0.5;  // square metres that count as one sighting
    const double trust = 0.5 + 0.5 * s.between;
    steps.add(s.over_floor, trust * furniture_weight(s.over_floor), std::clamp(s.area / each, 0.3, 4.0));
    if (furniture_weight(s.over_floor) > 0) seen += s.area;
  }
  evidence.furniture = std::clamp(steps.sum(), -1.5, 4.0);
  evidence.furniture_seen = static_cast<int>(std::ceil(seen));
}

void add_doors(const UprightView& view, bool upwards, UprightEvidence& evidence) {
  Sightings sightings;
  const double width = std::max(0.15, 2 * view.piece());
  if (width > 0.4) return;  // too sparse to see a door
  for (std::size_t c = 0; c + 1 < view.columns().size(); ++c) {
    const Column column(view, c, upwards);
    for (std::size_t i = 0; i < column.size(); ++i) {
      if (column[i].kind != Kind::wall) continue;
      const double h = column.over_floor(i);
      constexpr double low = 0.4, high = 3.0, head = 0.3, slack = 0.15;
      if (h < low || h > high) break;
      // Nothing between the floor and here, and the wall goes on above.
      if (i > 0 && column.height(i - 1) > column.height(i) - h + slack) break;
      std::size_t wall = 0;
      for (std::size_t k = i; k < column.size() && column.height(k) < column.height(i) + head; ++k)
        wall += column[k].kind == Kind::wall ? 1 : 0;
      if (wall >= 2) sightings.add(column[i].block, h, width);
      break;
    }
  }
  constexpr double least = 0.3;  // metres of wall
  Steps steps;
  sightings.each(least, [&](double h) {
    steps.add(h, door_weight(h));
    evidence.doors_seen += door_weight(h) > 0 && h > 1.8 ? 1 : 0;
  });
  evidence.doors = std::clamp(0.7 * steps.sum(), -0.7, 3.0);
}

/// What lies at a low end and at a high one, square metres.
struct Ends {
  double low = 0, high = 0;
};

/// Plane things between a floor and a ceiling by how near they are to each. Slopes count at the other end: they are
/// roofs and vaults, not floors.
Ends clutter_of(const UprightView& view) {
  Ends ends;
  const double area = view.piece() * view.piece();
  constexpr double near = 1.0, slope = 0.5;  // metres, share of its area
  for (const auto& item : view.items()) {
    if (item.main || item.kind == Kind::wall) continue;
    const auto* below = view.below(item.block, item.height);
    const auto* above = view.above(item.block, item.height);
    if (below == nullptr || above == nullptr) continue;
    const bool low = static_cast<double>(item.height) - below->height < near;
    const bool high = above->height - static_cast<double>(item.height) < near;
    const bool turned = item.kind == Kind::other;
    ends.low += (turned ? high : low) ? (turned ? slope : 1) * area : 0;
    ends.high += (turned ? low : high) ? (turned ? slope : 1) * area : 0;
  }
  return ends;
}

/// The lowest and the highest 0.5 % of all pieces left out.
std::pair<double, double> extent_of(const UprightView& view) {
  std::vector<float> heights;
  heights.reserve(view.items().size());
  for (const auto& item : view.items()) heights.push_back(item.height);
  if (heights.empty()) return {0, 0};
  std::sort(heights.begin(), heights.end());
  const std::size_t off = heights.size() / 200;
  return {heights[off], heights[heights.size() - 1 - off]};
}

/// What is on no plane, in the lower half and in the upper one of a room (the ends of 1.2 m at most), first where its
/// floor and its ceiling are known, second where the scan's own end stands for one of them.
std::pair<Ends, Ends> rough_of(const UprightView& view) {
  const auto [bottom, top] = extent_of(view);
  Ends known, taken;
  const double area = view.piece() * view.piece();
  constexpr double edge = 0.12, headroom = 1.5, most = 1.2;  // metres
  for (const auto& item : view.items()) {
    if (item.kind != Kind::rough || item.main) continue;
    const auto* below = view.below(item.block, item.height);
    const auto* above = view.above(item.block, item.height);
    const double floor = static_cast<double>(item.height) - (below != nullptr ? below->height : bottom);
    const double ceiling = (above != nullptr ? above->height : top) - static_cast<double>(item.height);
    if (floor < edge || ceiling < edge || floor + ceiling < headroom) continue;
    const double half = std::min(most, (floor + ceiling) / 2);
    Ends& ends = below != nullptr && above != nullptr ? known : taken;
    ends.low += floor < half ? area : 0;
    ends.high += ceiling < half ? area : 0;
  }
  return {known, taken};
}

/// ln(p / q) of x = ln(low / high) of what is on no plane: along the vertical against across it, where neither end of a
/// room has more than the other.
double rough_weight(double x) {
  const double p = 0.85 * normal_density(x, 0.8, 0.8) + 0.15 * normal_density(x, 0, 1.5);
  const double q = 0.85 * normal_density(x, 0, 0.55) + 0.15 * normal_density(x, 0, 1.3);
  return std::clamp(std::log(p / q), -2.0, 3.0);
}

void add_rough(const UprightView& view, std::array<UprightEvidence, 2>& evidence) {
  const auto [known, taken] = rough_of(view);
  constexpr double end_of_scan = 0.5, certain = 0.5, enough = 2;  // weight, square metres, square metres
  const bool both = known.low + known.high >= (taken.low + taken.high) / 2;
  const Ends& ends = both ? known : taken;
  const double all = ends.low + ends.high, weight = (both ? 1 : end_of_scan) * all / (all + enough);
  const double x = std::log((ends.low + certain) / (ends.high + certain));
  evidence[0].rough = weight * rough_weight(x);
  evidence[1].rough = weight * rough_weight(-x);
}

/// How much more lies over a level than under one, as a share of both: 1 where no ceiling was seen, -1 where no floor.
double one_end_of(const UprightView& view) {
  double over = 0, under = 0;
  for (const auto& item : view.items()) {
    if (item.main) continue;
    over += view.below(item.block, item.height) != nullptr ? 1 : 0;
    under += view.above(item.block, item.height) != nullptr ? 1 : 0;
  }
  return over + under > 0 ? (over - under) / (over + under) : 0;
}

void add_clutter(const UprightView& view, std::array<UprightEvidence, 2>& evidence) {
  const Ends ends = clutter_of(view);
  constexpr double certain = 0.5, slope = 0.6, most = 1.25;  // square metres: what is less says nothing
  const double clutter = std::clamp(slope * std::log((ends.low + certain) / (ends.high + certain)), -most, most);
  evidence[0].clutter = clutter;
  evidence[1].clutter = -clutter;
}

/// Of scans that show one end only, one in seven shows the ceiling. All that tells the ways apart is about that end
/// then: it is never surer than this.
void add_floor(const UprightView& view, std::array<UprightEvidence, 2>& evidence) {
  const double one_end = one_end_of(view);
  constexpr double floors = 0.7, least = 0.04;
  evidence[0].floor = std::log(1 + floors * one_end);
  evidence[1].floor = std::log(1 - floors * one_end);
  const auto way = [](const UprightEvidence& e) { return e.furniture + e.doors + e.clutter + e.floor + e.rough; };
  const double apart = way(evidence[0]) - way(evidence[1]);
  const double doubt = std::max(1e-9, least * one_end * one_end), most = std::log((1 - doubt) / doubt);
  const double too_much = apart - std::clamp(apart, -most, most);
  evidence[0].bound = -too_much / 2;
  evidence[1].bound = too_much / 2;
}

}  // namespace

void add_things(const UprightView& view, std::array<UprightEvidence, 2>& evidence) {
  for (const bool upwards : {true, false}) {
    add_furniture(view, upwards, evidence[upwards ? 0 : 1]);
    add_doors(view, upwards, evidence[upwards ? 0 : 1]);
  }
  add_clutter(view, evidence);
  add_rough(view, evidence);
  add_floor(view, evidence);
}

}  // namespace atrium
