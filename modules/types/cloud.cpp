#include "modules/types/cloud.hpp"

namespace atrium {
namespace {

template <class T>
std::vector<T> gather(const std::vector<T>& column, const std::vector<std::uint32_t>& indices) {
  std::vector<T> result;
  if (column.empty()) return result;
  result.reserve(indices.size());
  for (const auto i : indices) result.push_back(column[i]);
  return result;
}

}  // namespace

Cloud select(const Cloud& cloud, const std::vector<std::uint32_t>& indices) {
  Cloud result;
  result.origin = cloud.origin;
  result.points = gather(cloud.points, indices);
  result.normals = gather(cloud.normals, indices);
  result.colours = gather(cloud.colours, indices);
  result.labels = gather(cloud.labels, indices);
  result.intensities = gather(cloud.intensities, indices);
  result.source = gather(cloud.source, indices);
  result.sensors = cloud.sensors;
  result.unit = cloud.unit;
  result.y_up = cloud.y_up;
  result.crs = cloud.crs;
  return result;
}

}  // namespace atrium
