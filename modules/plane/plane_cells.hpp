#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "modules/types/plane_primitives.hpp"

namespace atrium::plane {

/// Square cells in a plane, on which connected components of its points are found (Schnabel et al., 4.4). Points nearer
/// to each other than `reach` are connected: the paper's bitmap would bridge gaps of up to twice its cells or not,
/// depending on where they lie. Only occupied cells take memory, so that neither the extent of the scene nor a far
/// outlier matters.
class PlaneCells {
 public:
  PlaneCells() = default;
  PlaneCells(const Eigen::Vector3d& normal, double reach);

  /// The number of the point's cell, made if it is new. Numbers count up from 0.
  std::uint32_t add(const Eigen::Vector3f& p);
  bool contains(const Eigen::Vector3f& p) const { return find(key(position(p))) != absent; }
  std::size_t size() const { return keys_.size(); }

  /// For each cell the number of its component.
  std::vector<std::uint32_t> components() const;
  /// The chosen cells and those that touch them.
  PlaneCells dilated(const std::vector<bool>& chosen) const;

 private:
  using Key = std::uint64_t;
  static constexpr std::uint32_t absent = 0xffffffff;
  static Key pack(std::int32_t u, std::int32_t v) {
    return static_cast<Key>(static_cast<std::uint32_t>(u)) << 32U | static_cast<std::uint32_t>(v);
  }
  static Key neighbour(Key key, std::int32_t du, std::int32_t dv) {
    return pack(static_cast<std::int32_t>(key >> 32U) + du, static_cast<std::int32_t>(key & 0xffffffffU) + dv);
  }
  /// A point for its surroundings of 1/8 of a cell: at most 64 in a cell however many points there are.
  struct Sample {
    Eigen::Vector2f at;  ///< in cells
    std::uint32_t next;  ///< of the same cell
  };
  Eigen::Vector2f position(const Eigen::Vector3f& p) const;
  static Key key(const Eigen::Vector2f& at);
  bool linked(std::uint32_t a, std::uint32_t b) const;
  std::uint32_t insert(Key key);
  std::uint32_t find(Key key) const;
  std::size_t slot(Key key) const;
  void grow();

  Eigen::Vector3f u_ = Eigen::Vector3f::UnitX();  ///< axes in the plane, in cells
  Eigen::Vector3f v_ = Eigen::Vector3f::UnitY();
  std::vector<Key> keys_;              ///< of the cells, in the order in which they were made
  std::vector<std::uint32_t> table_;   ///< open addressing: numbers of cells
  std::vector<std::uint32_t> first_;   ///< per cell: its first sample
  std::vector<std::uint64_t> filled_;  ///< per cell: which of its 8 × 8 parts have a sample
  std::vector<Sample> samples_;
  Key last_key_ = 0;
  std::uint32_t last_ = absent;
};

}  // namespace atrium::plane
