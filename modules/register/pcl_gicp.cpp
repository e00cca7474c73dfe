#include "modules/register/pcl_gicp.hpp"

#include <pcl/registration/gicp.h>

#include <cmath>

#include "graph/api/error.hpp"
#include "modules/pcl/pcl_cloud.hpp"

namespace atrium::registration {
namespace {

/// PCL calls a registration converged that has ended at its limit of rounds, too: the rounds tell the two apart.
struct CountedGicp : pcl::GeneralizedIterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ> {
  int rounds() const { return nr_iterations_; }
};

}  // namespace

PairMotion align_gicp(const Points& source, const Points& target, const GicpSettings& settings) {
  CountedGicp gicp;
  gicp.setInputSource(pcl_nodes::to_pcl<pcl::PointXYZ>(source));
  gicp.setInputTarget(pcl_nodes::to_pcl<pcl::PointXYZ>(target));
  gicp.setMaxCorrespondenceDistance(settings.max_distance);
  gicp.setMaximumIterations(settings.iterations);
  gicp.setTransformationEpsilon(settings.translation_epsilon);
  gicp.setRotationEpsilon(settings.rotation_epsilon);
  gicp.setCorrespondenceRandomness(settings.neighbours);
  gicp.setMaximumOptimizerIterations(settings.optimizer_iterations);
  pcl::PointCloud<pcl::PointXYZ> moved;
  try {
    gicp.align(moved);
  } catch (const pcl::PCLException& error) {
    throw Error(std::string("GICP failed: ") + error.what(), "the scans may not overlap: give initial poses");
  }
  PairMotion result;
  const Eigen::Matrix4d matrix = gicp.getFinalTransformation().cast<double>();
  if (!matrix.allFinite()) return result;
  result.motion.linear() =
      Eigen::Quaterniond(Eigen::Matrix3d(matrix.topLeftCorner<3, 3>())).normalized().toRotationMatrix();
  result.motion.translation() = matrix.topRightCorner<3, 1>();
  result.converged = gicp.hasConverged() && gicp.rounds() < settings.iterations;
  return result;
}

}  // namespace atrium::registration
