#include "modules/layout/heights.hpp"

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <cmath>
#include <limits>
#include <map>

#include "modules/layout/coverage.hpp"
#include "modules/layout/inferred_ceilings.hpp"
#include "modules/layout/min_cut.hpp"
#include "modules/layout/raster.hpp"

namespace atrium::layout {
namespace {

constexpr double none = 1e6;  // the cost of what must not be

/// One labelling: the cells of all rooms of a storey by surfaces.
class Labelling {
 public:
  /// `slack`: heights that differ by less are one, metres.
  Labelling(const StoreyCells& storey, const std::vector<CellSurface>& surfaces, double slack,
            const Heights::Params& params)
      : storey_(storey), surfaces_(surfaces), slack_(slack), params_(params) {
    for (std::size_t i = 0; i < storey.cells.size(); ++i) {
      element_.push_back(storey.cells[i].room < 0 ? -1 : static_cast<int>(cells_.size()));
      if (storey.cells[i].room >= 0) cells_.push_back(i);
    }
    costs_.assign(cells_.size(), std::vector<double>(surfaces.size(), 0));
  }

  /// `covers`: of each cell. What a surface leaves uncovered costs its area, less where the surface that was seen is
  /// near: uneven ceilings are one. Pairs that `forbidden(cell, surface)` rejects are chosen only where all are
  /// rejected.
  template <class Covers, class Forbidden>
  void set_costs(Covers covers, Forbidden forbidden) {
    for (std::size_t e = 0; e < cells_.size(); ++e) {
      const LayoutCell& cell = storey_.cells[cells_[e]];
      const Eigen::Vector2d middle = middle_of(storey_, cell);
      for (std::size_t s = 0; s < surfaces_.size(); ++s) {
        for (const CellCover& cover : covers(cell))
          costs_[e][s] += cell.area * cover.share * misfit(s, static_cast<std::size_t>(cover.surface), middle);
        // What nothing shows costs a little, so that inferred surfaces and far ones give way.
        costs_[e][s] += surfaces_[s].primitive < 0 ? 0.01 * cell.area : 0;
        // A slope that goes on where it was not seen is soon far from what is there.
        constexpr double sloping_on = 0.15;
        if (!is_level(surfaces_[s].plane)) costs_[e][s] += sloping_on * cell.area * (1 - share_of(covers(cell), s));
        if (forbidden(cell, s)) costs_[e][s] += none;
      }
    }
  }

  /// Where a room has a surface of its own, by room, which was not seen: others are only where they cover most, and if
  /// they cover two square metres of it.
  template <class Covers>
  void prefer(const std::map<std::int32_t, std::int32_t>& inferred, Covers covers) {
    constexpr double least_seen = 2;                              // square metres
    std::map<std::pair<std::int32_t, std::size_t>, double> seen;  // of a room's surface
    for (const auto c : cells_)
      for (const CellCover& cover : covers(storey_.cells[c]))
        seen[{storey_.cells[c].room, static_cast<std::size_t>(cover.surface)}] += storey_.cells[c].area * cover.share;
    for (std::size_t e = 0; e < cells_.size(); ++e) {
      const LayoutCell& cell = storey_.cells[cells_[e]];
      const auto own = inferred.find(cell.room);
      for (std::size_t s = 0; s < surfaces_.size(); ++s) {
        const bool is_own = own != inferred.end() && own->second == static_cast<std::int32_t>(s);
        if (own != inferred.end() && !is_own) costs_[e][s] = cell.area;
        if (own != inferred.end() && !is_own && seen[{cell.room, s}] < least_seen) costs_[e][s] += none;
        if (surfaces_[s].primitive < 0 && !is_own && (own != inferred.end() || is_of_a_room(inferred, s)))
          costs_[e][s] += none;
      }
      if (own == inferred.end()) continue;
      costs_[e][static_cast<std::size_t>(own->second)] = 0;
      for (const CellCover& cover : covers(cell)) {
        costs_[e][static_cast<std::size_t>(cover.surface)] -= cell.area * cover.share;
        costs_[e][static_cast<std::size_t>(own->second)] += cell.area * cover.share;
      }
    }
  }

