#include "modules/plane/assignment.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "modules/geometry/moments.hpp"

namespace atrium::plane {
namespace {

class Assigner {
 public:
  Assigner(const MortonOrder& order, const PointOctree& octree, const std::vector<Patch>& patches,
           const Tolerance& tolerance, std::vector<std::int32_t>& owner)
      : order_(order), octree_(octree), patches_(patches), tolerance_(tolerance), owner_(owner) {
    for (const Patch& patch : patches)
      planes_.push_back({patch.plane.normal.cast<float>(), static_cast<float>(patch.plane.offset)});
  }

  void block(std::uint32_t root) const {
    const auto& nodes = octree_.nodes();
    std::vector<std::uint32_t> near;
    for (std::uint32_t k = 0; k < planes_.size(); ++k)
      if (!nodes[root].misses(planes_[k], tolerance_.distance)) near.push_back(k);
    std::vector<std::uint32_t> nearer;
    std::vector<float> best;
    for (std::uint32_t i = root; i < nodes[root].skip; ++i) {
      const PointOctree::Node& node = nodes[i];
      if (!node.leaf) continue;
      nearer.clear();
      for (const std::uint32_t k : near)
        if (!node.misses(planes_[k], tolerance_.distance)) nearer.push_back(k);
      best.assign(node.end - node.begin, std::numeric_limits<float>::infinity());
      for (const std::uint32_t k : nearer) leaf(node, k, best);
    }
  }

 private:
  void leaf(const PointOctree::Node& node, std::uint32_t k, std::vector<float>& best) const {
    const PointColumns& c = order_.columns;
    const FloatPlane& plane = planes_[k];
    for (std::uint32_t p = node.begin; p < node.end; ++p) {
      const float d = std::abs(plane.normal.dot(c.point(p)) + plane.offset);
      if (d > tolerance_.distance || d >= best[p - node.begin]) continue;
      if (plane.normal.dot(c.normal(p)) < tolerance_.min_cosine || !patches_[k].cells.contains(c.point(p))) continue;
      best[p - node.begin] = d;
      owner_[p] = static_cast<std::int32_t>(k);
    }
  }

  const MortonOrder& order_;
  const PointOctree& octree_;
  const std::vector<Patch>& patches_;
  Tolerance tolerance_;
  std::vector<std::int32_t>& owner_;
  std::vector<FloatPlane> planes_;
};

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

}  // namespace

std::vector<std::int32_t> assign_points(const MortonOrder& order, const PointOctree& octree,
                                        const std::vector<Patch>& patches, const Tolerance& tolerance,
                                        const Context& context) {
  std::vector<std::int32_t> owner(order.index.size(), -1);
  const Assigner assigner(order, octree, patches, tolerance, owner);
  const auto& blocks = octree.blocks();
  context.parallel_for(
      blocks.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) assigner.block(blocks[i]);
      },
      4);
  return owner;
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
