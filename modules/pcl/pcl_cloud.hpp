#pragma once
#include <pcl/PointIndices.h>
#include <pcl/Vertices.h>
#include <pcl/console/print.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <array>
#include <cstdint>
#include <vector>

#include "modules/types/cloud.hpp"

namespace atrium::pcl_nodes {

/// Between our clouds, which are columns, and PCL's, which are rows: x, y, z and padding in 16 bytes, normals and
/// colours behind. No column has the layout of a PCL cloud, so what an algorithm reads is copied once (16 to 48 bytes a
/// point), and nothing else is: a node that chooses points hands back their indices, and `select` takes all columns
/// from the cloud itself.
///
/// PCL's coordinates are floats, as ours are. Both are relative to the cloud's origin, which PCL never sees: a
/// georeferenced cloud keeps its millimetres. PCL's own messages are switched off; what goes wrong is the node's to
/// say.
template <class Point>
typename pcl::PointCloud<Point>::Ptr to_pcl(const std::vector<Eigen::Vector3f>& points) {
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  typename pcl::PointCloud<Point>::Ptr result(new pcl::PointCloud<Point>);
  result->resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) (*result)[i].getVector3fMap() = points[i];
  return result;
}

/// Points with the normals and colours that `Point` has room for and the cloud knows.
template <class Point>
typename pcl::PointCloud<Point>::Ptr to_pcl(const Cloud& cloud) {
  auto result = to_pcl<Point>(cloud.points);
  if constexpr (requires(Point p) { p.normal_x; })
    for (std::size_t i = 0; i < cloud.normals.size(); ++i) (*result)[i].getNormalVector3fMap() = cloud.normals[i];
  if constexpr (requires(Point p) { p.r; })
    for (std::size_t i = 0; i < cloud.colours.size(); ++i) {
      (*result)[i].r = cloud.colours[i][0];
      (*result)[i].g = cloud.colours[i][1];
      (*result)[i].b = cloud.colours[i][2];
    }
  return result;
}

/// The normals alone, as PCL's segmentation wants them.
inline pcl::PointCloud<pcl::Normal>::Ptr normals_to_pcl(const Cloud& cloud) {
  pcl::PointCloud<pcl::Normal>::Ptr result(new pcl::PointCloud<pcl::Normal>);
  result->resize(cloud.normals.size());
  for (std::size_t i = 0; i < cloud.normals.size(); ++i) (*result)[i].getNormalVector3fMap() = cloud.normals[i];
  return result;
}

/// Points of PCL's about `frame`'s origin, with the normals and colours that `frame` has, too.
template <class Point>
Cloud from_pcl(const pcl::PointCloud<Point>& points, const Cloud& frame) {
  Cloud result;
  result.origin = frame.origin;
  result.sensors = frame.sensors;
  result.unit = frame.unit;
  result.y_up = frame.y_up;
  result.crs = frame.crs;
  result.points.reserve(points.size());
  for (const auto& p : points) result.points.emplace_back(p.getVector3fMap());
  if constexpr (requires(Point p) { p.normal_x; })
    if (frame.has_normals()) {
      result.normals.reserve(points.size());
      for (const auto& p : points) result.normals.emplace_back(p.getNormalVector3fMap());
    }
  if constexpr (requires(Point p) { p.r; })
    if (!frame.colours.empty()) {
      result.colours.reserve(points.size());
      for (const auto& p : points) result.colours.push_back({p.r, p.g, p.b});
    }
  return result;
}

/// PCL's indices are signed.
inline std::vector<std::uint32_t> from_pcl(const pcl::Indices& indices) { return {indices.begin(), indices.end()}; }

/// Triangles of PCL's polygons: fans about their first vertices.
inline std::vector<std::array<std::uint32_t, 3>> triangles_of(const std::vector<pcl::Vertices>& polygons) {
  std::vector<std::array<std::uint32_t, 3>> result;
  result.reserve(polygons.size());
  for (const auto& polygon : polygons)
    for (std::size_t k = 2; k < polygon.vertices.size(); ++k)
      result.push_back({static_cast<std::uint32_t>(polygon.vertices[0]),
                        static_cast<std::uint32_t>(polygon.vertices[k - 1]),
                        static_cast<std::uint32_t>(polygon.vertices[k])});
  return result;
}

}  // namespace atrium::pcl_nodes
