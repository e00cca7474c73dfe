#include "modules/plane/plane_cells.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace atrium::plane {
namespace {

using Step = std::array<std::int32_t, 2>;
// Half of the cells within reach, the nearest first: most of the others are connected through them then.
constexpr std::array<Step, 4> near_steps{{{1, 0}, {0, 1}, {1, 1}, {1, -1}}};
constexpr std::array<Step, 6> far_steps{{{2, 0}, {0, 2}, {2, 1}, {1, 2}, {2, -1}, {1, -2}}};
constexpr std::size_t chunk_tiles = 32;

}  // namespace

/// The cells around those of a tile.
class PlaneCells::Neighbours {
 public:
  Neighbours(const PlaneCells& cells, std::uint32_t tile) {
    const std::uint64_t key = cells.tiles_.key(tile);
    const auto u = static_cast<std::int32_t>(key >> 32U);
    const auto v = static_cast<std::int32_t>(key & 0xffffffffU);
    for (std::int32_t du = -1; du <= 1; ++du)
      for (std::int32_t dv = -1; dv <= 1; ++dv)
        tiles_[place(du, dv)] = du == 0 && dv == 0 ? tile : cells.tiles_.find(CellFrame::tile_key(u + du, v + dv));
  }
  /// The tile of the cell at (u, v) from the tile's first one, at most a tile away; or absent.
  std::uint32_t tile(std::int32_t u, std::int32_t v) const {
    return tiles_[place(u >> CellFrame::tile_bits, v >> CellFrame::tile_bits)];
  }

 private:
  static std::size_t place(std::int32_t u, std::int32_t v) {
    const std::int32_t number = 3 * (u + 1) + v + 1;
    return static_cast<std::size_t>(number);
  }
  std::array<std::uint32_t, 9> tiles_{};
};

