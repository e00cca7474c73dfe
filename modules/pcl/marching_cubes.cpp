#include "modules/pcl/marching_cubes.hpp"

#include <fmt/format.h>
#include <pcl/search/kdtree.h>
#include <pcl/surface/marching_cubes_hoppe.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "modules/object/surface.hpp"
#include "modules/pcl/pcl_cloud.hpp"

namespace atrium::pcl_nodes {
namespace {

struct Grid {
  Eigen::Vector3i cells;
  float margin;  ///< over the box, as a share of it: two cells beyond its thinnest side, where it is not flat
};

Grid grid_around(const Cloud& cloud, double cell) {
  constexpr double most_margin = 3;
  constexpr double most_cells = 2e8;
  Eigen::AlignedBox3f box;
  for (const auto& p : cloud.points) box.extend(p);
  const Eigen::Vector3d sides = box.sizes().cast<double>();
  const double margin = std::min(most_margin, 4 * cell / std::max(cell, sides.minCoeff()));
  const Eigen::Vector3d cells = ((1 + margin) * sides / cell).array().ceil().max(4);
  if (cells.prod() > most_cells)
    throw Error(fmt::format("cells of {:.6g} m are {:.3g} in the box around the cloud", cell, cells.prod()),
                "take larger cells: PCL keeps a number for each");
  return {cells.cast<int>(), static_cast<float>(margin)};
}

}  // namespace

MarchingCubes::Out MarchingCubes::run(const In& in, const Params& params, Context& context) {
  const Cloud& cloud = *in.cloud;
  Out out;
  out.mesh.origin = cloud.origin;
  if (!object::is_surface(cloud, context)) return out;
  const Grid grid = grid_around(cloud, params.cell);
  const double reach = params.trim + 2 * params.cell;
  pcl::MarchingCubesHoppe<pcl::PointNormal> cubes;
  cubes.setInputCloud(to_pcl<pcl::PointNormal>(cloud));
  cubes.setSearchMethod(pcl::search::KdTree<pcl::PointNormal>::Ptr(new pcl::search::KdTree<pcl::PointNormal>));
  cubes.setGridResolution(grid.cells.x(), grid.cells.y(), grid.cells.z());
  cubes.setPercentageExtendGrid(grid.margin);
  cubes.setIsoLevel(static_cast<float>(params.iso_level));
  cubes.setDistanceIgnore(static_cast<float>(reach * reach));  // PCL compares it with a square
  pcl::PointCloud<pcl::PointNormal> vertices;
  std::vector<pcl::Vertices> polygons;
  cubes.reconstruct(vertices, polygons);
  object::RawSurface surface;
  surface.vertices.reserve(vertices.size());
  for (const auto& v : vertices) surface.vertices.emplace_back(v.getVector3fMap());
  surface.triangles = triangles_of(polygons);
  out.mesh = object::finished(surface, cloud, params.trim, context);
  return out;
}

}  // namespace atrium::pcl_nodes
