#include "modules/object/poisson.hpp"

#include <fmt/format.h>
#include <pcl/surface/poisson.h>

#include <algorithm>
#include <mutex>

#include "modules/object/pcl_surfaces.hpp"
#include "modules/pcl/pcl_cloud.hpp"

namespace atrium::object {

namespace {

constexpr int usual_depth = 8;       // its authors' default
constexpr double usual_trim = 0.06;  // metres

/// The edge of the cube that is solved in, metres: PCL's, which has the cloud's longest side times its scale.
double cube_of(const Cloud& cloud, double scale) {
  Eigen::AlignedBox3f box;
  for (const auto& p : cloud.points) box.extend(p);
  return scale * static_cast<double>(box.sizes().maxCoeff());
}

/// The least depth from the usual one on with which a cell is at most five times the spacing.
int depth_for(double cube, double spacing) {
  constexpr int deepest = 12;
  constexpr double most_spacings = 5;
  int depth = usual_depth;
  while (depth < deepest && cube / (1 << depth) > most_spacings * spacing) ++depth;
  return depth;
}

/// The points' spacing where a parameter follows it, else 0; 0 and a warning where they are copies without one.
double needed_spacing(const Cloud& cloud, const Poisson::Params& params, const Context& context) {
  if (params.depth != 0 && params.trim != 0) return 0;
  const double spacing = surface_spacing(cloud, context);
  if (spacing == 0)
    context.warn(
        fmt::format("half of the points have 16 copies or more, so that their spacing is not known: depth {} "
                    "and trim {} m stand for those that follow it",
                    usual_depth, usual_trim));
  return spacing;
}

}  // namespace

RawSurface poisson_surface(const Cloud& cloud, const PoissonSettings& settings) {
  constexpr int coarsest = 5;  // levels that are solved as one: PCL's default, or its `min depth` were above the depth
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  pcl::Poisson<pcl::PointNormal> poisson;
  poisson.setInputCloud(pcl_nodes::to_pcl<pcl::PointNormal>(cloud));
  poisson.setDepth(settings.depth);
  poisson.setMinDepth(std::min(coarsest, settings.depth));
  poisson.setSolverDivide(std::max(coarsest, settings.depth));
  poisson.setIsoDivide(std::max(coarsest, settings.depth));
  poisson.setSamplesPerNode(static_cast<float>(settings.samples_per_node));
  poisson.setPointWeight(static_cast<float>(settings.point_weight));
  poisson.setScale(static_cast<float>(settings.scale));
  poisson.setConfidence(settings.confidence);
  poisson.setThreads(1);
  pcl::PointCloud<pcl::PointNormal> vertices;
  std::vector<pcl::Vertices> polygons;
  poisson.reconstruct(vertices, polygons);
  RawSurface surface;
  surface.vertices.reserve(vertices.size());
  for (const auto& v : vertices) surface.vertices.emplace_back(v.getVector3fMap());
  surface.triangles = pcl_nodes::triangles_of(polygons);
  return surface;
}

Poisson::Out Poisson::run(const In& in, const Params& params, Context& context) {
  Out out;
  constexpr double trim_spacings = 3;
  out.mesh.origin = in.cloud->origin;
  if (!is_surface(*in.cloud, context)) return out;
  if (params.depth == 1 || params.depth == 2)
    throw Error(fmt::format("an octree of depth {} is too coarse for a surface", params.depth),
                "depth is 3 or more, or 0: by the points' spacing");
  const double spacing = needed_spacing(*in.cloud, params, context);
  PoissonSettings settings;
  const double cube = cube_of(*in.cloud, settings.scale);
  settings.depth = params.depth != 0 ? static_cast<int>(params.depth)
                   : spacing > 0     ? depth_for(cube, spacing)
                                     : usual_depth;
  const double trim = params.trim != 0 ? params.trim : spacing > 0 ? trim_spacings * spacing : usual_trim;
  settings.samples_per_node = params.samples_per_node;
  settings.point_weight = params.point_weight;
  context.info(fmt::format("cells of {:.3g} cm (depth {}), trimmed at {:.3g} cm", 100 * cube / (1 << settings.depth),
                           settings.depth, 100 * trim));
  out.mesh = finished(poisson_surface(*in.cloud, settings), *in.cloud, trim, context);
  return out;
}

}  // namespace atrium::object