  /// `covers`: as in set_costs.
  template <class Covers>
  std::vector<std::int32_t> solve(Covers covers) {
    labels_.assign(cells_.size(), 0);
    for (std::size_t e = 0; e < cells_.size(); ++e)
      labels_[e] = static_cast<std::size_t>(std::min_element(costs_[e].begin(), costs_[e].end()) - costs_[e].begin());
    constexpr int rounds = 10;
    for (int round = 0; round < rounds; ++round) {
      bool changed = false;
      for (std::size_t alpha = 0; alpha < surfaces_.size(); ++alpha) changed = expand(alpha) || changed;
      if (!changed) break;
    }
    for (std::size_t e = 0; e < cells_.size() && absorb(covers); ++e) continue;
    std::vector<std::int32_t> result(storey_.cells.size(), -1);
    for (std::size_t e = 0; e < cells_.size(); ++e) result[cells_[e]] = static_cast<std::int32_t>(labels_[e]);
    return result;
  }

 private:
  /// Cells of one surface that hang together within a room.
  struct Patch {
    double area = 0, seen = 0;
    std::map<std::size_t, double> beside;  // length of the border with another surface
  };

  using Patches = std::map<std::size_t, Patch>;
  using Sets = boost::disjoint_sets<std::size_t*, std::size_t*>;

