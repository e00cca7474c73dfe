#include "modules/plane/assignment.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "modules/geometry/moments.hpp"

namespace atrium::plane {
namespace {

class Assigner {
 public:
  Assigner(const MortonOrder& order, const PointOctree& octree, const std::vector<Patch>& patches, std::size_t first,
           const Tolerance& tolerance, Assignment& assignment)
      : order_(order), octree_(octree), patches_(patches), tolerance_(tolerance), assignment_(assignment) {
    for (std::size_t k = 0; k < patches.size(); ++k) {
      planes_.push_back({patches[k].plane.normal.cast<float>(), static_cast<float>(patches[k].plane.offset)});
      if (k >= first) all_.push_back(static_cast<std::uint32_t>(k));
    }
  }

  void block(std::uint32_t root) const {
    const auto& nodes = octree_.nodes();
    std::vector<std::uint32_t> near, nearer;
    narrow(nodes[root], all_, near);
    for (std::uint32_t i = root; i < nodes[root].skip && !near.empty(); ++i) {
      if (!nodes[i].leaf) continue;
      narrow(nodes[i], near, nearer);
      for (const std::uint32_t k : nearer) leaf(nodes[i], k);
    }
  }

 private:
  /// The patches that points of the node may support.
  void narrow(const PointOctree::Node& node, const std::vector<std::uint32_t>& from,
              std::vector<std::uint32_t>& to) const {
    to.clear();
    for (const std::uint32_t k : from)
      if (!node.misses(planes_[k], tolerance_.distance) && !patches_[k].cells.misses(node.centre, node.half))
        to.push_back(k);
  }

  void leaf(const PointOctree::Node& node, std::uint32_t k) const {
    constexpr std::uint32_t batch = 32;
    const PointColumns& c = order_.columns;
    const Eigen::Vector3f normal = planes_[k].normal;
    const float offset = planes_[k].offset;
    const bool any_normal = tolerance_.min_cosine <= -1;
    float* const best = assignment_.distance.data();
    for (std::uint32_t begin = node.begin; begin < node.end; begin += batch) {
      const std::uint32_t count = std::min(batch, node.end - begin);
      std::array<float, batch> distance;
      for (std::uint32_t i = 0; i < count; ++i)
        distance[i] = std::abs(normal.x() * c.x[begin + i] +
                               (normal.y() * c.y[begin + i] + normal.z() * c.z[begin + i]) + offset);
      for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t p = begin + i;
        if (distance[i] > tolerance_.distance || distance[i] >= best[p]) continue;
        if (!any_normal && normal.dot(c.normal(p)) < tolerance_.min_cosine) continue;
        if (!patches_[k].cells.contains(c.point(p))) continue;
        best[p] = distance[i];
        assignment_.owner[p] = static_cast<std::int32_t>(k);
      }
    }
  }

  const MortonOrder& order_;
  const PointOctree& octree_;
  const std::vector<Patch>& patches_;
  Tolerance tolerance_;
  Assignment& assignment_;
  std::vector<FloatPlane> planes_;
  std::vector<std::uint32_t> all_;
};

}  // namespace

PlanePrimitive fit_primitive(const Cloud& cloud, std::vector<std::uint32_t> inliers, const Eigen::Vector3d& side) {
  PlanePrimitive primitive;
  const Eigen::Vector3d reference = cloud.points[inliers.front()].cast<double>();
  Moments moments;
  Eigen::Vector3d seen = Eigen::Vector3d::Zero();
  for (const std::uint32_t i : inliers) {
    moments.add(cloud.points[i].cast<double>() - reference);
    if (cloud.has_normals()) seen += cloud.normals[i].cast<double>();
  }
  const PlaneFit fit = fit_plane(moments);
  Eigen::Vector3d normal = fit.plane.normal;
  if (normal.dot(cloud.has_normals() ? seen : side) < 0) normal = -normal;
  primitive.plane = {normal, -normal.dot(fit.mean + reference)};
  primitive.residual = std::sqrt(fit.variances[0]);
  primitive.inliers = std::move(inliers);
  return primitive;
}

void Assignment::add(const MortonOrder& order, const PointOctree& octree, const std::vector<Patch>& patches,
                     std::size_t first, const Tolerance& tolerance, const Context& context) {
  const Assigner assigner(order, octree, patches, first, tolerance, *this);
  const auto& blocks = octree.blocks();
  context.parallel_for(
      blocks.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) assigner.block(blocks[i]);
      },
      4);
}

PlanePrimitives fit_primitives(const std::shared_ptr<const Cloud>& cloud, const MortonOrder& order,
                               const std::vector<std::int32_t>& owner, const std::vector<Patch>& patches,
                               std::size_t min_points, const Context& context) {
  std::vector<std::int32_t> by_index(owner.size());
  context.parallel_for(owner.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) by_index[order.index[i]] = owner[i];
  });
  std::vector<std::vector<std::uint32_t>> inliers(patches.size());
  for (std::uint32_t i = 0; i < by_index.size(); ++i)
    if (by_index[i] >= 0) inliers[static_cast<std::size_t>(by_index[i])].push_back(i);

  std::vector<PlanePrimitive> fitted(patches.size());
  context.parallel_chunks(patches.size(), 1, [&](std::size_t k, std::size_t, std::size_t) {
    if (inliers[k].size() < std::max<std::size_t>(min_points, 3)) return;
    fitted[k] = fit_primitive(*cloud, std::move(inliers[k]), patches[k].plane.normal);
  });
  PlanePrimitives result;
  result.cloud = cloud;
  for (PlanePrimitive& primitive : fitted)
    if (!primitive.inliers.empty()) result.primitives.push_back(std::move(primitive));
  std::stable_sort(result.primitives.begin(), result.primitives.end(),
                   [](const auto& a, const auto& b) { return a.inliers.size() > b.inliers.size(); });
  return result;
}

}  // namespace atrium::plane
