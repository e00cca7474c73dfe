#include "modules/pcl/voxel_grid.hpp"

#include <fmt/format.h>
#include <pcl/filters/voxel_grid.h>

#include <array>
#include <map>

#include "graph/api/text.hpp"
#include "modules/pcl/pcl_cloud.hpp"

namespace atrium::pcl_nodes {
namespace {

using Point = pcl::PointXYZRGBNormal;
using Block = std::array<std::int32_t, 3>;

/// PCL numbers the voxels of the box around the points with an int: 1024³ of them fit.
constexpr float block_edge = 1024;

/// The points of each block of voxels. Blocks end where voxels do, as PCL rounds.
std::map<Block, pcl::IndicesPtr> blocks_of(const Cloud& cloud, float size) {
  std::map<Block, pcl::IndicesPtr> blocks;
  constexpr float limit = 2e9F;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Array3f voxel = (cloud.points[i].array() * (1.0F / size)).floor();
    if (!(voxel.abs() < limit).all())
      throw Error(fmt::format("a point is {:.3g} m from the cloud's origin: too far for PCL's voxels of {:.6g} m",
                              cloud.points[i].cwiseAbs().maxCoeff(), size),
                  "check the unit of the scan, crop it (filter.crop), or take larger voxels");
    const Eigen::Array3i block = (voxel / block_edge).floor().cast<int>();
    auto& indices = blocks[{block.x(), block.y(), block.z()}];
    if (!indices) indices.reset(new pcl::Indices);
    indices->push_back(static_cast<pcl::index_t>(i));
  }
  return blocks;
}

void warn_of_dropped(const Cloud& cloud, Context& context) {
  std::string names;
  const auto add = [&](bool has, std::string_view name) {
    if (has) names += (names.empty() ? "" : ", ") + std::string(name);
  };
  add(!cloud.labels.empty(), "labels");
  add(!cloud.intensities.empty(), "intensities");
  add(!cloud.source.empty(), "sources");
  if (!names.empty()) context.warn(names + ": dropped, PCL's points have no room for them");
}

/// Where normals cancel out, PCL's mean is 0.
void name_cancelled_normals(Cloud& cloud, Context& context) {
  std::size_t cancelled = 0;
  for (auto& normal : cloud.normals) {
    if (normal.norm() > 0.5F) continue;
    normal = Eigen::Vector3f::UnitZ();
    ++cancelled;
  }
  if (cancelled > 0)
    context.warn(fmt::format("the normals of {} cancel out: they are set to +z", counted(cancelled, "voxel")));
}

}  // namespace

VoxelGrid::Out VoxelGrid::run(const In& in, const Params& params, Context& context) {
  if (in.cloud->size() == 0) return {*in.cloud};
  warn_of_dropped(*in.cloud, context);
  const auto size = static_cast<float>(params.size);
  pcl::VoxelGrid<Point> grid;
  grid.setInputCloud(to_pcl<Point>(*in.cloud));
  grid.setLeafSize(size, size, size);
  pcl::PointCloud<Point> all;
  for (const auto& [block, indices] : blocks_of(*in.cloud, size)) {
    context.check_cancelled();
    pcl::PointCloud<Point> thinned;
    grid.setIndices(indices);
    grid.filter(thinned);
    all += thinned;
  }
  Out out{from_pcl(all, *in.cloud)};
  name_cancelled_normals(out.cloud, context);
  return out;
}

}  // namespace atrium::pcl_nodes
