#pragma once
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include "modules/types/cloud.hpp"

namespace atrium::object {

/// The cloud's points and normals, in its own coordinates.
inline pcl::PointCloud<pcl::PointNormal>::Ptr to_pcl(const Cloud& cloud) {
  pcl::PointCloud<pcl::PointNormal>::Ptr result(new pcl::PointCloud<pcl::PointNormal>);
  result->resize(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    (*result)[i].getVector3fMap() = cloud.points[i];
    (*result)[i].getNormalVector3fMap() = cloud.normals[i];
  }
  return result;
}

}  // namespace atrium::object
