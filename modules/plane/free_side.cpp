#include "modules/plane/free_side.hpp"

#include <cmath>
#include <limits>

namespace atrium::plane {
namespace {

constexpr double furthest = 10;   // metres: how far to look
constexpr double wall = 0.5;      // metres: thicker walls and slabs are rare
constexpr double nearest = 0.06;  // metres: no wall is thinner
constexpr double nothing = std::numeric_limits<double>::infinity();

}  // namespace

void FreeSide::turn(Plane& plane, const std::vector<std::uint32_t>& places, std::uint32_t own) const {
  const double vote = cloud_.sensors.empty() ? towards_room(plane, places, own) : towards_sensors(plane, places);
  if (vote < 0) plane = {-plane.normal, -plane.offset};
}

double FreeSide::towards_sensors(const Plane& plane, const std::vector<std::uint32_t>& places) const {
  double vote = 0;
  for (const std::uint32_t place : places) {
    const std::size_t sensor = cloud_.source.empty() ? 0 : cloud_.source[order_.index[place]];
    if (sensor >= cloud_.sensors.size()) continue;
    vote += plane.signed_distance(cloud_.sensors[sensor].cast<double>() - order_.centre) > 0 ? 1 : -1;
  }
  return vote;
}

double FreeSide::towards_room(const Plane& plane, const std::vector<std::uint32_t>& places, std::uint32_t own) const {
  double vote = 0;
  for (const std::uint32_t place : places) {
    Eigen::Vector3d p = order_.columns.point(place).cast<double>();
    p -= plane.signed_distance(p) * plane.normal;
    const double ahead = free_length(p, plane.normal, own);
    const double behind = free_length(p, -plane.normal, own);
    if (ahead == behind) continue;
    double side = ahead > behind ? 1 : -1;
    // One way is open to the outside: the scene is the other way, unless that is only the wall's thickness.
    if (std::max(ahead, behind) == nothing && std::min(ahead, behind) > wall) side = -side;
    vote += side;
  }
  return vote;
}

double FreeSide::free_length(const Eigen::Vector3d& from, const Eigen::Vector3d& direction, std::uint32_t own) const {
  const double step = 0.5 * grid_.edge();
  for (double length = nearest; length < furthest; length += step) {
    const std::uint32_t voxel = grid_.find(grid_.index_at(from + length * direction));
    if (voxel != VoxelGrid::none && surface_[voxel] != VoxelGrid::none && surface_[voxel] != own) return length;
  }
  return nothing;
}

}  // namespace atrium::plane
