#include "smooth.hpp"

#include <pcl/search/kdtree.h>
#include <pcl/surface/mls.h>

#include "modules/pcl/pcl_cloud.hpp"

namespace atrium::mine {

Smooth::Out Smooth::run(const In& in, const Params& params) {
  if (in.cloud->size() == 0) return {*in.cloud};
  pcl::MovingLeastSquares<pcl::PointXYZ, pcl::PointNormal> smoothing;
  smoothing.setInputCloud(pcl_nodes::to_pcl<pcl::PointXYZ>(*in.cloud));
  smoothing.setSearchMethod(pcl::search::KdTree<pcl::PointXYZ>::Ptr(new pcl::search::KdTree<pcl::PointXYZ>));
  smoothing.setSearchRadius(params.radius);
  smoothing.setPolynomialOrder(params.order);
  smoothing.setComputeNormals(true);
  pcl::PointCloud<pcl::PointNormal> moved;
  smoothing.process(moved);

  Out out{select(*in.cloud, pcl_nodes::from_pcl(smoothing.getCorrespondingIndices()->indices))};
  out.cloud.normals.resize(moved.size());
  for (std::size_t i = 0; i < moved.size(); ++i) {
    out.cloud.points[i] = moved[i].getVector3fMap();
    out.cloud.normals[i] = moved[i].getNormalVector3fMap();
  }
  return out;
}

}  // namespace atrium::mine
