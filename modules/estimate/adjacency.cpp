#include "modules/estimate/adjacency.hpp"

#include <Eigen/Geometry>

#include "modules/geometry/polygon_distance.hpp"

namespace atrium::estimate {
namespace {

Eigen::AlignedBox3d box_of(const PlaneMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const auto& corner : mesh.corners) box.extend(corner);
  return box;
}

}  // namespace

Adjacency::Out Adjacency::run(const In& in, const Params& params, Context& context) {
  const auto& meshes = in.meshes->meshes;
  std::vector<Eigen::AlignedBox3d> boxes;
  boxes.reserve(meshes.size());
  for (const auto& mesh : meshes) boxes.push_back(box_of(mesh));
  std::vector<std::vector<atrium::Adjacency::Edge>> found(meshes.size());
  context.parallel_for(
      meshes.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          for (std::size_t j = i + 1; j < meshes.size(); ++j) {
            if (boxes[i].exteriorDistance(boxes[j]) >= params.max_separation) continue;
            const double separation = polygon_distance(meshes[i].corners, meshes[j].corners);
            if (separation < params.max_separation) found[i].push_back({i, j, separation});
          }
        }
      },
      16);
  Out out;
  out.adjacency = atrium::Adjacency(meshes.size());
  for (const auto& edges : found)
    for (const auto& edge : edges) out.adjacency.connect(edge.a, edge.b, edge.separation);
  return out;
}

}  // namespace atrium::estimate
