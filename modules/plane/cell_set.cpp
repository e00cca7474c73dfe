#include "modules/plane/cell_set.hpp"

#include <Eigen/Geometry>

namespace atrium::plane {

CellFrame::CellFrame(const Eigen::Vector3d& normal, double edge) {
  const Eigen::Vector3d axis = normal.unitOrthogonal();
  u = (axis / edge).cast<float>();
  v = (normal.cross(axis) / edge).cast<float>();
}

std::uint32_t TileTable::insert(std::uint64_t key) {
  std::size_t s = slot(key);
  if (table_[s].tile != absent) return table_[s].tile;
  if (2 * keys_.size() >= table_.size()) {
    table_.assign(4 * table_.size(), {});
    for (std::uint32_t i = 0; i < keys_.size(); ++i) table_[slot(keys_[i])] = {keys_[i], i};
    s = slot(key);
  }
  table_[s] = {key, static_cast<std::uint32_t>(keys_.size())};
  keys_.push_back(key);
  return table_[s].tile;
}

CellSet::Rows& CellSet::rows(std::int32_t tile_u, std::int32_t tile_v) {
  const std::uint32_t tile = tiles_.insert(CellFrame::tile_key(tile_u, tile_v));
  if (tile == rows_.size()) {
    rows_.push_back({});
    low_ = {std::min(low_[0], tile_u), std::min(low_[1], tile_v)};
    high_ = {std::max(high_[0], tile_u), std::max(high_[1], tile_v)};
  }
  return rows_[tile];
}

void CellSet::add_dilated(std::int32_t tile_u, std::int32_t tile_v, const Rows& cells) {
  constexpr std::size_t edge = 1U << CellFrame::tile_bits;
  // With a rim of one cell: bit and row 0 belong to the tiles before, the last ones to those behind.
  std::array<std::uint32_t, edge + 2> wide{};
  for (std::size_t u = 0; u < edge; ++u) {
    const auto row = static_cast<std::uint32_t>(cells[u]);
    const std::uint32_t dilated = row | row << 1U | row << 2U;
    for (std::size_t k = 0; k < 3; ++k) wide[u + k] |= dilated;
  }
  for (std::size_t k = 0; k < wide.size(); ++k) {
    const std::int32_t u = tile_u + (k == 0 ? -1 : k == edge + 1 ? 1 : 0);
    const std::size_t row = (k + edge - 1) % edge;
    const std::uint32_t before = (wide[k] & 1U) << (edge - 1);
    const std::uint32_t here = wide[k] >> 1U & 0xffffU;
    const std::uint32_t behind = wide[k] >> (edge + 1);
    if (before != 0) rows(u, tile_v - 1)[row] |= static_cast<std::uint16_t>(before);
    if (here != 0) rows(u, tile_v)[row] |= static_cast<std::uint16_t>(here);
    if (behind != 0) rows(u, tile_v + 1)[row] |= static_cast<std::uint16_t>(behind);
  }
}

}  // namespace atrium::plane
