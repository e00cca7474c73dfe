#include "modules/pcl/ndt.hpp"

#include <pcl/registration/ndt.h>

#include "modules/pcl/pcl_cloud.hpp"
#include "modules/register/register_scans.hpp"

namespace atrium::pcl_nodes {
namespace {

registration::PairMotion align_ndt(const registration::Points& source, const registration::Points& target,
                                   const Ndt::Params& params) {
  pcl::NormalDistributionsTransform<pcl::PointXYZ, pcl::PointXYZ> ndt;
  ndt.setResolution(static_cast<float>(params.resolution));
  ndt.setStepSize(params.step_size);
  ndt.setOulierRatio(params.outlier_ratio);  // PCL's spelling
  ndt.setMaximumIterations(static_cast<int>(params.iterations));
  ndt.setTransformationEpsilon(params.translation_epsilon * params.translation_epsilon);  // PCL compares squares
  ndt.setInputSource(to_pcl<pcl::PointXYZ>(source));
  ndt.setInputTarget(to_pcl<pcl::PointXYZ>(target));
  pcl::PointCloud<pcl::PointXYZ> moved;
  ndt.align(moved);
  const Eigen::Matrix4d matrix = ndt.getFinalTransformation().cast<double>();
  registration::PairMotion result;
  if (!matrix.allFinite()) return result;
  result.motion.linear() =
      Eigen::Quaterniond(Eigen::Matrix3d(matrix.topLeftCorner<3, 3>())).normalized().toRotationMatrix();
  result.motion.translation() = matrix.topRightCorner<3, 1>();
  // PCL calls it converged where it has ended at its limit of steps, too.
  result.converged = ndt.hasConverged() && ndt.getFinalNumIteration() < params.iterations;
  return result;
}

}  // namespace

Ndt::Out Ndt::run(const In& in, const Params& params, Context& context) {
  auto scans = registration::register_scans(
      in.clouds, {params.voxel, params.max_correspondence_distance, params.initial, "NDT"},
      [&](const auto& source, const auto& target) { return align_ndt(source, target, params); }, context);
  return {std::move(scans.cloud), std::move(scans.poses), std::move(scans.metrics)};
}

}  // namespace atrium::pcl_nodes
