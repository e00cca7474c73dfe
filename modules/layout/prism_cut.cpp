#include "modules/layout/prism_cut.hpp"

#include <algorithm>
#include <cmath>

#include "modules/layout/hidden_walls.hpp"
#include "modules/layout/min_cut.hpp"
#include "modules/layout/room_cells.hpp"

namespace atrium::layout {
namespace {

class PrismEnergy {
 public:
  PrismEnergy(const PrismSpace& space, WallCover& walls, const PrismWeights& weights)
      : space_(space), walls_(walls), weights_(weights), first_(first_elements(space)), cut_(first_.back() + 1) {}

  std::vector<std::vector<bool>> solve() {
    cut_.add(outside(), 0, never);
    for (std::size_t c = 0; c < space_.stacks.size(); ++c) add_stack(c);
    for (std::size_t e = 0; e < space_.plan.edges.size(); ++e) add_edge(e);
    const std::vector<bool> labels = cut_.solve();
    std::vector<std::vector<bool>> result;
    for (std::size_t c = 0; c < space_.stacks.size(); ++c)
      result.emplace_back(labels.begin() + static_cast<std::ptrdiff_t>(first_[c]),
                          labels.begin() + static_cast<std::ptrdiff_t>(first_[c + 1]));
    return result;
  }

 private:
  static constexpr double never = 1e9;

  static std::vector<std::size_t> first_elements(const PrismSpace& space) {
    std::vector<std::size_t> first{0};
    for (const auto& stack : space.stacks) first.push_back(first.back() + stack.surfaces.size() + 1);
    return first;
  }
  std::size_t outside() const { return first_.back(); }
  std::size_t prisms(std::size_t cell) const { return space_.stacks[cell].surfaces.size() + 1; }

  /// What a vote against a prism counts where something was seen through it.
  double doubt(std::size_t cell, std::size_t prism) const {
    constexpr double sure = 0.6;
    const PrismStack& stack = space_.stacks[cell];
    return std::min(1.0, (1 - stack.free[prism]) / (1 - sure));
  }

  void add_stack(std::size_t c) {
    const PrismStack& stack = space_.stacks[c];
    const double area = space_.plan.cells[c].area;
    const std::size_t n = stack.surfaces.size();
    cut_.add(first_[c], 0, never);
    cut_.add(first_[c] + n, 0, n > 0 ? never : 0);
    for (std::size_t k = 1; k < n; ++k)
      cut_.add(first_[c] + k,
               (weights_.ceiling * stack.free[k] + weights_.floor * (stack.on_floor[k] + stack.free[k])) * area,
               weights_.outside * (1 - stack.free[k]) * area);
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t below = first_[c] + k, above = below + 1;
      const bool up = space_.surfaces[static_cast<std::size_t>(stack.surfaces[k])].up;
      const double seen = stack.cover[k];
      cut_.add(up ? below : above, 0, weights_.wall * seen * area * doubt(c, up ? k : k + 1));
      const double bare = area * (weights_.smoothness + weights_.complexity);
      const double shown = area * (weights_.smoothness * (1 - seen) + weights_.complexity);
      // Costs of (below outside, above inside) and of (below inside, above outside).
      cut_.add_pair(below, above, up ? shown : bare, up ? bare : shown);
    }
  }

  void add_edge(std::size_t index) {
    const CellEdge& edge = space_.plan.edges[index];
    const double length = (space_.plan.vertices[edge.to] - space_.plan.vertices[edge.from]).norm();
    if (edge.left < 0 || edge.right < 0) {
      const auto cell = static_cast<std::size_t>(std::max(edge.left, edge.right));
      for (std::size_t k = 1; k + 1 < prisms(cell); ++k) cut_.add(first_[cell] + k, 0, never);
      return;
    }
    const auto left = static_cast<std::size_t>(edge.left), right = static_cast<std::size_t>(edge.right);
    for (std::size_t a = 0; a < prisms(left); ++a)
      for (std::size_t b = 0; b < prisms(right); ++b) {
        if ((a == 0 || a + 1 == prisms(left)) && (b == 0 || b + 1 == prisms(right))) continue;
        const double height = common_height(space_, edge, a, b);
        if (height < one_height) continue;
        add_piece(index, {left, a}, {right, b}, length * height);
      }
  }

  using Prism = std::pair<std::size_t, std::size_t>;
  void add_piece(std::size_t edge, const Prism& left, const Prism& right, double area) {
    const double seen[2] = {walls_(edge, 0, left.second), walls_(edge, 1, right.second)};
    const std::size_t element[2] = {first_[left.first] + left.second, first_[right.first] + right.second};
    const Prism* behind[2] = {&right, &left};
    for (std::size_t side = 0; side < 2; ++side) {
      if (seen[side] <= 0) continue;
      cut_.add(element[side], weights_.wall * area * seen[side], 0);
      const double trust = is_narrow(behind[side]->first) ? 1 : doubt(behind[side]->first, behind[side]->second);
      cut_.add(element[1 - side], 0, weights_.wall * area * seen[side] * trust);
    }
    const auto cost = [&](double s) { return area * (weights_.smoothness * (1 - s) + weights_.complexity); };
    // Costs of (left outside, right inside) and of (left inside, right outside).
    cut_.add_pair(element[0], element[1], cost(seen[1]), cost(seen[0]));
  }

  bool is_narrow(std::size_t cell) const {
    constexpr double wide = 0.5;  // metres
    return width_of(space_.plan, space_.plan.cells[cell]) < wide;
  }

  const PrismSpace& space_;
  WallCover& walls_;
  const PrismWeights& weights_;
  std::vector<std::size_t> first_;
  MinCut cut_;
};

}  // namespace

std::vector<std::vector<bool>> inside_prisms(const PrismSpace& space, WallCover& walls, const PrismWeights& weights) {
  return PrismEnergy(space, walls, weights).solve();
}

}  // namespace atrium::layout
