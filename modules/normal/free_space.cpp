#include "modules/normal/free_space.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "modules/geometry/grid_walk.hpp"
#include "modules/normal/surfels.hpp"
#include "modules/types/turn_between.hpp"

namespace atrium::normal {
namespace {

constexpr std::size_t samples = 256;  // surfels of a region that cast rays
constexpr double saturation = 3.0;    // metres: further is no freer
constexpr double own_surface = 0.5;  // of a voxel's edge: what lies nearer to the surfel's plane does not stop its rays

/// Directions about +z: straight, and six each at 45° and 70° from it.
std::vector<Eigen::Vector3f> hemisphere() {
  std::vector<Eigen::Vector3f> directions{Eigen::Vector3f::UnitZ()};
  for (const double tilt : {45.0, 70.0})
    for (int k = 0; k < 6; ++k) {
      const double t = tilt * std::numbers::pi / 180, a = (k + tilt / 90) * std::numbers::pi / 3;
      directions.push_back(
          Eigen::Vector3d(std::sin(t) * std::cos(a), std::sin(t) * std::sin(a), std::cos(t)).cast<float>());
    }
  return directions;
}

class FreeSpace {
 public:
  FreeSpace(const PointGrid& grid, const Surfels& surfels, double range)
      : grid_(grid), surfels_(surfels), range_(range), directions_(hemisphere()) {}

  /// How far rays travel on the side of the surfel's axis less how far on the other.
  double balance(const Surfel& surfel) const {
    const Eigen::Quaternionf turn = turn_between(Eigen::Vector3d::UnitZ(), surfel.axis.cast<double>()).cast<float>();
    double sum = 0;
    for (const Eigen::Vector3f& d : directions_) {
      const Eigen::Vector3f direction = turn * d;
      sum += travel(surfel, direction) - travel(surfel, -direction);
    }
    return sum;
  }

 private:
  /// Length of a ray up to the first surface other than the surfel's own; 0 if there is none.
  double travel(const Surfel& surfel, const Eigen::Vector3f& direction) const {
    const auto near = static_cast<float>(own_surface * grid_.cell_size());
    double way = 0;
    const bool met = walk(grid_, surfel.centre.cast<double>(), direction.cast<double>(), range_,
                          [&](std::uint32_t cell, double length) {
                            way = length;
                            for (std::uint32_t s = surfels_.first[cell]; s < surfels_.first[cell + 1]; ++s)
                              if (std::abs(surfel.axis.dot(surfels_.surfels[s].centre - surfel.centre)) > near)
                                return true;
                            return false;
                          });
    return met ? std::min(way, saturation) : 0;
  }

  const PointGrid& grid_;
  const Surfels& surfels_;
  double range_;
  std::vector<Eigen::Vector3f> directions_;
};

/// Turns the signs of each region to its freer side.
void turn_regions(Surfels& surfels, const FreeSpace& space, const Context& context) {
  context.parallel_for(
      surfels.regions.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t r = begin; r < end; ++r) {
          const auto& region = surfels.regions[r];
          const std::size_t stride = (region.size() + samples - 1) / samples;
          double balance = 0;
          double majority = 0;  // without a difference: the side that most surfels are on
          for (std::size_t i = 0; i < region.size(); i += stride) {
            const std::uint32_t s = region[i];
            balance += static_cast<double>(surfels.signs[s]) * space.balance(surfels.surfels[s]);
            majority += static_cast<double>(surfels.signs[s]);
          }
          if (balance == 0) balance = majority;
          if (balance < 0)
            for (const auto s : region) surfels.signs[s] = -surfels.signs[s];
        }
      },
      8);
}

}  // namespace

void turn_to_free_space(Cloud& cloud, double voxel, double range, const Context& context) {
  const auto grid = grid_for_rays(cloud.points, voxel, context);
  Surfels surfels(cloud, *grid, context);
  turn_regions(surfels, FreeSpace(*grid, surfels, range), context);
  context.parallel_for(grid->inside(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t s = surfels.of_point[i];
      Eigen::Vector3f& normal = cloud.normals[grid->order()[i]];
      if (surfels.signs[s] * surfels.surfels[s].axis.dot(normal) < 0) normal = -normal;
    }
  });
}

}  // namespace atrium::normal
