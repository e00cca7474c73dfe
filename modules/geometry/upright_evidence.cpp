#include "modules/geometry/upright_evidence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "modules/geometry/upright_view.hpp"

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
  const double p = 0.55 * normal_density(h, 2.05, 0.06) + 0.10 * normal_density(h, 0.75, 0.08) + 0.35 / (high - low);
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
  void add(double height, double weight) {
    auto& step = steps_[static_cast<int>(height * 10)];
    step.first += weight;
    ++step.second;
  }
  double sum() const {
    constexpr double independent = 0.6;
    double all = 0;
    for (const auto& [height, step] : steps_)
      all += independent * step.first / step.second * (1 + std::log(step.second));
    return all;
  }

 private:
  std::map<int, std::pair<double, int>> steps_;  // by height in steps of 10 cm: sum of weights, number
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

void add_furniture(const UprightView& view, bool upwards, UprightEvidence& evidence) {
  Sightings sightings;
  const double area = view.piece() * view.piece();
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
      if (h > 0 && h < highest) sightings.add(column[i].block, h, area);
    }
  }
  constexpr double least = 0.06;  // square metres
  Steps steps;
  sightings.each(least, [&](double h) {
    steps.add(h, furniture_weight(h));
    evidence.furniture_seen += furniture_weight(h) > 0 ? 1 : 0;
  });
  evidence.furniture = std::clamp(steps.sum(), -2.0, 4.0);
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
  evidence.doors = std::clamp(steps.sum(), -1.0, 4.0);
}

/// What is neither wall nor main level, by how near it is to the floor and to the ceiling; and how much lies above a
/// level and how much below one.
void add_clutter(const UprightView& view, std::array<UprightEvidence, 2>& evidence) {
  double low = 0, high = 0, over = 0, under = 0;
  const double area = view.piece() * view.piece();
  constexpr double near = 1.0;
  for (std::size_t c = 0; c + 1 < view.columns().size(); ++c) {
    const Column column(view, c, true);
    for (std::size_t i = 0; i < column.size(); ++i) {
      if (column[i].main) continue;
      const double floor = column.over_floor(i), ceiling = column.under_ceiling(i);
      over += floor > 0 ? area : 0;
      under += ceiling > 0 ? area : 0;
      if (floor < 0 || ceiling < 0 || column[i].kind == Kind::wall) continue;
      low += floor < near ? area : 0;
      high += ceiling < near ? area : 0;
    }
  }
  constexpr double certain = 0.5;  // square metres: what is less says nothing
  const double clutter = std::clamp(1.2 * std::log((low + certain) / (high + certain)), -2.5, 2.5) / 2;
  const double all = over + under;
  const double floor = all > 0 ? 0.5 * std::log((over / all + 0.1) / (under / all + 0.1)) : 0;
  evidence[0].clutter = clutter;
  evidence[1].clutter = -clutter;
  evidence[0].floor = floor;
  evidence[1].floor = -floor;
}

/// Distances between main levels that face each other, one a column; rising. None if they lie over each other in few
/// columns: a table is no ceiling.
std::vector<double> gaps_of(const UprightView& view) {
  std::vector<double> gaps;
  constexpr double least = 0.3;  // of any unit: what is less is one surface or a step
  constexpr double least_share = 0.2;
  std::size_t levels = 0;
  for (std::size_t c = 0; c + 1 < view.columns().size(); ++c) {
    const Column column(view, c, true);
    double before = 0, widest = 0;
    bool any = false;
    for (std::size_t i = 0; i < column.size(); ++i) {
      if (!column[i].main || column[i].kind != Kind::level) continue;
      if (any) widest = std::max(widest, column.height(i) - before);
      before = column.height(i);
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
      main = main || (view.items()[i].main && view.items()[i].kind == Kind::level);
    covered += main ? 1 : 0;
  }
  return view.columns().size() > 1 ? covered / static_cast<double>(view.columns().size() - 1) : 0;
}

Axis look_along(const SurfacePieces& pieces, const UprightAxis& axis, double scale) {
  Axis result{axis, {}, {}, 0, 1};
  const UprightView view(pieces, axis.direction, scale);
  for (const bool upwards : {true, false}) {
    add_furniture(view, upwards, result.ways[upwards ? 0 : 1]);
    add_doors(view, upwards, result.ways[upwards ? 0 : 1]);
  }
  add_clutter(view, result.ways);
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
