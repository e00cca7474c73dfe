#include "modules/layout/doubled_walls.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "modules/geometry/quantile.hpp"

namespace atrium::layout {
namespace {

constexpr int times = 4;              // squares of the footprints along one edge of a square here
constexpr double full = 0.6;          // of a square's smaller ones: fronts of shelves are edges only
constexpr double least_area = 1;      // m² of a plane
constexpr double nearest = 0.04;      // metres between two layers
constexpr double farthest = 0.35;     // metres
constexpr double clear_of_noise = 4;  // times the residual
constexpr double most_turned = 8;     // degrees

/// A wall as its squares.
struct Layer {
  const PlanePrimitive* primitive = nullptr;
  Eigen::Vector2d along;
  Raster squares;
  Eigen::AlignedBox2d plan;  ///< seen from above

  /// The middle of a square in space.
  Eigen::Vector3d place(int x, int y) const {
    const Eigen::Vector2d at = squares.centre(x, y);
    const Eigen::Vector3d& n = primitive->plane.normal;
    const Eigen::Vector3d along3(along.x(), along.y(), 0);
    Eigen::Vector3d p = at.x() * along3 + Eigen::Vector3d(0, 0, at.y());
    const Eigen::Vector3d outwards = n - n.z() * Eigen::Vector3d::UnitZ();
    p -= outwards * primitive->plane.signed_distance(p) / outwards.squaredNorm();
    return p;
  }
};

/// The large squares whose small ones hold points, but for some; where the scan is sparse, small ones are larger.
Raster filled_squares(const Footprint& wall) {
  const int grown = std::clamp(static_cast<int>(std::lround(wall.spacing / wall.raster.pixel)), 1, times);
  const Raster fine = wall.raster.coarse(grown);
  const int side = std::max(1, times / grown);
  Raster result = fine.coarse(side);
  for (int y = 0; y < result.height; ++y)
    for (int x = 0; x < result.width; ++x) {
      int count = 0;
      for (int v = 0; v < side; ++v)
        for (int u = 0; u < side; ++u) count += fine.at(side * x + u, side * y + v) ? 1 : 0;
      if (count < full * side * side)
        result
            .bits[static_cast<std::size_t>(y) * static_cast<std::size_t>(result.width) + static_cast<std::size_t>(x)] =
            0;
    }
  return result;
}

std::vector<Layer> layers_of(const PlanePrimitives& planes, const std::vector<Footprint>& walls) {
  std::vector<Layer> result;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    if (!walls[i].upright) continue;
    Layer layer{&planes.primitives[i], walls[i].along, filled_squares(walls[i]), {}};
    if (layer.squares.area() < least_area) continue;
    for (const int x : {0, layer.squares.width - 1})
      for (const int y : {0, layer.squares.height - 1}) layer.plan.extend(Eigen::Vector2d(layer.place(x, y).head<2>()));
    result.push_back(std::move(layer));
  }
  return result;
}

double turned(const Layer& a, const Layer& b) {
  const double cosine = a.primitive->plane.normal.dot(b.primitive->plane.normal);
  return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi;
}

/// The other layers that may double a layer.
std::vector<const Layer*> beside(const Layer& layer, const std::vector<Layer>& layers) {
  std::vector<const Layer*> result;
  Eigen::AlignedBox2d around = layer.plan;
  around.min().array() -= farthest;
  around.max().array() += farthest;
  for (const Layer& other : layers)
    if (&other != &layer && around.intersects(other.plan) && turned(layer, other) <= most_turned)
      result.push_back(&other);
  return result;
}

}  // namespace

DoubledWalls doubled_walls(const PlanePrimitives& planes, const std::vector<Footprint>& walls, const Context& context) {
  const std::vector<Layer> layers = layers_of(planes, walls);
  std::size_t all = 0;
  std::vector<double> apart, turns;
  for (const Layer& layer : layers) {
    context.check_cancelled();
    const auto others = beside(layer, layers);
    for (int y = 0; y < layer.squares.height; ++y)
      for (int x = 0; x < layer.squares.width; ++x) {
        if (!layer.squares.at(x, y)) continue;
        ++all;
        const Eigen::Vector3d p = layer.place(x, y);
        for (const Layer* other : others) {
          const double distance = std::abs(other->primitive->plane.signed_distance(p));
          const double noise = std::max(layer.primitive->residual, other->primitive->residual);
          if (distance > farthest || distance < std::max(nearest, clear_of_noise * noise)) continue;
          if (!other->squares.at({other->along.dot(p.head<2>()), p.z()})) continue;
          apart.push_back(distance);
          turns.push_back(turned(layer, *other));
          break;
        }
      }
  }
  if (apart.empty()) return {};
  const double share = static_cast<double>(apart.size()) / static_cast<double>(all);
  return {share, median(std::move(apart)), median(std::move(turns))};
}

}  // namespace atrium::layout