/// Disjoint sets of cells, named by their smallest member.
class PlaneCells::Forest {
 public:
  explicit Forest(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0U); }
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) { parent_[std::max(a, b)] = std::min(a, b); }
  std::vector<std::uint32_t> roots() {
    for (std::uint32_t i = 0; i < parent_.size(); ++i) parent_[i] = root(i);
    return parent_;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

// All points of a cell are within reach of each other.
PlaneCells::PlaneCells(const Eigen::Vector3d& normal, double reach)
    : frame_(normal, reach / std::sqrt(2.0)), cell_area_(reach * reach / 2) {}

std::uint32_t PlaneCells::add(const Eigen::Vector2f& at) {
  const CellFrame::Index i = CellFrame::index(at);
  const std::uint32_t cell = insert(i);
  const auto part = [](float t, std::int32_t whole) {
    return std::min(static_cast<std::uint32_t>(static_cast<std::int32_t>((t - static_cast<float>(whole)) * 8)), 7U);
  };
  const std::uint64_t bit = 1ULL << (part(at.x(), i.u) * 8 + part(at.y(), i.v));
  if ((filled_[cell] & bit) == 0) {
    filled_[cell] |= bit;
    samples_.push_back({at, first_[cell]});
    first_[cell] = static_cast<std::uint32_t>(samples_.size() - 1);
  }
  return cell;
}

std::uint32_t PlaneCells::insert(CellFrame::Index i) {
  const std::uint64_t key = CellFrame::tile_key(i);
  if (key != last_key_ || last_tile_ == absent) {
    last_key_ = key;
    last_tile_ = tiles_.insert(key);
    if (tiles_.size() * CellFrame::tile_cells > cells_.size())
      cells_.resize(tiles_.size() * CellFrame::tile_cells, absent);
    occupied_.resize(tiles_.size());
  }
  std::uint32_t& cell = cells_[last_tile_ * CellFrame::tile_cells + CellFrame::place_in_tile(i)];
  if (cell == absent) {
    cell = static_cast<std::uint32_t>(indices_.size());
    indices_.push_back(i);
    const std::size_t place = CellFrame::place_in_tile(i);
    occupied_[last_tile_][place / tile_edge] |= static_cast<std::uint16_t>(1U << (place % tile_edge));
    first_.push_back(absent);
    filled_.push_back(0);
  }
  return cell;
}

bool PlaneCells::linked(std::uint32_t a, std::uint32_t b) const {
  constexpr float reach_squared = 2;  // in cells
  for (std::uint32_t i = first_[a]; i != absent; i = samples_[i].next)
    for (std::uint32_t j = first_[b]; j != absent; j = samples_[j].next)
      if ((samples_[i].at - samples_[j].at).squaredNorm() <= reach_squared) return true;
  return false;
}

template <class Steps, class Visit>
void PlaneCells::visit_pairs(std::size_t begin, std::size_t end, const Steps& steps, Visit visit) const {
  constexpr auto edge = static_cast<std::int32_t>(tile_edge);
  for (std::size_t tile = begin; tile < end; ++tile) {
    const Neighbours around(*this, static_cast<std::uint32_t>(tile));
    for (std::int32_t u = 0; u < edge; ++u)
      for (std::uint32_t left = occupied_[tile][static_cast<std::size_t>(u)]; left != 0; left &= left - 1) {
        const std::int32_t v = __builtin_ctz(left);
        const std::uint32_t cell = at(static_cast<std::uint32_t>(tile), {u, v});
        for (const Step& step : steps) {
          const std::uint32_t tile_there = around.tile(u + step[0], v + step[1]);
          if (tile_there == absent) continue;
          const std::uint32_t other = at(tile_there, {u + step[0], v + step[1]});
          if (other != absent) visit(cell, other, tile_there);
        }
      }
  }
}

/// Joins linked cells that touch.
void PlaneCells::join_near(Forest& forest, const Context& context) const {
  const auto link = [&](std::uint32_t cell, std::uint32_t other) {
    const std::uint32_t a = forest.root(cell);
    const std::uint32_t b = forest.root(other);
    if (a != b && linked(cell, other)) forest.join(a, b);
  };
  // Within a chunk at once, as no other chunk knows its cells yet; across chunks afterwards.
  std::vector<Pairs> across((tiles_.size() + chunk_tiles - 1) / chunk_tiles);
  context.parallel_chunks(tiles_.size(), chunk_tiles, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    visit_pairs(begin, end, near_steps, [&](std::uint32_t cell, std::uint32_t other, std::uint32_t tile) {
      if (tile >= begin && tile < end) {
        link(cell, other);
      } else {
        across[chunk].emplace_back(cell, other);
      }
    });
  });
  for (const Pairs& pairs : across)
    for (const auto& [cell, other] : pairs) link(cell, other);
}

/// Joins linked cells that do not touch.
void PlaneCells::join_far(Forest& forest, const Context& context) const {
  const std::vector<std::uint32_t> so_far = forest.roots();
  std::vector<Pairs> found((tiles_.size() + chunk_tiles - 1) / chunk_tiles);
  context.parallel_chunks(tiles_.size(), chunk_tiles, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    visit_pairs(begin, end, far_steps, [&](std::uint32_t cell, std::uint32_t other, std::uint32_t) {
      if (so_far[cell] != so_far[other] && linked(cell, other)) found[chunk].emplace_back(cell, other);
    });
  });
  for (const Pairs& pairs : found)
    for (const auto& [cell, other] : pairs) forest.join(forest.root(cell), forest.root(other));
}

std::vector<std::uint32_t> PlaneCells::components(const Context& context) const {
  Forest forest(size());
  join_near(forest, context);
  join_far(forest, context);
  return forest.roots();
}

CellSet PlaneCells::dilated(const std::vector<bool>& chosen) const {
  CellSet result(frame_);
  for (std::uint32_t tile = 0; tile < tiles_.size(); ++tile) {
    CellSet::Rows rows{};
    bool any = false;
    for (std::size_t k = 0; k < CellFrame::tile_cells; ++k) {
      const std::uint32_t cell = cells_[tile * CellFrame::tile_cells + k];
      if (cell == absent || !chosen[cell]) continue;
      rows[k / tile_edge] |= static_cast<std::uint16_t>(1U << (k % tile_edge));
      any = true;
    }
    const std::uint64_t key = tiles_.key(tile);
    if (any) result.add_dilated(static_cast<std::int32_t>(key >> 32U), static_cast<std::int32_t>(key), rows);
  }
  return result;
}

}  // namespace atrium::plane
