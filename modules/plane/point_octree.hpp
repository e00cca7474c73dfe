#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "graph/api/context.hpp"
#include "modules/types/cloud.hpp"

namespace atrium::plane {

/// Points as float columns, in the order of a Morton curve, relative to the frame of a MortonOrder. A point that is
/// taken out gets the normal 0, so that no test on normals accepts it.
struct PointColumns {
  std::vector<float> x, y, z, nx, ny, nz;

  std::size_t size() const { return x.size(); }
  void resize(std::size_t count, bool normals = true);
  void copy(std::size_t to, const PointColumns& other, std::size_t from);
  void take_out(std::size_t i) { nx[i] = ny[i] = nz[i] = 0; }
  bool is_live(std::size_t i) const { return nx[i] != 0 || ny[i] != 0 || nz[i] != 0; }
  Eigen::Vector3f point(std::size_t i) const { return {x[i], y[i], z[i]}; }
  Eigen::Vector3f normal(std::size_t i) const { return {nx[i], ny[i], nz[i]}; }
};

/// A plane for tests against columns: a point at signed distance normal · x + offset.
struct FloatPlane {
  Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();
  float offset = 0;
};

/// When a point supports a plane: |distance| ≤ `distance` and normal · normal ≥ `min_cosine`.
struct Tolerance {
  float distance = 0.02F;
  float min_cosine = 0.7F;
};

/// A cloud along a Morton curve of cubic cells of edge `cell`, 21 bits an axis, in a frame whose origin is the median
/// of the points: a far outlier costs nothing (what lies beyond 2²⁰ cells is sorted as if it lay there).
struct MortonOrder {
  enum class Normals { no, yes };
  /// `back`: the cells are moved back by so much along all axes, metres; the frame stays.
  MortonOrder(const Cloud& cloud, double cell, const Context& context, Normals normals = Normals::no, double back = 0);

  double shift;
  Eigen::Vector3d centre;            ///< of the columns' frame, in the cloud's frame
  std::vector<std::uint64_t> codes;  ///< ascending
  std::vector<std::uint32_t> index;  ///< into the cloud
  PointColumns columns;              ///< with normals if asked: 0 where the cloud has none
};

/// Points of a leaf, at most: as many as are tested at once.
inline constexpr std::uint32_t octree_leaf_size = 32;

/// An octree over columns in Morton order, stored in preorder. Boxes are tight around the points, so that the planes
/// which miss a box are exact to find out.
class PointOctree {
 public:
  struct Node {
    Eigen::Vector3f centre = Eigen::Vector3f::Zero(), half = Eigen::Vector3f::Zero();  ///< its points' bounding box
    std::uint32_t begin = 0, end = 0;                                                  ///< its points
    std::uint32_t skip = 0;  ///< the next node that is not below this one
    std::uint32_t parent = 0;
    std::uint32_t level = 0;  ///< the edge of its cell is that of the finest cell times 2^level
    bool leaf = false;

    /// Whether no point of the box is within `distance` of the plane.
    bool misses(const FloatPlane& plane, float distance) const {
      const float d = plane.normal.dot(centre) + plane.offset;
      return std::abs(d) > distance + plane.normal.cwiseAbs().dot(half);
    }
  };

  PointOctree() = default;
  PointOctree(const PointColumns& columns, const std::vector<std::uint64_t>& codes, std::uint32_t leaf_size,
              const Context& context);

  const std::vector<Node>& nodes() const { return nodes_; }
  /// Roots of subtrees of some thousand points that together hold all points: pieces for parallel loops.
  const std::vector<std::uint32_t>& blocks() const { return blocks_; }

  /// Calls visit(begin, end) for the points of each leaf below `root` that the slab around the plane touches.
  template <class Visit>
  void visit_slab(std::uint32_t root, const FloatPlane& plane, float distance, Visit visit) const {
    const Eigen::Vector3f reach = plane.normal.cwiseAbs();
    const std::uint32_t end = nodes_[root].skip;
    for (std::uint32_t i = root; i < end;) {
      const Node& node = nodes_[i];
      const float d = plane.normal.dot(node.centre) + plane.offset;
      if (std::abs(d) > distance + reach.dot(node.half)) {
        i = node.skip;
      } else {
        if (node.leaf) visit(node.begin, node.end);
        ++i;
      }
    }
  }

 private:
  struct Range;
  void split(const std::vector<std::uint64_t>& codes, std::uint32_t leaf_size);
  void measure(const PointColumns& columns, const Context& context);

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> blocks_;
};

}  // namespace atrium::plane
