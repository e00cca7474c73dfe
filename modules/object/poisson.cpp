#include "modules/object/poisson.hpp"

#include <pcl/console/print.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <string>
#include <unordered_map>
#include <unordered_set>

// PCL's solver prints remarks about open edges to stdout, which belongs to the results of a run. It is all in headers,
// so it is compiled here without them (and only for the degree in use); these instances come before those in PCL's
// library.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#define printf(...) static_cast<void>(0)
// In the order in which they need each other:
// clang-format off
#include <pcl/surface/3rdparty/poisson4/octree_poisson.h>
#include <pcl/surface/3rdparty/poisson4/sparse_matrix.h>
#include <pcl/surface/3rdparty/poisson4/ppolynomial.h>
#include <pcl/surface/3rdparty/poisson4/multi_grid_octree_data.h>
// clang-format on
#undef printf
#pragma GCC diagnostic pop

#include "modules/object/pcl_points.hpp"
#include "modules/object/surface.hpp"

namespace atrium::object {
namespace {

namespace solver = pcl::poisson;

/// Runs the solver as pcl::Poisson does, with its other settings at PCL's defaults.
void solve(const Cloud& cloud, const Poisson::Params& params, solver::CoredVectorMeshData& mesh,
           solver::Point3D<float>& centre, float& scale) {
  constexpr int degree = 2;    // of the B-splines
  constexpr int coarsest = 5;  // levels that are solved as one
  constexpr float margin = 1.1F;
  constexpr int iterations = 8;
  constexpr float accuracy = 1e-3F;
  constexpr int nodes_per_block = 1 << 12;
  const auto depth = static_cast<int>(params.depth);
  const int divide = std::max(coarsest, depth);
  const bool weighted = params.point_weight > 0;
  solver::TreeNodeData::UseIndex = 1;
  solver::TreeOctNode::SetAllocator(nodes_per_block);
  solver::Octree<degree> tree;
  tree.threads = 1;
  tree.maxMemoryUsage = 0;
  tree.setBSplineData(depth, 1.0F / static_cast<float>(1 << depth), true);
  tree.setTree<pcl::PointNormal>(to_pcl(cloud), depth, std::min(coarsest, depth), depth - 2,
                                 static_cast<float>(params.samples_per_node), margin, centre, scale, 0,
                                 static_cast<float>(params.point_weight), weighted ? 1 : 0);
  tree.ClipTree();
  tree.finalize();
  tree.RefineBoundary(divide);
  tree.SetLaplacianConstraints();
  tree.LaplacianMatrixIteration(divide, false, iterations, accuracy);
  tree.GetMCIsoTriangles(tree.GetIsoValue(), divide, &mesh, 0, 1, true, false);
}

RawSurface reconstruct(const Cloud& cloud, const Poisson::Params& params) {
  static std::mutex one_at_a_time;  // the octree takes its nodes from one pool of the whole program
  const std::lock_guard lock(one_at_a_time);
  solver::CoredVectorMeshData mesh;
  solver::Point3D<float> centre{};
  float scale = 1;
  solve(cloud, params, mesh, centre, scale);

  RawSurface surface;
  const auto add = [&](const solver::Point3D<float>& p) {
    surface.vertices.emplace_back(p.coords[0] * scale + centre.coords[0], p.coords[1] * scale + centre.coords[1],
                                  p.coords[2] * scale + centre.coords[2]);
  };
  for (const auto& p : mesh.inCorePoints) add(p);
  const auto in_core = static_cast<std::uint32_t>(mesh.inCorePoints.size());
  solver::Point3D<float> point;
  for (int i = 0; i < mesh.outOfCorePointCount(); ++i) {
    mesh.nextOutOfCorePoint(point);
    add(point);
  }
  std::vector<solver::CoredVertexIndex> polygon;
  const auto index = [&](std::size_t k) {
    return static_cast<std::uint32_t>(polygon[k].idx) + (polygon[k].inCore ? 0 : in_core);
  };
  for (int i = 0; i < mesh.polygonCount(); ++i) {
    mesh.nextPolygon(polygon);
    for (std::size_t k = 2; k < polygon.size(); ++k) surface.triangles.push_back({index(0), index(k - 1), index(k)});
  }
  return surface;
}

}  // namespace

Poisson::Out Poisson::run(const In& in, const Params& params, Context& context) {
  Out out;
  out.mesh.origin = in.cloud->origin;
  if (is_surface(*in.cloud, context))
    out.mesh = finished(reconstruct(*in.cloud, params), *in.cloud, params.trim, context);
  return out;
}

}  // namespace atrium::object
