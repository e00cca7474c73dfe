#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace atrium {

/// Triangles ordered for exact ray casts and nearest-point queries (a bounding volume hierarchy, four children per
/// node, split by the surface area heuristic). Coordinates in any unit; results are exact to double rounding: single
/// precision only serves to skip boxes, and errs towards not skipping. Reading it from several threads is safe.
///
/// Triangles of no area are never hit by rays; their nearest point is that of their edges.
class TriangleTree {
 public:
  static constexpr std::uint32_t none = 0xffffffffU;

  TriangleTree() = default;
  /// Corners of triangle i are vertices[triangles[i]]. Indices must be valid and coordinates finite.
  TriangleTree(const std::vector<Eigen::Vector3d>& vertices,
               const std::vector<std::array<std::uint32_t, 3>>& triangles);

  bool empty() const { return triangles_.empty(); }

  struct Hit {
    std::uint32_t triangle = none;
    double distance = std::numeric_limits<double>::infinity();  ///< in lengths of `direction`
    bool front = false;  ///< the ray meets the side from which the corners run counter-clockwise
    explicit operator bool() const { return triangle != none; }
  };
  /// The first triangle along from + t · direction with 0 < t < limit. Ties: the least index.
  Hit cast(const Eigen::Vector3d& from, const Eigen::Vector3d& direction,
           double limit = std::numeric_limits<double>::infinity()) const;
  /// Whether any triangle is met with 0 < t < limit.
  bool blocked(const Eigen::Vector3d& from, const Eigen::Vector3d& direction, double limit) const;

  struct Nearest {
    std::uint32_t triangle = none;
    double squared_distance = std::numeric_limits<double>::infinity();
    explicit operator bool() const { return triangle != none; }
  };
  /// The nearest triangle with squared distance below `limit`. `hint` is a triangle that is likely near (the answer for
  /// the point before): it makes the search shorter and changes the distance never (the triangle only among equals).
  Nearest nearest(const Eigen::Vector3d& point, double limit = std::numeric_limits<double>::infinity(),
                  std::uint32_t hint = none) const;
  /// The same among the triangles that `accept(triangle)` lets pass.
  Nearest nearest_of(const Eigen::Vector3d& point, double limit,
                     const std::function<bool(std::uint32_t)>& accept) const;
  /// Appends every triangle with squared distance at most `limit`, in the tree's order.
  void within(const Eigen::Vector3d& point, double limit, std::vector<std::uint32_t>& found) const;

  /// Squared distance of a point to one triangle.
  double squared_distance(std::uint32_t triangle, const Eigen::Vector3d& point) const {
    return triangles_[slots_[triangle]].squared_distance(point);
  }

 private:
  struct Triangle {
    Eigen::Vector3d a, ab, ac;
    std::uint32_t index;
    bool thin;  ///< without an area to speak of: only its edges count
    double squared_distance(const Eigen::Vector3d& p) const;
    bool hit(const Eigen::Vector3d& from, const Eigen::Vector3d& direction, Hit& best) const;
  };
  using Lane = Eigen::Array<float, 4, 1>;
  /// Boxes of four children side by side. child: index of a node, or leaf_bit | first << 3 | count, or none.
  struct Node {
    std::array<Lane, 3> low, high;
    std::array<std::uint32_t, 4> child;
  };
  struct Ray;
  struct Builder;
  template <class Visit>
  void walk_ray(const Ray& ray, double& limit, Visit visit) const;
  template <class Visit>
  void walk_near(const Eigen::Vector3d& point, double& limit, Visit visit) const;

  std::vector<Node> nodes_;                           ///< nodes_[0] is the root
  std::vector<Triangle> triangles_;                   ///< in the order of the leaves
  std::vector<std::uint32_t> slots_;                  ///< place of each triangle in triangles_
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();  ///< of the boxes' coordinates
};

}  // namespace atrium
