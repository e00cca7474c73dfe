#include "modules/plane/plane_cells.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace atrium::plane {

PlaneCells::PlaneCells(const Eigen::Vector3d& normal, double reach) : tile_table_(64, absent) {
  // All points of a cell are within reach of each other.
  const double edge = reach / std::sqrt(2.0);
  const Eigen::Vector3d u = normal.unitOrthogonal();
  u_ = (u / edge).cast<float>();
  v_ = (normal.cross(u) / edge).cast<float>();
}

Eigen::Vector2f PlaneCells::position(const Eigen::Vector3f& p) const {
  constexpr float limit = 1e9F;  // cells further off than this share one
  return {std::clamp(u_.dot(p), -limit, limit), std::clamp(v_.dot(p), -limit, limit)};
}

PlaneCells::Index PlaneCells::index(const Eigen::Vector2f& at) {
  return {static_cast<std::int32_t>(std::floor(at.x())), static_cast<std::int32_t>(std::floor(at.y()))};
}

std::size_t PlaneCells::place_in_tile(Index i) {
  constexpr std::uint32_t mask = (1U << tile_bits) - 1;
  return (static_cast<std::uint32_t>(i.u) & mask) << tile_bits | (static_cast<std::uint32_t>(i.v) & mask);
}

std::uint64_t PlaneCells::tile_key(Index i) {
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(i.u >> tile_bits)) << 32U |
         static_cast<std::uint32_t>(i.v >> tile_bits);
}

std::uint32_t PlaneCells::add(const Eigen::Vector3f& p) {
  const Eigen::Vector2f at = position(p);
  const std::uint32_t cell = insert(index(at));
  if (cell == first_.size()) {
    first_.push_back(absent);
    filled_.push_back(0);
  }
  const auto part = [](float t) { return std::min(static_cast<unsigned>((t - std::floor(t)) * 8), 7U); };
  const std::uint64_t bit = 1ULL << (part(at.x()) * 8 + part(at.y()));
  if ((filled_[cell] & bit) == 0) {
    filled_[cell] |= bit;
    samples_.push_back({at, first_[cell]});
    first_[cell] = static_cast<std::uint32_t>(samples_.size() - 1);
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

std::size_t PlaneCells::slot(std::uint64_t tile) const {
  const std::size_t mask = tile_table_.size() - 1;
  std::size_t s = (tile * 0x9e3779b97f4a7c15ULL >> 32U) & mask;
  while (tile_table_[s] != absent && tile_keys_[tile_table_[s]] != tile) s = (s + 1) & mask;
  return s;
}

std::uint32_t PlaneCells::find(Index i) const {
  const std::uint32_t tile = tile_table_[slot(tile_key(i))];
  return tile == absent ? absent : cells_[tile * tile_cells + place_in_tile(i)];
}

std::uint32_t PlaneCells::insert(Index i) {
  const std::uint64_t key = tile_key(i);
  std::size_t s = slot(key);
  if (tile_table_[s] == absent) {
    if (2 * tile_keys_.size() >= tile_table_.size()) {
      grow();
      s = slot(key);
    }
    tile_table_[s] = static_cast<std::uint32_t>(tile_keys_.size());
    tile_keys_.push_back(key);
    cells_.resize(cells_.size() + tile_cells, absent);
  }
  std::uint32_t& cell = cells_[tile_table_[s] * tile_cells + place_in_tile(i)];
  if (cell == absent) {
    cell = static_cast<std::uint32_t>(indices_.size());
    indices_.push_back(i);
  }
  return cell;
}

void PlaneCells::grow() {
  tile_table_.assign(4 * tile_table_.size(), absent);
  for (std::uint32_t i = 0; i < tile_keys_.size(); ++i) tile_table_[slot(tile_keys_[i])] = i;
}

std::vector<std::uint32_t> PlaneCells::components() const {
  std::vector<std::uint32_t> parent(indices_.size());
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&](std::uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  // Half of the cells that are within reach, the nearest first: most of the others are connected through them then.
  constexpr std::array<std::array<std::int32_t, 2>, 10> steps{
      {{1, 0}, {0, 1}, {1, 1}, {1, -1}, {2, 0}, {0, 2}, {2, 1}, {1, 2}, {2, -1}, {1, -2}}};
  for (const auto& [du, dv] : steps)
    for (std::uint32_t i = 0; i < indices_.size(); ++i) {
      const std::uint32_t other = find({indices_[i].u + du, indices_[i].v + dv});
      if (other == absent) continue;
      const std::uint32_t a = root(i);
      const std::uint32_t b = root(other);
      if (a != b && linked(i, other)) parent[std::max(a, b)] = std::min(a, b);
    }
  for (std::uint32_t i = 0; i < indices_.size(); ++i) parent[i] = root(i);
  return parent;
}

PlaneCells PlaneCells::dilated(const std::vector<bool>& chosen) const {
  PlaneCells result;
  result.u_ = u_;
  result.v_ = v_;
  result.tile_table_.assign(64, absent);
  for (std::uint32_t i = 0; i < indices_.size(); ++i) {
    if (!chosen[i]) continue;
    for (std::int32_t du = -1; du <= 1; ++du)
      for (std::int32_t dv = -1; dv <= 1; ++dv) result.insert({indices_[i].u + du, indices_[i].v + dv});
  }
  return result;
}

}  // namespace atrium::plane
