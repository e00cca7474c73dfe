#include "modules/register/pcl_gicp.hpp"

#include <pcl/console/print.h>
#include <pcl/point_types.h>
#include <pcl/registration/gicp.h>

#include <cmath>

#include "graph/api/error.hpp"

namespace atrium::registration {
namespace {

pcl::PointCloud<pcl::PointXYZ>::Ptr to_pcl(const std::vector<Eigen::Vector3f>& points) {
  auto cloud = std::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  cloud->reserve(points.size());
  for (const auto& p : points) cloud->push_back({p.x(), p.y(), p.z()});
  return cloud;
}

}  // namespace

GicpResult align_gicp(const std::vector<Eigen::Vector3f>& source, const std::vector<Eigen::Vector3f>& target,
                      const GicpSettings& settings) {
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);  // what goes wrong is reported by the node
  pcl::GeneralizedIterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ> gicp;
  gicp.setInputSource(to_pcl(source));
  gicp.setInputTarget(to_pcl(target));
  gicp.setMaxCorrespondenceDistance(settings.max_distance);
  gicp.setMaximumIterations(settings.iterations);
  gicp.setTransformationEpsilon(settings.translation_epsilon);
  gicp.setRotationEpsilon(settings.rotation_epsilon);
  pcl::PointCloud<pcl::PointXYZ> moved;
  try {
    gicp.align(moved);
  } catch (const pcl::PCLException& error) {
    throw Error(std::string("GICP failed: ") + error.what(), "the scans may not overlap: give initial poses");
  }
  GicpResult result;
  const Eigen::Matrix4d matrix = gicp.getFinalTransformation().cast<double>();
  if (!matrix.allFinite()) return result;
  result.motion.linear() =
      Eigen::Quaterniond(Eigen::Matrix3d(matrix.topLeftCorner<3, 3>())).normalized().toRotationMatrix();
  result.motion.translation() = matrix.topRightCorner<3, 1>();
  result.converged = gicp.hasConverged();
  return result;
}

}  // namespace atrium::registration
