#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace atrium::plane {

/// Square cells in a plane, in tiles of 16 × 16.
struct CellFrame {
  static constexpr std::int32_t tile_bits = 4;
  static constexpr std::size_t tile_cells = 1U << (2 * tile_bits);
  struct Index {
    std::int32_t u, v;
  };

  CellFrame() = default;
  CellFrame(const Eigen::Vector3d& normal, double edge);

  /// The point's coordinates in the plane, in cells. Those further off than 10⁹ cells share one.
  Eigen::Vector2f position(const Eigen::Vector3f& p) const { return {limited(u.dot(p)), limited(v.dot(p))}; }
  static float limited(float t) { return std::min(std::max(t, -1e9F), 1e9F); }
  static Index index(const Eigen::Vector2f& at) { return {floor(at.x()), floor(at.y())}; }
  static std::size_t place_in_tile(Index i) {
    constexpr std::uint32_t mask = (1U << tile_bits) - 1;
    return (static_cast<std::uint32_t>(i.u) & mask) << tile_bits | (static_cast<std::uint32_t>(i.v) & mask);
  }
  static std::uint64_t tile_key(std::int32_t tile_u, std::int32_t tile_v) {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(tile_u)) << 32U | static_cast<std::uint32_t>(tile_v);
  }
  static std::uint64_t tile_key(Index i) { return tile_key(i.u >> tile_bits, i.v >> tile_bits); }
  /// Without SSE 4.1 std::floor is a call.
  static std::int32_t floor(float t) {
    const auto whole = static_cast<std::int32_t>(t);
    return whole - static_cast<std::int32_t>(t < static_cast<float>(whole));
  }

  Eigen::Vector3f u = Eigen::Vector3f::UnitX();  ///< axes in the plane, in cells
  Eigen::Vector3f v = Eigen::Vector3f::UnitY();
};

/// Numbers the tiles that something is in, from 0 on in the order in which they were made.
class TileTable {
 public:
  static constexpr std::uint32_t absent = 0xffffffff;

  std::size_t size() const { return keys_.size(); }
  std::uint64_t key(std::size_t tile) const { return keys_[tile]; }
  std::uint32_t find(std::uint64_t key) const { return table_[slot(key)].tile; }
  /// The tile's number, made if it is new: then it is size() - 1.
  std::uint32_t insert(std::uint64_t key);

 private:
  struct Entry {
    std::uint64_t key = 0;
    std::uint32_t tile = absent;
  };
  std::size_t slot(std::uint64_t key) const {
    const std::size_t mask = table_.size() - 1;
    std::size_t s = (key * 0x9e3779b97f4a7c15ULL >> 32U) & mask;
    while (table_[s].tile != absent && table_[s].key != key) s = (s + 1) & mask;
    return s;
  }

  std::vector<std::uint64_t> keys_;
  std::vector<Entry> table_ = std::vector<Entry>(64);  ///< open addressing; its size is a power of two
};

/// Cells of a plane, a bit each.
class CellSet {
 public:
  CellSet() = default;
  explicit CellSet(const CellFrame& frame) : frame_(frame) {}

  bool contains(const Eigen::Vector3f& p) const { return contains(CellFrame::index(frame_.position(p))); }
  bool contains(CellFrame::Index i) const {
    constexpr std::int32_t mask = (1 << CellFrame::tile_bits) - 1;
    const std::uint32_t tile = tiles_.find(CellFrame::tile_key(i));
    return tile != TileTable::absent && (rows_[tile][static_cast<std::size_t>(i.u & mask)] >> (i.v & mask) & 1) != 0;
  }

  /// Whether no point of this box lies over any of them (true only if so): their tiles' bounds say it.
  bool misses(const Eigen::Vector3f& centre, const Eigen::Vector3f& half) const {
    constexpr float rim = 0.5F;  // of a tile, for what is rounded
    const auto beyond = [&](const Eigen::Vector3f& axis, std::size_t a) {
      const float scale = 1.0F / (1 << CellFrame::tile_bits);
      const float at = CellFrame::limited(axis.dot(centre)) * scale;
      const float reach = axis.cwiseAbs().dot(half) * scale + rim;
      return at + reach < static_cast<float>(low_[a]) || at - reach > static_cast<float>(high_[a]) + 1;
    };
    return beyond(frame_.u, 0) || beyond(frame_.v, 1);
  }

  /// The cells of a tile: a bit for each v in a row for each u.
  using Rows = std::array<std::uint16_t, 1U << CellFrame::tile_bits>;
  /// Puts in the cells of this tile and those that touch them.
  void add_dilated(std::int32_t tile_u, std::int32_t tile_v, const Rows& cells);

 private:
  Rows& rows(std::int32_t tile_u, std::int32_t tile_v);

  CellFrame frame_;
  TileTable tiles_;
  std::vector<Rows> rows_;  ///< per tile
  std::array<std::int32_t, 2> low_{std::numeric_limits<std::int32_t>::max(), std::numeric_limits<std::int32_t>::max()};
  std::array<std::int32_t, 2> high_{std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::min()};
};

}  // namespace atrium::plane
