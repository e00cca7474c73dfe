#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "graph/api/context.hpp"

namespace atrium {

/// A point found by a PointTree: its index in the cloud and the square of its distance, metres².
struct Neighbour {
  std::uint32_t index = 0;
  float squared_distance = 0;
  friend bool operator<(const Neighbour& a, const Neighbour& b) {
    return a.squared_distance != b.squared_distance ? a.squared_distance < b.squared_distance : a.index < b.index;
  }
  friend bool operator==(const Neighbour&, const Neighbour&) = default;
};

/// Nearest neighbours of any position in a cloud of any density: a balanced k-d tree (Bentley 1975), packed into
/// eight-fold nodes of bounding boxes. Clusters, duplicates by the thousand and wild outliers cost no more than their
/// share. Equal distances go by index, so answers never depend on threads. Queries are const and may run side by side;
/// they are fastest in the order of order(), where one finds what the one before has brought near.
class PointTree {
 public:
  static constexpr float everywhere = std::numeric_limits<float>::infinity();

  PointTree() = default;
  /// Fewer than 2³² - 1 finite points (throws Error otherwise); none is allowed: nothing is found then. Keeps a copy.
  PointTree(const std::vector<Eigen::Vector3f>& points, const Context& context);

  std::size_t size() const { return order_.size(); }
  /// The indices of the points in the order of the leaves: what is near in space is near in it.
  const std::vector<std::uint32_t>& order() const { return order_; }

  /// The nearest point at a distance of at most max_distance (metres). Returns false where there is none.
  bool nearest(const Eigen::Vector3f& position, Neighbour& result, float max_distance = everywhere) const;
  /// The k nearest points within max_distance, by (distance, index). A point of the cloud finds itself, at 0.
  void k_nearest(const Eigen::Vector3f& position, std::size_t k, std::vector<Neighbour>& result,
                 float max_distance = everywhere) const;
  /// All points within max_distance, in no particular (but always the same) order.
  void within(const Eigen::Vector3f& position, float max_distance, std::vector<Neighbour>& result) const;

  /// For several positions in a box: the numbers of the lowest nodes with points within max_distance of it. Returns
  /// false, with a part of them, if they are more than `most`.
  bool nodes_near(const Eigen::AlignedBox3f& box, float max_distance, std::size_t most,
                  std::vector<std::uint32_t>& result) const;
  /// The squares of all distances up to max_distance to the points of these nodes, metres², in no particular order.
  void squared_distances(const Eigen::Vector3f& position, float max_distance, const std::vector<std::uint32_t>& nodes,
                         std::vector<float>& result) const;

  /// Whether at least `count` points (a point of the cloud counts itself) lie within max_distance of a position near
  /// leaf `near`: the points there are looked at first, so where there are plenty the answer is quick.
  bool has_within(const Eigen::Vector3f& position, float max_distance, std::size_t count, std::size_t near) const;

  static constexpr std::size_t fan = 8;
  /// Leaf l holds the points order()[fan · l] … order()[fan · l + fan - 1].
  struct Leaf {
    float x[fan], y[fan], z[fan];  // infinity behind the last point
  };
  struct Node {
    float low[3][fan], high[3][fan];  // the boxes of eight children; infinity to -infinity: no child
  };

 private:
  void sort(const std::vector<Eigen::Vector3f>& points, const Context& context);
  void build(const std::vector<Eigen::Vector3f>& points, const Context& context);
  bool gather(const Eigen::AlignedBox3f& box, float limit, std::size_t most, std::size_t level, std::size_t node,
              std::vector<std::uint32_t>& result) const;
  std::size_t count_in(std::size_t leaf, const Eigen::Vector3f& position, float limit) const;
  std::size_t count_below(std::size_t level, std::size_t node, const Eigen::Vector3f& position, float limit,
                          std::size_t enough, std::size_t but) const;
  template <class Search>
  void visit(Search& search, std::size_t level, std::size_t node) const;

  std::vector<std::uint32_t> order_;
  std::vector<Leaf> leaves_;
  std::vector<std::vector<Node>> levels_;  // levels_[0]: nodes over leaves; the last holds the root alone
};

}  // namespace atrium