  template <class Covers>
  Patches patches_of(Sets& sets, Covers covers) const {
    for (std::size_t e = 0; e < cells_.size(); ++e) sets.make_set(e);
    for (const auto& edge : storey_.edges)
      if (const auto [a, b] = elements(edge); a >= 0 && label(a) == label(b))
        sets.union_set(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
    Patches patches;
    for (std::size_t e = 0; e < cells_.size(); ++e) {
      Patch& patch = patches[sets.find_set(e)];
      const LayoutCell& cell = storey_.cells[cells_[e]];
      patch.area += cell.area;
      for (const CellCover& cover : covers(cell))
        patch.seen += cell.area * cover.share *
                      (1 - misfit(labels_[e], static_cast<std::size_t>(cover.surface), middle_of(storey_, cell)));
    }
    for (const auto& edge : storey_.edges) {
      const auto [a, b] = elements(edge);
      if (a < 0 || label(a) == label(b)) continue;
      const double length = (storey_.vertices[edge.to] - storey_.vertices[edge.from]).norm();
      patches[sets.find_set(static_cast<std::size_t>(a))].beside[label(b)] += length;
      patches[sets.find_set(static_cast<std::size_t>(b))].beside[label(a)] += length;
    }
    return patches;
  }

  /// The surface beside a patch that has the longest border with it.
  static std::size_t neighbour_of(const Patch& patch) {
    return std::max_element(patch.beside.begin(), patch.beside.end(),
                            [](const auto& a, const auto& b) { return a.second < b.second; })
        ->first;
  }

  /// The share of a surface's patches that shows it.
  double shown(std::size_t label, const Patches& patches) const {
    double area = 0, seen = 0;
    for (const auto& [first, patch] : patches) {
      if (labels_[first] != label) continue;
      area += patch.area;
      seen += patch.seen;
    }
    return area > 0 ? seen / area : 0;
  }

  /// A patch that shows too little of its surface to be one: a quarter, two fifths of it beside a surface that shows
  /// twice as much, or half of a small one; a small one beside an inferred surface never shows enough. Undersides of
  /// beams make such patches, where the ceiling over them was not seen.
  bool is_weak(std::size_t label, const Patch& patch, const Patches& patches) const {
    constexpr double hardly = 0.25, less = 0.4, half = 0.5;
    if (patch.beside.empty() || surfaces_[label].primitive < 0) return false;
    if (patch.area >= params_.min_patch)
      return patch.seen < hardly * patch.area ||
             (patch.seen < less * patch.area && patch.seen < half * patch.area * shown(neighbour_of(patch), patches));
    return patch.seen < half * patch.area ||
           std::any_of(patch.beside.begin(), patch.beside.end(),
                       [&](const auto& other) { return surfaces_[other.first].primitive < 0; });
  }

  /// Gives the smallest weak patch to the surface beside it with the longest border. False: there is none.
  template <class Covers>
  bool absorb(Covers covers) {
    if (params_.min_patch == 0) return false;
    std::vector<std::size_t> rank(cells_.size()), parent(cells_.size());
    Sets sets(rank.data(), parent.data());
    const Patches patches = patches_of(sets, covers);
    const Patches::value_type* least = nullptr;
    for (const auto& patch : patches)
      if (is_weak(labels_[patch.first], patch.second, patches) &&
          (least == nullptr || patch.second.area < least->second.area))
        least = &patch;
    if (least == nullptr) return false;
    const std::size_t to = neighbour_of(least->second);
    for (std::size_t e = 0; e < cells_.size(); ++e)
      if (sets.find_set(e) == least->first) labels_[e] = to;
    return true;
  }

  std::size_t label(int element) const { return labels_[static_cast<std::size_t>(element)]; }

  static bool is_of_a_room(const std::map<std::int32_t, std::int32_t>& inferred, std::size_t surface) {
    return std::any_of(inferred.begin(), inferred.end(),
                       [&](const auto& own) { return own.second == static_cast<std::int32_t>(surface); });
  }

  static double share_of(const std::vector<CellCover>& covers, std::size_t surface) {
    double share = 0;
    for (const CellCover& cover : covers) share += static_cast<std::size_t>(cover.surface) == surface ? cover.share : 0;
    return share;
  }

  /// How badly one surface stands for another at a place: 0 to 1.
  double misfit(std::size_t a, std::size_t b, const Eigen::Vector2d& p) const {
    constexpr double another = 0.5;  // metres
    if (a == b) return 0;
    const double apart = std::abs(surfaces_[a].height_at(p) - surfaces_[b].height_at(p)) - slack_;
    return std::clamp(apart / another, 0.0, 1.0);
  }

  /// Area of the step between two surfaces over an edge, and the border itself.
  double step(const CellEdge& edge, std::size_t a, std::size_t b) const {
    if (a == b) return 0;
    const Eigen::Vector2d& p = storey_.vertices[edge.from];
    const Eigen::Vector2d& q = storey_.vertices[edge.to];
    const double at_p = surfaces_[a].height_at(p) - surfaces_[b].height_at(p);
    const double at_q = surfaces_[a].height_at(q) - surfaces_[b].height_at(q);
    const double mean = at_p * at_q >= 0 ? std::abs(at_p + at_q) / 2
                                         : (at_p * at_p + at_q * at_q) / (2 * (std::abs(at_p) + std::abs(at_q)));
    const bool seen = edge.line >= 0 && !storey_.lines[static_cast<std::size_t>(edge.line)].primitives.empty();
    const double weight = params_.step_weight * (seen ? 0.5 : 1.0);
    return (q - p).norm() * (weight * mean + params_.border_weight);
  }

  double energy() const {
    double sum = 0;
    for (std::size_t e = 0; e < cells_.size(); ++e) sum += costs_[e][labels_[e]];
    for (const auto& edge : storey_.edges)
      if (const auto [a, b] = elements(edge); a >= 0)
        sum += step(edge, labels_[static_cast<std::size_t>(a)], labels_[static_cast<std::size_t>(b)]);
    return sum;
  }

  /// Of an edge within a room; −1 of others.
  std::pair<int, int> elements(const CellEdge& edge) const {
    if (edge.left < 0 || edge.right < 0) return {-1, -1};
    const auto l = static_cast<std::size_t>(edge.left);
    const auto r = static_cast<std::size_t>(edge.right);
    if (storey_.cells[l].room < 0 || storey_.cells[l].room != storey_.cells[r].room) return {-1, -1};
    return {element_[l], element_[r]};
  }

  /// Lets cells change to alpha where that lowers the energy.
  bool expand(std::size_t alpha) {
    MinCut cut(cells_.size());
    for (std::size_t e = 0; e < cells_.size(); ++e) cut.add(e, costs_[e][labels_[e]], costs_[e][alpha]);
    for (const auto& edge : storey_.edges) {
      const auto [i, k] = elements(edge);
      if (i < 0) continue;
      const auto a = static_cast<std::size_t>(i);
      const auto b = static_cast<std::size_t>(k);
      const double keep = step(edge, labels_[a], labels_[b]);
      const double only_b = step(edge, labels_[a], alpha);
      const double only_a = step(edge, alpha, labels_[b]);
      // keep = E(0,0), only_b = E(0,1), only_a = E(1,0), E(1,1) = 0 (Kolmogorov and Zabih 2004, with the pair's cost
      // not below 0 where heights break the triangle inequality).
      cut.add(a, keep, 0);
      cut.add(a, 0, only_a);
      cut.add(b, 0, -only_a);
      cut.add_pair(a, b, std::max(0.0, only_b + only_a - keep), 0);
    }
    const std::vector<std::size_t> before = labels_;
    const double cost = energy();
    const std::vector<bool> change = cut.solve();
    for (std::size_t e = 0; e < cells_.size(); ++e)
      if (change[e]) labels_[e] = alpha;
    if (energy() < cost - 1e-9) return true;
    labels_ = before;
    return false;
  }

  const StoreyCells& storey_;
  const std::vector<CellSurface>& surfaces_;
  double slack_;
  const Heights::Params& params_;
  std::vector<std::size_t> cells_;  // element -> cell
  std::vector<int> element_;        // cell -> element
  std::vector<std::vector<double>> costs_;
  std::vector<std::size_t> labels_;
};

/// The height of a ceiling over a floor in the middle of a cell.
double clearance(const StoreyCells& storey, const LayoutCell& cell, const CellSurface& floor,
                 const CellSurface& ceiling) {
  const Eigen::Vector2d middle = middle_of(storey, cell);
  return ceiling.height_at(middle) - floor.height_at(middle);
}

void settle(StoreyCells& storey, double slack, const Heights::Params& params) {
  Labelling floors(storey, storey.floors, slack, params);
  floors.set_costs(
      [](const LayoutCell& cell) -> const auto& { return cell.floors; },
      [](const LayoutCell&, std::size_t) { return false; });
  const auto floor_of = floors.solve([](const LayoutCell& cell) -> const auto& { return cell.floors; });
  for (std::size_t i = 0; i < storey.cells.size(); ++i) storey.cells[i].floor = floor_of[i];
  const auto inferred = infer_ceilings(storey, params.min_seen);
  const auto covers = [](const LayoutCell& cell) -> const auto& { return cell.ceilings; };
  Labelling ceilings(storey, storey.ceilings, slack, params);
  ceilings.set_costs(covers, [&](const LayoutCell& cell, std::size_t s) {
    const auto& floor = storey.floors[static_cast<std::size_t>(cell.floor)];
    const bool covered = std::any_of(cell.ceilings.begin(), cell.ceilings.end(), [&](const auto& c) {
      return static_cast<std::size_t>(c.surface) == s && c.share > 0.5;
    });
    return !covered && clearance(storey, cell, floor, storey.ceilings[s]) < params.min_clearance;
  });
  ceilings.prefer(inferred, covers);
  const auto ceiling_of = ceilings.solve(covers);
  for (std::size_t i = 0; i < storey.cells.size(); ++i) storey.cells[i].ceiling = ceiling_of[i];
}

}  // namespace

Heights::Out Heights::run(const In& in, const Params& params, Context& context) {
  Out out{*in.cells};
  constexpr double levels_of_noise = 3;
  for (auto& storey : out.cells.storeys) {
    context.check_cancelled();
    settle(storey, levels_of_noise * out.cells.noise, params);
  }
  return out;
}

}  // namespace atrium::layout
